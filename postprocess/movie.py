"""Makes a movie of one field with the interface and the solids, one color scale for all frames.

Usage: movie.py DIR [--field pressure] [--movie movie.mp4] [--rate 12]; a name that ends in .gif gives an animated GIF.
"""

import argparse
from pathlib import Path

import results
import scene


def measure(path: str | Path, field: str = "pressure") -> dict:
    """The frames in order of time and the range of the field over all of them."""
    directory = Path(path)
    frames = results.frames(directory / "grid.pvd")
    low, high = scene.value_range(directory, field, frames)
    return {"frames": frames, "field": field, "min": low, "max": high}


def main() -> None:
    """Writes the movie and prints its name."""
    parser = argparse.ArgumentParser(description="make a movie of one field")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus run`")
    parser.add_argument("--field", default="pressure", help="array of the grid; a vector is shown by its magnitude")
    parser.add_argument("--movie", type=Path, default=Path("movie.mp4"))
    parser.add_argument("--rate", type=int, default=12, help="frames per second")
    asked = parser.parse_args()
    found = measure(asked.directory, asked.field)
    plotter = scene.plotter(asked.directory, found["frames"][0])
    if asked.movie.suffix == ".gif":
        plotter.open_gif(str(asked.movie), fps=asked.rate)
    else:
        plotter.open_movie(str(asked.movie), framerate=asked.rate)
    for frame in found["frames"]:
        scene.draw(plotter, asked.directory, frame, asked.field, (found["min"], found["max"]))
        plotter.write_frame()
    plotter.close()
    print(asked.movie)


if __name__ == "__main__":
    main()
