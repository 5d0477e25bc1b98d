"""Reads an output folder of meniscus: collections of VTK files, the series and the report.

The names of the output contract stand here and nowhere else. Everything is in SI units.
"""

import csv
import json
import math
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyvista as pv

# Array name -> number of components.
PARTICLE_ARRAYS = {
    "id": 1,
    "phase": 1,
    "velocity": 3,
    "pressure": 1,
    "density": 1,
    "volume": 1,
    "color": 1,
    "normal": 3,
    "curvature": 1,
    "surface-force": 3,
    "line-force": 3,
    "wall-distance": 1,
    "wall-normal": 3,
}
GRID_ARRAYS = {"velocity": 3, "pressure": 1, "color": 1, "wall-distance": 1}
INTERFACE_ARRAYS = {"curvature": 1}
SERIES_COLUMNS = [
    "time_s",
    "step",
    "dt_s",
    "saturation",
    "interface_length_m",
    "wetted_length_m",
    "capillary_pressure_Pa",
    "contact_angle_deg",
    "kinetic_energy_J_per_m",
    "max_speed_m_per_s",
    "density_error",
    "ppe_iterations",
]
# The same of thin films, which have no grid.
FILM_PARTICLE_ARRAYS = {"id": 1, "phase": 1, "velocity": 3, "pressure": 1, "volume": 1, "film-height": 1}
FILM_SERIES_COLUMNS = [
    "time_s",
    "step",
    "dt_s",
    "contact_line_position_m",
    "last_particle_position_m",
    "contact_angle_deg",
    "center_height_m",
    "area_m2",
    "energy_J_per_m",
    "max_speed_m_per_s",
]
# A film around an axis has these in place of values per meter.
AROUND_AXIS = {"area_m2": "volume_m3", "energy_J_per_m": "energy_J"}
# Of networks: regions as polygons with arrays on cells, and columns of a displacement.
REGION_ARRAYS = {
    "pore": 1,
    "phase": 1,
    "trapped": 1,
    "sequence": 1,
    "capillary-pressure-at-invasion": 1,
    "displaced-saturation-at-invasion": 1,
}
NETWORK_SERIES_COLUMNS = [
    "displaced_pore_volumes",
    "step",
    "half_cycle",
    "saturation",
    "capillary_pressure_Pa",
    "trapped_saturation",
    "invaded_pores",
    "bursts",
    "touches",
    "overlaps",
]
# The same of a displacement in time, and what it has in place of that where there is a depth.
DYNAMIC_SERIES_COLUMNS = [
    "time_s",
    "step",
    "injected_pore_volumes",
    "saturation",
    "pressure_difference_Pa",
    "inflow_m2_per_s",
    "capillary_number",
    "interface_length_m",
    "finger_width_m",
    "fingers",
    "invaded_pores",
    "bursts",
    "touches",
    "overlaps",
]
WITH_DEPTH = {"inflow_m2_per_s": "inflow_m3_per_s"}
NETWORK_FILES = ["pores.csv", "throats.csv", "openpnm.csv", "network.json", "pores.vtu", "throats.vtu"]
UNITS = {
    "velocity": "m/s",
    "pressure": "Pa",
    "density": "kg/m³",
    "volume": "m²",
    "curvature": "1/m",
    "surface-force": "N/m³",
    "line-force": "N/m³",
    "wall-distance": "m",
}


@dataclass(frozen=True)
class Frame:
    """One file of a collection with its time in s."""

    time: float
    file: Path


def frames(collection: Path) -> list[Frame]:
    """The files of a .pvd collection in the order in which it lists them."""
    data_sets = ET.parse(collection).getroot().iter("DataSet")
    return [Frame(float(d.attrib["timestep"]), collection.parent / d.attrib["file"]) for d in data_sets]


def series(path: Path) -> dict[str, np.ndarray]:
    """The columns of series.csv by name; cells that hold no number are NaN.

    A last row without its end, as a run leaves it that goes on or was killed, does not count.
    """
    text = path.read_text(encoding="utf-8")
    rows = list(csv.reader(text[: text.rfind("\n") + 1].splitlines()))
    header, rows = rows[0], rows[1:]

    def number(cell: str) -> float:
        try:
            return float(cell)
        except ValueError:
            return math.nan

    return {name: np.array([number(row[i]) for row in rows]) for i, name in enumerate(header)}


def report(directory: Path) -> dict:
    """The content of report.json."""
    return json.loads((directory / "report.json").read_text(encoding="utf-8"))


def is_film(directory: Path) -> bool:
    """Whether the folder is that of a thin film; one without a report is taken for a flow."""
    return "thin-film" in models(directory)


def is_network(directory: Path) -> bool:
    """Whether the folder is that of a pore network; one without a report is taken for a flow."""
    return "network" in models(directory)


def series_columns(directory: Path) -> list[str]:
    """The columns that the series of a run has."""
    if is_network(directory):
        displacement = models(directory)["network"].get("displacement") or {}
        if not displacement.get("dynamic"):
            return NETWORK_SERIES_COLUMNS
        others = WITH_DEPTH if report(directory)["case"].get("depth") else {}
        return [others.get(name, name) for name in DYNAMIC_SERIES_COLUMNS]
    if not is_film(directory):
        return SERIES_COLUMNS
    if models(directory)["thin-film"].get("symmetry") == "axis":
        return [AROUND_AXIS.get(name, name) for name in FILM_SERIES_COLUMNS]
    return FILM_SERIES_COLUMNS


def models(directory: Path) -> dict:
    """The model of the case by its name; none without a report."""
    if not (directory / "report.json").is_file():
        return {}
    return report(directory).get("case", {}).get("model", {})


def requested_angle(content) -> float | None:
    """The contact angle in degrees that the case asks for: the first such key anywhere in the resolved case.

    The case may stand in the report as a table or as the text of a case file.
    """
    if isinstance(content, str):
        match = re.search(r"^\s*contact-angle-deg\s*=\s*([-+.\deE_]+)", content, re.MULTILINE)
        return float(match.group(1)) if match else None
    items = content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
    for key, value in items:
        if isinstance(value, int | float) and key == "contact-angle-deg":
            return float(value)
        if isinstance(value, int | float) and key in ("contact_angle", "contact-angle"):
            return math.degrees(value)
        found = requested_angle(value)
        if found is not None:
            return found
    return None


def label(field: str) -> str:
    """Axis label of a field with its unit."""
    return f"{field} ({UNITS[field]})" if field in UNITS else field


def frame_at(collection: Path, time: float | None) -> Frame:
    """The frame next to a time in s, or the last one."""
    found = frames(collection)
    if not found:
        raise ValueError(f"{collection} lists no file")
    return found[-1] if time is None else min(found, key=lambda frame: abs(frame.time - time))


def read(path: Path):
    """One VTK file as a pyvista data set."""
    return pv.read(path)
