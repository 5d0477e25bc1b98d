"""Draws base width and angle of drops on the wall y = 0 against time, of any runs in one figure: flows and thin films alike.

Usage: spreading.py DIR [DIR ...] [--above 1.5e-4] [--base 3.661e-3] [--angle 25] [--picture spreading.png]
                    [--through-base 3.3e-3] [--through-angle 30] [--at 0.1]

The cap of each run, a circle for a flow and a parabola for a film, as each rests, is fitted by least squares to the interface farther
from the wall than `--above`, and continued to the wall. Near the wall a flow has too few particles to see its interface, and a film is
bent by what makes its contact line move.
"""

import argparse
import math
from pathlib import Path

import matplotlib
import numpy as np

import results

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Fewest points that a circle is fitted to.
FEWEST = 5


def cap(points: np.ndarray, is_film: bool) -> tuple[float, float]:
    """Base width in m and angle in degrees of the circle or parabola through the points, where it meets y = 0.

    The circle y = a + b x + k (x^2 + y^2)/2 is linear in its unknowns, and a flat cap has no radius that runs away.
    """
    x, y = points[:, 0], points[:, 1]
    square = 0.5 * x**2 if is_film else 0.5 * (x**2 + y**2)
    (a, b, k), *_ = np.linalg.lstsq(np.column_stack([np.ones_like(x), x, square]), y, rcond=None)
    # On y = 0 both are a + b x + k x^2/2 = 0 with the slope b + k x.
    inside = b * b - 2.0 * k * a
    if not k < 0.0 or inside <= 0.0:
        return math.nan, math.nan
    return 2.0 * math.sqrt(inside) / -k, math.degrees(math.atan(math.sqrt(inside)))


def measure(path: str | Path, above: float) -> dict:
    """Times in s, base widths in m and angles in degrees, and whether the run is a film."""
    directory = Path(path)
    is_film = results.is_film(directory)
    times, bases, angles = [], [], []
    for frame in results.frames(directory / "interface.pvd"):
        # An isolated particle has a line of its own around it.
        drop = results.read(frame.file).connectivity("largest")
        points = np.asarray(drop.points)[:, :2]
        points = points[points[:, 1] > above]
        base, angle = cap(points, is_film) if len(points) >= FEWEST else (math.nan, math.nan)
        times.append(frame.time)
        bases.append(base)
        angles.append(angle)
    return {
        "time": np.array(times),
        "base": np.array(bases),
        "angle": np.array(angles),
        "is-film": is_film,
    }


def passing(times: np.ndarray, values: np.ndarray, level: float) -> float:
    """The first time at which the values, linear between records, pass the level; nan where they do not."""
    before = (values - level) * np.sign(values[0] - level) > 0.0
    if before.all():
        return math.nan
    after = int(np.argmin(before))
    if after == 0:
        return float(times[0])
    part = (level - values[after - 1]) / (values[after] - values[after - 1])
    return float(times[after - 1] + part * (times[after] - times[after - 1]))


def draw(found: dict[str, dict], base: float | None, angle: float | None, picture: Path) -> None:
    """Writes the figure; `found` holds a run under each label."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    for label, run in found.items():
        style = {"linestyle": "--"} if run["is-film"] else {"marker": ".", "linewidth": 0.8}
        left.plot(run["time"], 1.0e3 * run["base"], label=label, **style)
        right.plot(run["time"], run["angle"], label=label, **style)
    for axes, rest in ((left, base and 1.0e3 * base), (right, angle)):
        if rest is not None:
            axes.axhline(rest, color="black", linewidth=0.8, label="cap at rest")
        axes.set_xlabel("time (s)")
    left.set_ylabel("base width (mm)")
    right.set_ylabel("angle of the cap at the wall (deg)")
    right.legend(fontsize=7)
    figure.savefig(picture, dpi=150)
    plt.close(figure)


def main() -> None:
    """Writes the figure, prints base and angle of each run at its end, what is asked for on the way, and its name."""
    parser = argparse.ArgumentParser(description="base width against time of drops on a wall")
    parser.add_argument("directories", type=Path, nargs="+", help="output folders of `meniscus run`")
    parser.add_argument("--above", type=float, default=1.5e-4, help="distance in m from the wall that the fit leaves out")
    parser.add_argument("--base", type=float, help="base width at rest in m, drawn as a line")
    parser.add_argument("--angle", type=float, help="angle at rest in degrees, drawn as a line")
    parser.add_argument("--through-base", type=float, help="prints when each base passes this width in m")
    parser.add_argument("--through-angle", type=float, help="prints when each angle passes this one in degrees")
    parser.add_argument("--at", type=float, help="prints each base at this time in s")
    parser.add_argument("--picture", type=Path, default=Path("spreading.png"))
    asked = parser.parse_args()
    found = {directory.name: measure(directory, asked.above) for directory in asked.directories}
    draw(found, asked.base, asked.angle, asked.picture)
    for label, run in found.items():
        told = f"{label}: base {1.0e3 * run['base'][-1]:.4g} mm, angle {run['angle'][-1]:.4g} deg"
        if asked.through_base is not None:
            passed = passing(run["time"], run["base"], asked.through_base)
            told += f", base {1.0e3 * asked.through_base:.4g} mm at {passed:.4f} s"
        if asked.through_angle is not None:
            passed = passing(run["time"], run["angle"], asked.through_angle)
            told += f", angle {asked.through_angle:.4g} deg at {passed:.4f} s"
        if asked.at is not None:
            told += f", base {1.0e3 * np.interp(asked.at, run['time'], run['base']):.4g} mm at {asked.at:.4g} s"
        print(told)
    print(asked.picture)


if __name__ == "__main__":
    main()
