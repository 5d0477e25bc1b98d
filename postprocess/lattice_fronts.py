"""Fronts in a square lattice of discs side by side, one run to each contact angle: a still picture, or one that moves.

Usage: lattice_fronts.py DIR DIR... [--picture lattice-fronts.webp] [--times 0.1,0.2] [--rate 10]. Each DIR is a run of cases/benchmark/lattice-wide.toml.
Times in s: columns of a still, with a row for each run; without times every record becomes a frame, with the runs side by side.
"""

import argparse
import io
import math
from pathlib import Path

import matplotlib

import colors

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import results

# Width of a panel in inches, and pixels per inch.
PANEL = 2.6
DOTS = 90


def field(directory: Path, time: float) -> dict:
    """The phases on the grid at the record next to `time`: 1 in the invader, masked in the solids; the interface is where they change."""
    frame = min(results.frames(directory / "grid.pvd"), key=lambda f: abs(f.time - time))
    grid = results.read(frame.file)
    points = np.asarray(grid.points)
    x, y = np.unique(points[:, 0].round(9)), np.unique(points[:, 1].round(9))
    order = np.lexsort((points[:, 0].round(9), points[:, 1].round(9)))
    shape = (len(y), len(x))
    color = np.asarray(grid.point_data["color"])[order].reshape(shape)
    distance = np.asarray(grid.point_data["wall-distance"])[order].reshape(shape)
    return {"time": frame.time, "x": 1e3 * x, "y": 1e3 * y, "color": color, "distance": distance}


def draw(ax, found: dict, title: str) -> None:
    """One panel."""
    x, y = found["x"], found["y"]
    ax.contourf(x, y, found["color"], levels=[-1.0, 0.5, 2.0], colors=[colors.NON_WETTING, colors.WETTING])
    ax.contour(x, y, found["color"], levels=[0.5], colors=colors.MENISCUS, linewidths=1.2)
    ax.contourf(x, y, found["distance"], levels=[-1.0, 0.0], colors=[colors.SOLID], zorder=3)
    ax.contour(x, y, found["distance"], levels=[0.0], colors=colors.WALL, linewidths=1.0, zorder=3)
    ax.set(aspect="equal", xticks=[], yticks=[])
    ax.set_title(title, fontsize=9)


def angle(directory: Path) -> float:
    """Requested contact angle in degrees."""
    return math.degrees(results.report(directory)["case"]["model"]["sph"]["wetting_model"]["young"]["contact_angle"])


def sheet(rows: list[list[tuple[Path, float]]]) -> plt.Figure:
    """A figure with a panel for each run and time in s."""
    figure, axes = plt.subplots(len(rows), len(rows[0]), figsize=(PANEL * len(rows[0]), 1.12 * PANEL * len(rows)), squeeze=False)
    for row, panels in zip(axes, rows, strict=True):
        for ax, (directory, time) in zip(row, panels, strict=True):
            found = field(directory, time)
            draw(ax, found, f"{angle(directory):.0f}°, {1e3 * found['time']:.0f} ms")
    figure.tight_layout(pad=0.4)
    return figure


def image(figure: plt.Figure) -> Image.Image:
    """The figure in pixels."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=DOTS)
    plt.close(figure)
    return Image.open(buffer).convert("RGB")


def main() -> None:
    """Writes the picture and prints its name."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directories", type=Path, nargs="+", help="output folders of `meniscus run`")
    parser.add_argument("--picture", type=Path, default=Path("lattice-fronts.webp"))
    parser.add_argument("--times", default="", help="in s, for a still")
    parser.add_argument("--rate", type=int, default=10, help="frames per second")
    asked = parser.parse_args()
    if asked.times:
        times = [float(time) for time in asked.times.split(",")]
        image(sheet([[(directory, time) for time in times] for directory in asked.directories])).save(asked.picture, quality=85)
    else:
        times = [frame.time for frame in results.frames(asked.directories[0] / "grid.pvd")]
        images = [image(sheet([[(directory, time) for directory in asked.directories]])) for time in times]
        images[0].save(asked.picture, save_all=True, append_images=images[1:], duration=round(1000 / asked.rate), loop=0, quality=60, method=6)
    print(asked.picture)


if __name__ == "__main__":
    main()
