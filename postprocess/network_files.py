"""Reads the output folder of a pore network: its tables, its description and the measures of its report. SI units."""

import csv
import json
import math
from pathlib import Path

import numpy as np

SIDES = ("left", "right", "bottom", "top")


def table(path: Path) -> dict[str, np.ndarray]:
    """The columns of a table by name: numbers (NaN where a cell is empty), flags as booleans, words."""
    with path.open(newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    return {name: column([row[i] for row in rows]) for i, name in enumerate(header)}


def column(cells: list[str]) -> np.ndarray:
    """Cells as numbers where all are numbers or empty, as booleans where all are True or False, else as words."""
    if cells and all(cell in ("True", "False") for cell in cells):
        return np.array([cell == "True" for cell in cells])
    try:
        return np.array([float(cell) if cell else math.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def description(folder: Path) -> dict:
    """The content of network.json."""
    return json.loads((folder / "network.json").read_text(encoding="utf-8"))


def measures(folder: Path) -> dict[str, float]:
    """The measures of report.json by name, those that are numbers; none where there is no report."""
    path = folder / "report.json"
    if not path.is_file():
        return {}
    found = json.loads(path.read_text(encoding="utf-8")).get("measures", {})
    return {name: float(reading["value"]) for name, reading in found.items() if reading.get("value") is not None}
