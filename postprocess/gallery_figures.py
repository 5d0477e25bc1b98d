"""Puts the curves of studies and a picture of their finest run among the figures of the documentation.

Usage: gallery_figures.py DIR [DIR ...] [--figures docs/figures] [--run NAME] [--field velocity] [--width 560]

A study folder `study-NAME` gives `NAME-1.svg`, `NAME-2.svg`, ... and `NAME-picture.webp`: the picture of the run, or
one of its fields.
"""

import argparse
import shutil
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import field_picture
import study_panel

DPI = 100
QUALITY = 85


def measure(path: str | Path, run: str | None = None) -> dict:
    """Name of a study folder, paths of its curves, picture of `run` or of its complete run with most unknowns."""
    directory = Path(path)
    complete = [found for found in study_panel.measure(directory)["runs"] if run in (None, found["name"])]
    finest = max(complete, key=lambda found: float(found["row"].get("unknowns") or 0), default=None)
    return {
        "name": directory.resolve().name.removeprefix("study-"),
        "curves": sorted(directory.glob("curve-*.svg")),
        "picture": finest and finest["picture"],
    }


def shrink(picture: Path, target: Path, width: int) -> None:
    """Writes the picture `width` pixels wide in the format of the target's name."""
    pixels = plt.imread(picture)
    height = width * pixels.shape[0] / pixels.shape[1]
    figure = plt.figure(figsize=(width / DPI, height / DPI), dpi=DPI)
    axis = figure.add_axes((0, 0, 1, 1))
    axis.axis("off")
    axis.imshow(pixels, interpolation="antialiased", aspect="auto")
    figure.savefig(target, dpi=DPI, pil_kwargs={"quality": QUALITY})
    plt.close(figure)


def write(directory: Path, figures: Path, run: str | None = None, field: str | None = None, width: int = 560) -> list:
    """Writes the curves of a study folder and the picture of a run, and returns their paths."""
    found = measure(directory, run)
    if found["picture"] is None:
        raise SystemExit(f"{directory} has no complete run {run or ''}: do the study first")
    figures.mkdir(parents=True, exist_ok=True)
    written = [figures / f"{found['name']}-{index}.svg" for index in range(1, len(found["curves"]) + 1)]
    for curve, target in zip(found["curves"], written, strict=True):
        shutil.copyfile(curve, target)
    target = figures / f"{found['name']}-picture.webp"
    with tempfile.TemporaryDirectory() as folder:
        picture = found["picture"]
        if field:
            output, picture = picture.parent, Path(folder) / "field.png"
            field_picture.draw(output, field_picture.measure(output, field), picture)
        shrink(picture, target, width)
    return [*written, target]


def main() -> None:
    """Writes the figures and prints their names."""
    parser = argparse.ArgumentParser(description="figures of the documentation from study folders")
    parser.add_argument("directories", type=Path, nargs="+", help="folders of `meniscus study run`")
    parser.add_argument("--figures", type=Path, default=Path("docs/figures"))
    parser.add_argument("--run", help="the run whose picture is taken; the finest complete one by default")
    parser.add_argument("--field", help="array of the grid that is drawn in place of the particles")
    parser.add_argument("--width", type=int, default=560, help="pixels of the picture")
    asked = parser.parse_args()
    for directory in asked.directories:
        for figure in write(directory, asked.figures, asked.run, asked.field, asked.width):
            print(figure)


if __name__ == "__main__":
    main()
