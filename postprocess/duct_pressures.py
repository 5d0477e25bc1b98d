"""Pressures along a duct that lies along x, with a meniscus across it: their slopes in both fluids and their jump.

Usage: duct_pressures.py DIR [--from SECONDS]

Each slope is that of a line through the particles of a fluid that lie at least a width of the duct from the meniscus
and the ends; the jump is the difference of both lines at the mean place of the meniscus. Means over the times from the
given one on, with their standard errors.
"""

import argparse

import numpy as np
import pyvista as pv


def of(block: pv.DataSet) -> tuple[float, float, float]:
    """Slope (Pa/m) on the left and on the right, and jump from left to right (Pa)."""
    fluid = block["phase"] <= 1
    points, phase, pressure = block.points[fluid], block["phase"][fluid], block["pressure"][fluid]
    x, width = points[:, 0], float(np.ptp(points[:, 1]))
    is_left = phase == phase[x.argmin()]
    meniscus = float(x.min() + np.ptp(x) * is_left.mean())
    inside = (np.abs(x - meniscus) > width) & (x > x.min() + width) & (x < x.max() - width)
    left, right = (np.polyfit(x[side] - meniscus, pressure[side], 1) for side in (inside & is_left, inside & ~is_left))
    return float(left[0]), float(right[0]), float(right[1] - left[1])


def measure(path: str, start: float = 0.0) -> dict:
    """Means and standard errors of both slopes (Pa/m) and of the jump (Pa), from a time (s) on."""
    reader = pv.get_reader(f"{path}/particles.pvd")
    found = []
    for time in reader.time_values:
        if time >= start:
            reader.set_active_time_value(time)
            found.append(of(reader.read()[0]))
    means, errors = np.mean(found, axis=0), np.std(found, axis=0) / np.sqrt(len(found))
    names = ["slope on the left in Pa/m", "slope on the right in Pa/m", "jump in Pa"]
    return {name: (float(mean), float(error)) for name, mean, error in zip(names, means, errors, strict=True)}


def main() -> None:
    """Print both slopes and the jump."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path")
    parser.add_argument("--from", dest="start", type=float, default=0.0)
    arguments = parser.parse_args()
    for name, (mean, error) in measure(arguments.path, arguments.start).items():
        print(f"{name:27} {mean:10.2f} +- {error:.2f}")


if __name__ == "__main__":
    main()
