"""Draws a thin film: its profiles, its height over place and time, and the way of its contact line.

Usage: film_profiles.py DIR [--picture film_profiles.png]
"""

import argparse
from pathlib import Path

import matplotlib
import numpy as np

import results

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Profiles shown, spread over the records so that early ones, which change fast, stand closer.
SHOWN = 8
# Exponent of Tanner's law for a droplet between two plates, x ~ t^(1/7).
TANNER = 1.0 / 7.0


def measure(path: str | Path) -> dict:
    """Places (m), times (s), heights (m, a row per time), and the series of the contact line (s, m)."""
    directory = Path(path)
    times, heights = [], []
    for frame in results.frames(directory / "interface.pvd"):
        line = np.asarray(results.read(frame.file).points)
        times.append(frame.time)
        heights.append(line[:, 1])
    columns = results.series(directory / "series.csv")
    return {
        "x": line[:, 0],
        "times": np.array(times),
        "heights": np.array(heights),
        "series-times": columns["time_s"],
        "contact-line": columns["contact_line_position_m"],
    }


def draw(found: dict, picture: Path) -> None:
    """Writes the figure."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13.0, 4.0), constrained_layout=True)
    x, times, heights = 1e3 * found["x"], found["times"], 1e3 * found["heights"]
    chosen = np.unique((np.linspace(0.0, 1.0, SHOWN) ** 2 * (len(times) - 1)).round().astype(int))
    for index, color in zip(chosen, plt.cm.viridis(np.linspace(0.0, 0.9, len(chosen))), strict=True):
        left.plot(x, heights[index], color=color, label=f"{times[index]:.3g} s")
    left.set_xlabel("x (mm)")
    left.set_ylabel("film height (mm)")
    left.legend(fontsize=7)
    shown = middle.pcolormesh(x, times, heights, shading="nearest", cmap="viridis")
    figure.colorbar(shown, ax=middle, label="film height (mm)")
    middle.plot(1e3 * found["contact-line"], found["series-times"], color="white", label="contact line")
    middle.set_xlim(x[0], x[-1])
    middle.set_xlabel("x (mm)")
    middle.set_ylabel("time (s)")
    middle.legend(loc="lower left", fontsize=7)
    later = found["series-times"] > 0.0
    time, line = found["series-times"][later], 1e3 * found["contact-line"][later]
    right.loglog(time, line, marker=".", label="contact line")
    known = np.isfinite(line)
    if known.any():
        law = line[known][-1] * (time / time[known][-1]) ** TANNER
        right.loglog(time, law, color="black", linestyle="--", label="Tanner's law, 1/7")
    right.set_xlabel("time (s)")
    right.set_ylabel("contact line (mm)")
    right.legend(fontsize=7)
    figure.savefig(picture, dpi=150)
    plt.close(figure)


def main() -> None:
    """Writes the figure and prints its name."""
    parser = argparse.ArgumentParser(description="profiles, space-time plot and contact line of a thin film")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus run` for a [thin-film] case")
    parser.add_argument("--picture", type=Path, default=Path("film_profiles.png"))
    asked = parser.parse_args()
    draw(measure(asked.directory), asked.picture)
    print(asked.picture)


if __name__ == "__main__":
    main()
