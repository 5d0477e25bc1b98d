"""The curvature at which a front passes a row of a square lattice, beside the closed form: a table.

Usage: lattice_passes.py DIR, with the study of `studies/benchmark/lattice.toml` in DIR
"""

import argparse
import csv
import json
import math
from pathlib import Path

# Radius over distance of the discs; distance in m over tension in N/m.
RADIUS = 0.3
LENGTH_OVER_TENSION = 1e-3 / 0.03


def closed_form(deg: float) -> tuple[str, float]:
    """What passes a flat front, and its curvature times the distance (Cieplak and Robbins 1990)."""
    sin, cos = math.sin(math.radians(deg)), math.cos(math.radians(deg))
    if sin / cos < 0.5 / RADIUS and deg < 90.0:
        return "overlap", 2.0 * sin
    return "burst", 1.0 / (RADIUS * cos + math.sqrt(0.25 - (RADIUS * sin) ** 2))


def measured(directory: Path) -> tuple[float, float, float]:
    """Curvature times distance, half of its interval, and processor time in s."""
    report = json.loads((directory / "report.json").read_text(encoding="utf-8"))
    found = report["measures"]["burst-pressure-Pa"]
    value, half = (math.nan if found[name] is None else found[name] * LENGTH_OVER_TENSION for name in ("value", "uncertainty"))
    return value, half, report["cpu-s"]


def table(directory: Path) -> list[str]:
    """A line for each finished run."""
    lines = ["| angle | event | closed form | spacing over distance | measured | error | processor time in s |", "|---" * 7 + "|"]
    with (directory / "table.csv").open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["status"] != "done":
                continue
            event, exact = closed_form(float(row["angle"]))
            value, half, seconds = measured(directory / "runs" / row["run"])
            ratio = 1e-3 / float(row["spacing"])
            lines.append(f"| {row['angle']} | {event} | {exact:.3f} | 1/{ratio:.0f} | {value:.3f} ± {half:.3f} | {100 * (value / exact - 1):+.1f} % | {seconds:.0f} |")
    return lines


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dir", type=Path)
    print("\n".join(table(parser.parse_args().dir)))


if __name__ == "__main__":
    main()
