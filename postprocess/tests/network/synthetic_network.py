"""The output folder of a network, made from the reference figures of the pack in crates/drawings/tests/drawings: no solver is needed.

Drainage from the left wall to the right one through bursts only, without trapping, by a loop over all throats.
"""

import csv
import json
import math
from pathlib import Path

import numpy as np

DRAWINGS = Path(__file__).parents[3] / "crates" / "drawings" / "tests" / "drawings"
TENSION = 0.03
VISCOSITY = 1e-3


def reference() -> dict:
    """Pores and throats of the pack in a closed box."""
    return json.loads((DRAWINGS / "reference.json").read_text(encoding="utf-8"))


def invade(ends: np.ndarray, entry: np.ndarray, inlets: set[int], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Sequence and applied pressure of each pore: the easiest throat at the front is always the next."""
    sequence, applied = np.full(count, -1), np.full(count, math.nan)
    held, largest, number = set(inlets), 0.0, 0
    while True:
        front = [t for t, (a, b) in enumerate(ends) if (a in held) != (b in held)]
        if not front:
            return sequence, applied
        throat = min(front, key=lambda t: (entry[t], t))
        largest = max(largest, entry[throat])
        pore = next(p for p in ends[throat] if p not in held)
        held.add(pore)
        sequence[pore], applied[pore] = number, largest
        number += 1


def write_table(path: Path, columns: dict[str, list]) -> None:
    """Columns side by side, the shorter ones left empty."""
    height = max(len(cells) for cells in columns.values())
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        for row in range(height):
            cells = [c[row] if row < len(c) else "" for c in columns.values()]
            writer.writerow("" if isinstance(cell, float) and math.isnan(cell) else cell for cell in cells)


def make(folder: Path) -> None:
    """Writes pores.csv, throats.csv, openpnm.csv, network.json and report.json."""
    content = reference()
    pores, throats = content["closed"]["pores"], content["closed"]["throats"]
    places, radius = np.array([p[:2] for p in pores]), np.array([p[2] for p in pores])
    # A throat from a pore to itself connects nothing.
    throats = [t for t in throats if t[3] != t[4]]
    ends = np.sort(np.array([t[3:5] for t in throats]), axis=1)
    width, entry = np.array([t[2] for t in throats]), TENSION * np.array([t[7] for t in throats])
    area = 4.0 * radius**2
    # Pores at the left and the right wall open to a boundary pore each.
    outer = [(k, side) for side in ("left", "right") for k, pore in enumerate(pores) if side in pore[3:]]
    links = np.vstack([ends, [(k, len(pores) + i) for i, (k, _) in enumerate(outer)]])
    all_entry = np.concatenate([entry, np.zeros(len(outer))])
    inlets = {len(pores) + i for i, (_, side) in enumerate(outer) if side == "left"}
    count = len(pores) + len(outer)
    sequence, applied = invade(links, all_entry, inlets, count)
    (x0, y0), (x1, y1) = content["box"][:2], content["box"][2:]
    outer_places = np.array([[x0 if side == "left" else x1, places[k, 1]] for k, side in outer])
    conductance = np.concatenate([width**3 / (12 * 2e-4 * VISCOSITY), np.full(len(outer), 1e-6)])
    at = [*places.tolist(), *outer_places.tolist()]
    no, inner = [False] * len(pores), len(pores)
    openpnm = {
        "pore.coords[0]": [p[0] for p in at],
        "pore.coords[1]": [p[1] for p in at],
        "pore.coords[2]": [0.0] * count,
        "pore.volume": [*area.tolist(), *[0.0] * len(outer)],
        "pore.boundary": [*no, *[True] * len(outer)],
        "pore.inlet": [*no, *[side == "left" for _, side in outer]],
        "pore.outlet": [*no, *[side == "right" for _, side in outer]],
        "throat.conns[0]": links[:, 0].tolist(),
        "throat.conns[1]": links[:, 1].tolist(),
        "throat.volume": [0.0] * len(links),
        "throat.entry_pressure": all_entry.tolist(),
        "throat.hydraulic_conductance": conductance.tolist(),
        "throat.boundary": [*[False] * len(ends), *[True] * len(outer)],
    }
    write_table(folder / "openpnm.csv", openpnm)
    write_table(
        folder / "pores.csv",
        {
            "pore": list(range(inner)),
            "x_m": places[:, 0].tolist(),
            "y_m": places[:, 1].tolist(),
            "inscribed_radius_m": radius.tolist(),
            "area_m2": area.tolist(),
            "sequence": sequence[:inner].tolist(),
            "invasion_capillary_pressure_Pa": applied[:inner].tolist(),
        },
    )
    numbers = list(range(len(ends)))
    columns = {"throat": numbers, "pore_1": ends[:, 0].tolist(), "pore_2": ends[:, 1].tolist()}
    write_table(folder / "throats.csv", columns | {"width_m": width.tolist()})
    about = {
        "persistence": 1.0,
        "domain_m": [[x0, y0], [x1, y1]],
        "periodic": [False, False],
        "inlet": "left",
        "outlet": "right",
        "viscosity_pa_s": [VISCOSITY, None],
        "porosity": content["porosity"],
        "half_cycles": [{"process": "drainage"}],
    }
    (folder / "network.json").write_text(json.dumps(about), encoding="utf-8")
    # Flow through the network by a dense solve, at a pressure difference of 1.
    laplacian = np.zeros((count, count))
    for (a, b), g in zip(links, conductance, strict=True):
        laplacian[[a, b, a, b], [a, b, b, a]] += [g, g, -g, -g]
    fixed = np.arange(inner, count)
    pressure = np.zeros(count)
    pressure[list(inlets)] = 1.0
    free = laplacian[:inner, :inner]
    pressure[:inner] = np.linalg.solve(free, -laplacian[:inner][:, fixed] @ pressure[fixed])
    rate = (laplacian @ pressure)[list(inlets)].sum()
    value = rate * VISCOSITY * (x1 - x0) / (y1 - y0)
    report = {"measures": {"permeability-x-m2": {"value": value}, "permeability-y-m2": {"value": None}}}
    (folder / "report.json").write_text(json.dumps(report), encoding="utf-8")
