"""Makes a movie of one field with the interface and the solids, one color scale for all frames.

Usage: movie.py DIR [--field pressure] [--movie movie.mp4] [--rate 12] [--size 1280]. A name that ends in .gif or .webp gives a picture
that moves in a page and begins again at its end.
"""

import argparse
from pathlib import Path

import imageio.v3 as iio
import numpy as np

import results
import scene

# Formats that pages show as pictures.
PICTURES = (".gif", ".webp")


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
    parser.add_argument("--size", type=int, default=scene.LONG_SIDE, help="pixels of the longer side")
    asked = parser.parse_args()
    found = measure(asked.directory, asked.field)
    plotter = scene.plotter(asked.directory, found["frames"][0], asked.size)
    images = []
    # Axes and bar find their places with the first picture and keep them from then on.
    scene.draw(plotter, asked.directory, found["frames"][0], asked.field, (found["min"], found["max"]))
    plotter.screenshot(return_img=True)
    for frame in found["frames"]:
        scene.draw(plotter, asked.directory, frame, asked.field, (found["min"], found["max"]))
        images.append(plotter.screenshot(return_img=True))
    plotter.close()
    write(asked.movie, images, asked.rate)
    print(asked.movie)


def write(movie: Path, images: list[np.ndarray], rate: int) -> None:
    """Writes the images at `rate` frames per second."""
    if movie.suffix in PICTURES:
        iio.imwrite(movie, np.stack(images), duration=1000 / rate, loop=0)
    else:
        iio.imwrite(movie, np.stack(images), plugin="FFMPEG", fps=rate)


if __name__ == "__main__":
    main()
