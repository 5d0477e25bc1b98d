"""Patterns of a radial displacement over wettability and rate: table, and one map of patterns and pressures.

Usage: radial_patterns.py DIR [--picture radial-patterns.webp]

DIR is the folder of the study `studies/benchmark/radial-micromodel.toml`. At breakthrough: the share of the pores within the chip that is invaded, the mean
width of fingers, and the box dimension of the invaded pores, between 3 and 30 mm.
"""

import argparse
import io
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.collections import PolyCollection
from PIL import Image

import colors
from gallery_results import rows_of

RADIUS = 0.09  # m, of the chip
BOXES = np.geomspace(3.0e-3, 30.0e-3, 8)  # m


def box_dimension(points: np.ndarray) -> float:
    """The slope of the number of boxes that hold a point over the inverse size of a box."""
    counts = [len(np.unique(np.floor(points / size), axis=0)) for size in BOXES]
    return -float(np.polyfit(np.log(BOXES), np.log(counts), 1)[0])


def measure(directory: Path, row: dict[str, str]) -> dict[str, float]:
    """The measures of a run."""
    pores = [pore for pore in rows_of(directory / "runs" / row["run"] / "pores.csv") if pore["outlet"] == "False"]
    area = np.array([float(pore["area_m2"]) for pore in pores])
    invaded = np.array([pore["phase"] == "wetting" for pore in pores])
    points = np.array([[float(pore["x_m"]), float(pore["y_m"])] for pore in pores])
    return {
        "angle": float(row["angle"]),
        "rate": float(row["flow-rate"]),
        "share": float(area[invaded].sum() / area.sum()),
        "finger": float(row["finger-width-m"]),
        "dimension": box_dimension(points[invaded]),
        "largest": float(row["largest-pressure-difference-Pa"]),
        "trapped": float(row["trapped-saturation"]),
        "cpu": float(row.get("cpu-s") or math.nan),
    }


def polygons(directory: Path, run: str) -> list[np.ndarray]:
    """The invaded elements in mm."""
    file = sorted((directory / "runs" / run / "regions").glob("*.vtu"))[-1]
    mesh = pyvista.read(file)
    points, cells, found = 1e3 * np.asarray(mesh.points)[:, :2], mesh.cells, []
    at, share = 0, np.asarray(mesh["invading-share"])
    for cell in range(mesh.n_cells):
        if share[cell] > 0.5:
            found.append(points[cells[at + 1 : at + 1 + cells[at]]])
        at += 1 + cells[at]
    return found


def picture(directory: Path, found: list[tuple[dict[str, str], dict[str, float]]], to: Path) -> None:
    """Patterns by angle (down) and rate (across), and pressures over the injected volume below."""
    rates = sorted({measures["rate"] for _, measures in found})
    angles = sorted({measures["angle"] for _, measures in found}, reverse=True)
    figure, axes = plt.subplots(len(angles) + 1, len(rates), figsize=(2.2 * len(rates), 1.85 * (len(angles) + 1)), layout="constrained")
    for axis in axes[:-1].flat:
        axis.set(xlim=(-95, 95), ylim=(-95, 95), aspect="equal", xticks=[], yticks=[])
        axis.add_patch(plt.Circle((0, 0), 1e3 * RADIUS, facecolor=colors.NON_WETTING, alpha=0.35))
    shades = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, len(angles)))
    for row, measures in found:
        down, across = angles.index(measures["angle"]), rates.index(measures["rate"])
        axis = axes[down, across]
        axis.add_collection(PolyCollection(polygons(directory, row["run"]), facecolor=colors.WETTING_TRAPPED, edgecolor="none"))
        if down == 0:
            axis.set_title(f"{1e9 * measures['rate']:g} mm³/s")
        if across == 0:
            axis.set_ylabel(f"{measures['angle']:g}°")
        series = rows_of(directory / "runs" / row["run"] / "series.csv")
        injected, pressure = (np.array([float(it[name]) for it in series[1:]]) for name in ("injected_pore_volumes", "pressure_difference_Pa"))
        axes[-1, across].plot(injected, pressure, color=shades[down], label=f"{measures['angle']:g}°", linewidth=1)
    axes[-1, len(rates) // 2].set_xlabel("injected volume over that of the pores and the rim")
    axes[-1, 0].set_ylabel("pressure in Pa")
    axes[-1, 0].legend(fontsize="x-small")
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=110)
    Image.open(buffer).convert("RGB").save(to, quality=80)


def main() -> None:
    """Prints the table and draws the picture."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    done = [row for row in rows_of(arguments.directory / "table.csv") if row["status"] == "done"]
    found = [(row, measure(arguments.directory, row)) for row in done]
    rates = sorted({measures["rate"] for _, measures in found})
    print("| angle through the water | " + " | ".join(f"{1e9 * rate:g} mm³/s" for rate in rates) + " |")
    print("|---" * (1 + len(rates)) + "|")
    for angle in sorted({measures["angle"] for _, measures in found}, reverse=True):
        of = {measures["rate"]: measures for _, measures in found if measures["angle"] == angle}
        cells = [f"{of[rate]['share']:.2f}, {1e3 * of[rate]['finger']:.1f} mm, {of[rate]['dimension']:.2f}" if rate in of else "–" for rate in rates]
        print(f"| {angle:g} | " + " | ".join(cells) + " |")
    if arguments.picture:
        picture(arguments.directory, found, arguments.picture)


if __name__ == "__main__":
    main()
