"""Loads a pore network in OpenPNM, drains it there, lets fluid flow through it, and compares with what meniscus found.

Usage: network_to_openpnm.py RUN [--picture openpnm.png]. RUN is the output folder of a network. OpenPNM knows bursts
only and is run without trapping, so that the invaded pores agree for a drainage with `events = "burst"` and
`trapping = false`; for another drainage the table shows what touch, overlap and trapping change, and for an imbibition
or a cycle only the flow is compared. Needs the packages of requirements-network.txt.
"""

import argparse
import logging
import os
import warnings
from pathlib import Path

import matplotlib
import numpy as np

from network_files import description, measures, table

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Pressures that differ by less than this share are one: those of the tables have 17 digits.
SAME = 1e-9
# Opposite sides with the axis from one to the other, and the measure that says how easily fluid flows along it.
AXES = {"left": (0, "permeability-x-m2"), "right": (0, "permeability-x-m2")}
AXES |= {"bottom": (1, "permeability-y-m2"), "top": (1, "permeability-y-m2")}


def load(folder: Path):
    """The network as OpenPNM reads it; an error names what is missing."""
    # OpenPNM warns that a solver is not among the requirements and of its own imports, and draws progress bars.
    logging.disable(logging.WARNING)
    warnings.filterwarnings("ignore", category=DeprecationWarning, module="openpnm")
    os.environ.setdefault("TQDM_DISABLE", "1")
    import openpnm

    network = openpnm.io.network_from_csv(str(folder / "openpnm.csv"))
    for name in ("pore.inlet", "pore.outlet", "pore.boundary", "throat.boundary"):
        if name not in network or network[name].dtype != bool:
            raise ValueError(f"{folder / 'openpnm.csv'}: {name} is no label: expected the words True and False")
    # Pairs stay floating-point numbers where the network has more pores than throats and cells are empty.
    conns = network["throat.conns"].astype(int)
    network["throat.conns"] = conns
    if np.any(conns[:, 0] >= conns[:, 1]) or conns.max(initial=0) >= network.Np:
        raise ValueError(f"{folder / 'openpnm.csv'}: throat.conns: expected pairs of pores, the lower one first")
    return openpnm, network


def drain(openpnm, network, pressures: np.ndarray) -> dict:
    """Pressures of invasion by OpenPNM's drainage, and the order by its invasion percolation; no trapping."""
    phase = openpnm.phase.Phase(network=network)
    phase["throat.entry_pressure"] = network["throat.entry_pressure"]
    inlets = network.pores("inlet")
    drainage = openpnm.algorithms.Drainage(network=network, phase=phase)
    drainage.set_inlet_BC(pores=inlets)
    drainage.run(pressures=pressures * (1 + SAME))
    percolation = openpnm.algorithms.InvasionPercolation(network=network, phase=phase)
    percolation.set_inlet_BC(pores=inlets)
    percolation.run()
    return {
        "pressure": drainage["pore.invasion_pressure"] / (1 + SAME),
        "order": np.asarray(percolation["pore.invasion_sequence"], dtype=float),
    }


def flow(openpnm, network, about: dict) -> float | None:
    """Permeability in m2 from inlet to outlet by OpenPNM's Stokes flow; none where no fluid can flow."""
    if "throat.hydraulic_conductance" not in network or not about.get("inlet") or not about.get("outlet"):
        return None
    phase = openpnm.phase.Phase(network=network)
    phase["throat.hydraulic_conductance"] = network["throat.hydraulic_conductance"]
    stokes = openpnm.algorithms.StokesFlow(network=network, phase=phase)
    inlets = network.pores("inlet")
    stokes.set_value_BC(pores=inlets, values=1.0)
    stokes.set_value_BC(pores=network.pores("outlet"), values=0.0)
    stokes.run()
    rate = float(np.sum(stokes.rate(pores=inlets)))
    size = np.subtract(about["domain_m"][1], about["domain_m"][0])
    along, _ = AXES[about["inlet"]]
    viscosity = next((value for value in about["viscosity_pa_s"] if value is not None), 1.0)
    # Depth and pressure difference are 1; conductances are those of the viscosity that the description names.
    return abs(rate) * viscosity * size[along] / size[1 - along]


def rank_correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Spearman's correlation of two orders without ties."""
    ranks = [np.argsort(np.argsort(values)) for values in (first, second)]
    return float(np.corrcoef(*ranks)[0, 1])


def measure(path: str | Path) -> dict:
    """What both programs found, pore by pore, and how far they agree."""
    folder = Path(path)
    about, ours, found = description(folder), table(folder / "pores.csv"), measures(folder)
    openpnm, network = load(folder)
    count = len(ours["x_m"])
    if network.num_pores("boundary", mode="not") != count:
        raise ValueError(f"{folder}: pores.csv has {count} pores, openpnm.csv another number")
    result = {
        "pores": count,
        "throats": network.num_throats("boundary", mode="not"),
        "boundary_pores": network.num_pores("boundary"),
        "parallel_throats": network.Nt - len(np.unique(network["throat.conns"], axis=0)),
        "coordinates": np.column_stack([ours["x_m"], ours["y_m"]]),
        "radius": ours["inscribed_radius_m"],
        "ends": network["throat.conns"][~network["throat.boundary"]],
    }
    result |= {"permeability": flow(openpnm, network, about), "permeability_ours": None}
    if about.get("inlet"):
        result["permeability_ours"] = found.get(AXES[about["inlet"]][1])
    processes = [half["process"] for half in about.get("half_cycles", [])]
    if processes == ["drainage"] and "throat.entry_pressure" in network and network.num_pores("inlet"):
        result |= compare(drain_at(openpnm, network, ours), ours, count)
    return result


def drain_at(openpnm, network, ours: dict) -> dict:
    """Drainage at all pressures of our run and all entry pressures, so that neither is rounded to the other."""
    own = invasion_pressures(ours)
    pressures = np.unique(np.concatenate([own[np.isfinite(own)], network["throat.entry_pressure"]]))
    return drain(openpnm, network, pressures)


def invasion_pressures(ours: dict) -> np.ndarray:
    """Pressure in Pa at which each pore is invaded; 0 where it is open at the inlet and filled from the start, NaN where it stays."""
    own = ours["invasion_capillary_pressure_Pa"]
    return np.where(~np.isfinite(own) & (ours["sequence"] == 0), 0.0, own)


def compare(theirs: dict, ours: dict, count: int) -> dict:
    """Pressures and orders of invasion side by side, boundary pores left out."""
    own, other = invasion_pressures(ours), theirs["pressure"][:count].copy()
    other[~np.isfinite(other)] = np.nan
    area = ours["area_m2"]
    # Below what is applied at the end both programs are asked the same question.
    last = np.nanmax(own) if np.any(np.isfinite(own)) else -np.inf
    invaded, expected = np.isfinite(own), other <= last * (1 + SAME)
    same = np.isclose(own, other, rtol=10 * SAME, atol=0.0) | (~invaded & ~expected)
    both = invaded & expected
    ordered = rank_correlation(ours["sequence"][both], theirs["order"][:count][both]) if both.sum() > 1 else 1.0
    return {
        "pressure": own,
        "openpnm_pressure": np.where(expected, other, np.nan),
        "area": area,
        "invaded": int(invaded.sum()),
        "openpnm_invaded": int(expected.sum()),
        "same_set": bool(np.array_equal(invaded, expected)),
        "same_pressure_share": float(same.mean()),
        "order_correlation": ordered,
    }


def rows(found: dict) -> list[tuple[str, str, str]]:
    """The table that is printed: what, meniscus, OpenPNM."""
    lines = [("pores", f"{found['pores']}", f"{found['pores']} + {found['boundary_pores']} boundary pores")]
    lines.append(("throats", f"{found['throats']}", f"{found['throats']}, {found['parallel_throats']} of them beside another"))
    if "pressure" in found:
        lines.append(("invaded pores", f"{found['invaded']}", f"{found['openpnm_invaded']}"))
        lines.append(("same invaded pores", "", "yes" if found["same_set"] else "no"))
        lines.append(("pores with the same pressure", "", f"{found['same_pressure_share']:.1%}"))
        lines.append(("order of invasion, rank correlation", "", f"{found['order_correlation']:.4f}"))
    shown = [f"{k:.5g}" if k is not None else "-" for k in (found["permeability_ours"], found["permeability"])]
    return [*lines, ("permeability (m2)", *shown)]


def draw(found: dict, picture: Path) -> None:
    """Pores colored by the pressure at which each program invades them, and both curves."""
    names = [("pressure", "meniscus"), ("openpnm_pressure", "OpenPNM, bursts only, no trapping")]
    figure, axes = plt.subplots(1, 3, figsize=(13.0, 4.2), layout="constrained", width_ratios=[1, 1, 0.8])
    places = 1e3 * found["coordinates"]
    values = np.concatenate([found[key] for key, _ in names])
    low, high = (np.nanmin(values), np.nanmax(values)) if np.any(np.isfinite(values)) else (0.0, 1.0)
    for axis, (key, name) in zip(axes, names, strict=False):
        near = [k for k in found["ends"] if np.ptp(places[k], axis=0).max() < 0.5 * np.ptp(places, axis=0).max()]
        axis.plot(*places[np.array(near, dtype=int).reshape(-1, 2)].transpose(2, 1, 0), color="0.8", lw=0.8, zorder=0)
        order = np.argsort(found["radius"])
        size = found["radius"][order] / found["radius"].max() * 90
        axis.scatter(*places[order].T, s=size, facecolor="white", edgecolor="0.5", lw=0.5)
        shown = axis.scatter(*places[order].T, s=size, c=found[key][order], vmin=low, vmax=high, cmap="viridis")
        axis.set(aspect="equal", xlabel="x (mm)", ylabel="y (mm)", title=name)
    figure.colorbar(shown, ax=axes[:2], label="capillary pressure at invasion (Pa)", shrink=0.8)
    for (key, name), line in zip(names, ("-", "--"), strict=True):
        held = np.isfinite(found[key])
        order = np.argsort(found[key][held])
        pressure, area = found[key][held][order], found["area"][held][order]
        saturation = 1.0 - np.cumsum(area) / found["area"].sum()
        axes[2].step([1.0, *saturation], [*pressure, *pressure[-1:]], line, where="post", label=name, lw=1.5)
    axes[2].set(xlabel="saturation of the displaced phase", ylabel="capillary pressure (Pa)", xlim=(0, 1))
    axes[2].legend(fontsize=8)
    figure.savefig(picture, dpi=110)
    plt.close(figure)


def main() -> None:
    """Prints the table and writes the figure."""
    parser = argparse.ArgumentParser(description="a network of meniscus in OpenPNM")
    parser.add_argument("directory", type=Path, help="output folder of a network")
    parser.add_argument("--picture", type=Path, default=Path("openpnm.png"))
    asked = parser.parse_args()
    try:
        found = measure(asked.directory)
    except (OSError, ValueError, KeyError) as error:
        raise SystemExit(f"{asked.directory}: {error}") from error
    print(f"{'':36} {'meniscus':>14}  OpenPNM")
    for name, ours, theirs in rows(found):
        print(f"{name:36} {ours:>14}  {theirs}")
    if "pressure" in found:
        draw(found, asked.picture)
        print(asked.picture)


if __name__ == "__main__":
    main()
