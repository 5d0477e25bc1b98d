"""Draws one field at one time with the interface and the solids.

Usage: field_picture.py DIR [--field pressure] [--time 0.01] [--picture field.png]
"""

import argparse
from pathlib import Path

import results
import scene


def measure(path: str | Path, field: str = "pressure", time: float | None = None) -> dict:
    """Time of the frame next to `time` (s; the last one where none is given) and the range of the field in the pore."""
    directory = Path(path)
    frame = results.frame_at(directory / "grid.pvd", time)
    low, high = scene.value_range(directory, field, [frame])
    return {"frame": frame, "field": field, "min": low, "max": high}


def draw(directory: Path, found: dict, picture: Path, size: int = scene.LONG_SIDE) -> None:
    """Writes the picture, its longer side `size` pixels."""
    plotter = scene.plotter(directory, found["frame"], size)
    scene.draw(plotter, directory, found["frame"], found["field"], (found["min"], found["max"]))
    plotter.screenshot(picture)
    plotter.close()


def main() -> None:
    """Writes the picture and prints its name."""
    parser = argparse.ArgumentParser(description="draw one field at one time")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus run`")
    parser.add_argument("--field", default="pressure", help="array of the grid; a vector is shown by its magnitude")
    parser.add_argument("--time", type=float, help="time in s, the last one by default")
    parser.add_argument("--picture", type=Path, default=Path("field.png"))
    asked = parser.parse_args()
    draw(asked.directory, measure(asked.directory, asked.field, asked.time), asked.picture)
    print(asked.picture)


if __name__ == "__main__":
    main()
