"""Draws what a thin film obeys: the ways of its particles, its shape in similarity variables, the law of Cox and Voinov.

Usage: film_laws.py DIR [--picture film_laws.png]

Times and lengths are divided by the scales of the case, told by `--length` and `--time` in SI units.
"""

import argparse
from pathlib import Path

import matplotlib
import numpy as np

import results

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Particles or nodes whose way is drawn, and profiles that are laid over one another.
WAYS = 24
SHAPES = 8
# Exponent of Tanner's law for a droplet between two plates, x ~ t^(1/7).
TANNER = 1.0 / 7.0
# The law of Cox and Voinov is fitted to this window of scaled time, at times that are even in the logarithm, as the program does.
WINDOW = (1.0e-2, 1.0)
RECORDS = 80


def measure(path: str | Path, length: float, time: float) -> dict:
    """Scaled: times, ways (a row per time), shapes (eta, f, time), and the series of contact line and slope."""
    directory = Path(path)
    times, ways, shapes = [], [], []
    for frame, line in zip(results.frames(directory / "particles.pvd"), results.frames(directory / "interface.pvd"), strict=True):
        scaled = frame.time / time
        times.append(scaled)
        ways.append(np.asarray(results.read(frame.file).points)[:, 0] / length)
        if scaled > 0.0:
            points = np.asarray(results.read(line.file).points)
            shapes.append((points[:, 0] / length / scaled**TANNER, points[:, 1] * scaled**TANNER, scaled))
    columns = results.series(directory / "series.csv")
    seconds, line = columns["time_s"] / time, columns["contact_line_position_m"] / length
    return {
        "times": np.array(times),
        "ways": np.array(ways),
        "shapes": shapes,
        "series-times": seconds,
        "contact-line": line,
        "slope": np.tan(np.radians(columns["contact_angle_deg"])),
    }


def cox_voinov(found: dict, rest: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Scaled v ln(x/d) and cubed slope over that of rest within the window, with the fitted factor."""
    times = np.geomspace(*WINDOW, RECORDS)
    x = np.interp(np.log(times), np.log(found["series-times"][1:]), found["contact-line"][1:])
    slope = np.interp(np.log(times), np.log(found["series-times"][1:]), found["slope"][1:])
    v = np.gradient(x, times)
    cube = (slope / rest) ** 3 - 1.0
    (factor, product), *_ = np.linalg.lstsq(np.column_stack([v * np.log(x), -v]), cube, rcond=None)
    return v * (np.log(x) - product / factor), cube + 1.0, float(factor)


def draw(found: dict, rest: float | None, picture: Path) -> None:
    """Writes the figure."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13.0, 4.0), constrained_layout=True)
    later = found["times"] > 0.0
    count = found["ways"].shape[1]
    for i in np.linspace(count // 2, count - 1, WAYS).astype(int):
        left.loglog(found["times"][later], found["ways"][later, i], color="gray", linewidth=0.6)
    left.loglog(found["times"][later], found["ways"][later, -1], color="C0", label="last particle or node")
    law = found["ways"][-1, -1] * (found["times"][later] / found["times"][-1]) ** TANNER
    left.loglog(found["times"][later], law, color="black", linestyle="--", label="Tanner's law, 1/7")
    left.set_ylim(bottom=0.05)
    left.set_xlabel("scaled time (-)")
    left.set_ylabel("scaled place (-)")
    left.legend(fontsize=7)
    chosen = np.unique(np.geomspace(1, len(found["shapes"]), SHAPES).astype(int)) - 1
    for index, color in zip(chosen, plt.cm.viridis(np.linspace(0.0, 0.9, len(chosen))), strict=True):
        eta, f, time = found["shapes"][index]
        middle.plot(eta, f / found["shapes"][-1][1].max(), color=color, label=f"{time:.3g}")
    middle.set_xlim(-1.2, 1.2)
    middle.set_xlabel(r"$\eta = x\,t^{-1/7}$ (-)")
    middle.set_ylabel(r"$t^{1/7} h$ over its last maximum (-)")
    middle.legend(title="scaled time", fontsize=7)
    if rest is None:
        right.loglog(found["series-times"][1:], found["slope"][1:])
        right.set_xlabel("scaled time (-)")
        right.set_ylabel("slope of the contact angle (-)")
    else:
        across, cube, factor = cox_voinov(found, rest)
        right.plot(across, cube, marker=".", linestyle="none", label="measured")
        right.plot(across, 1.0 + factor * across, color="black", linestyle="--", label=f"1 + {factor:.2f} v ln(x/d)")
        right.set_xlabel("v ln(x/d), scaled (-)")
        right.set_ylabel(r"$(\theta/\theta_e)^3$ (-)")
        right.legend(fontsize=7)
    figure.savefig(picture, dpi=150)
    plt.close(figure)


def main() -> None:
    """Writes the figure and prints its name."""
    parser = argparse.ArgumentParser(description="ways, self-similar shape and Cox-Voinov law of a thin film")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus run` for a [thin-film] case")
    parser.add_argument("--picture", type=Path, default=Path("film_laws.png"))
    parser.add_argument("--length", type=float, default=1.0, help="scale of lengths in m")
    parser.add_argument("--time", type=float, default=1.0, help="scale of time in s")
    parser.add_argument("--rest", type=float, help="slope at rest, of a partially wetting film")
    asked = parser.parse_args()
    draw(measure(asked.directory, asked.length, asked.time), asked.rest, asked.picture)
    print(asked.picture)


if __name__ == "__main__":
    main()
