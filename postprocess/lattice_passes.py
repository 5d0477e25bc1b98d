"""The curvature at which a front passes a row of a square lattice, and where its contact lines lie before, beside the closed forms.

Usage: lattice_passes.py DIR, with a run of `cases/benchmark/lattice.toml` in DIR
"""

import argparse
import math
from pathlib import Path

import numpy as np

import results

# Radius over distance of the discs; distance in m over tension in N/m.
RADIUS = 0.3
LENGTH_OVER_TENSION = 1e-3 / 0.03


def closed_form(deg: float) -> tuple[str, float]:
    """What passes a flat front, and its curvature times the distance (Cieplak and Robbins 1990)."""
    sin, cos = math.sin(math.radians(deg)), math.cos(math.radians(deg))
    if sin / cos < 0.5 / RADIUS and deg < 90.0:
        return "overlap", 2.0 * sin
    return "burst", 1.0 / (RADIUS * cos + math.sqrt(0.25 - (RADIUS * sin) ** 2))


def row_passed(_: Path, row: dict[str, str]) -> dict[str, float | str]:
    """What passes a flat front by the closed form, its curvature times the distance, and the measured one, for the layout of `gallery.py`."""
    event, exact = closed_form(float(row["angle"]))
    found, half = (float(row[name] or "nan") * LENGTH_OVER_TENSION for name in ("burst-pressure-Pa", "burst-pressure-Pa-uncertainty"))
    return {"event": event, "exact": exact, "curvature": found, "curvature-uncertainty": half}


def azimuth(deg: float, curvature: float) -> float:
    """Degrees above the row at which a meniscus of this curvature times distance meets the discs; NaN where none does below 90."""
    over = np.radians(np.linspace(1.0, 90.0, 8901))
    curvatures = -np.cos(over + np.radians(deg)) / (0.5 - RADIUS * np.cos(over))
    reached = np.flatnonzero(curvatures >= curvature)
    return float(np.degrees(over[reached[0]])) if len(reached) else math.nan


def azimuths(directory: Path) -> list[str]:
    """A line for each pressure, of the last record at it: the mean azimuth of both contact points, beside that at rest."""
    deg = math.degrees(results.report(directory)["case"]["model"]["sph"]["wetting_model"]["young"]["contact_angle"])
    series = results.series(directory / "series.csv")
    last = {}
    for frame in results.frames(directory / "interface.pvd")[1:]:
        row = int(np.argmin(np.abs(series["time_s"] - frame.time)))
        points = np.asarray(results.read(frame.file).points)
        if series["contact_lines"][row] != 2 or len(points) == 0:
            continue
        # Periodic along x, with the disc in the middle of the first period; contact points are nearest to its center.
        x, y = 1e3 * points[:, 0] % 1.0 - 0.5, 1e3 * points[:, 1] - 0.6
        ends = [np.flatnonzero(x < 0.0), np.flatnonzero(x >= 0.0)]
        found = [np.degrees(np.arctan2(y[i], abs(x[i]))) for side in ends if len(side) for i in [side[np.argmin(np.hypot(x, y)[side])]]]
        last[series["pressure_difference_Pa"][row]] = float(np.mean(found))
    lines = ["| curvature times distance | azimuth | at rest |", "|---" * 3 + "|"]
    for pressure, mean in last.items():
        curvature = pressure * LENGTH_OVER_TENSION
        rest = azimuth(deg, curvature)
        lines.append(f"| {curvature:.3f} | {mean:.1f} | {'none' if math.isnan(rest) else f'{rest:.1f}'} |")
    return lines


def main() -> None:
    """Prints the table of a run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dir", type=Path)
    print("\n".join(azimuths(parser.parse_args().dir)))


if __name__ == "__main__":
    main()
