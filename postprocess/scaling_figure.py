"""Draws what `cargo bench --bench scaling` measured: time per particle and step by part, over the number of particles.

Usage: scaling_figure.py [target/scaling.csv] [--picture scaling.svg]
"""

import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# The time of a whole step, and how the columns of times end.
STEP, UNIT = "step_us", "_us"


def measure(path: str | Path) -> dict[int, list[dict[str, float]]]:
    """The rows of the table by number of threads, each with its columns as numbers, in the order of the particles."""
    with Path(path).open(newline="", encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    threads = sorted({int(row["threads"]) for row in rows})
    order = sorted(rows, key=lambda row: row["particles"])
    return {count: [row for row in order if row["threads"] == count] for count in threads}


def draw(found: dict[int, list[dict[str, float]]], picture: Path) -> None:
    """Writes the figure: one panel for each number of threads, parts as areas, the whole step as a line."""
    figure, axes = plt.subplots(1, len(found), figsize=(4.6 * len(found), 3.6), sharey=True, squeeze=False)
    for axis, (threads, rows) in zip(axes.flat, found.items(), strict=True):
        particles = [row["particles"] for row in rows]
        parts = [name for name in rows[0] if name.endswith(UNIT) and name != STEP]
        areas = [[row[name] for row in rows] for name in parts]
        axis.stackplot(particles, areas, labels=[name.removesuffix(UNIT) for name in parts], alpha=0.7)
        axis.plot(particles, [row[STEP] for row in rows], "ko-", label="step")
        axis.set_xscale("log")
        axis.set_ylim(bottom=0.0)
        axis.set_xlabel("particles")
        axis.set_title(f"{threads} thread" + ("s" if threads > 1 else ""))
    axes.flat[0].set_ylabel("µs per particle and step")
    axes.flat[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture)
    plt.close(figure)


def main() -> None:
    """Writes the figure and prints its name."""
    parser = argparse.ArgumentParser(description="time per particle and step over the number of particles")
    parser.add_argument("table", type=Path, nargs="?", default=Path("target/scaling.csv"))
    parser.add_argument("--picture", type=Path, default=Path("scaling.svg"))
    asked = parser.parse_args()
    if not asked.table.is_file():
        raise SystemExit(f"there is no {asked.table}: `cargo bench --bench scaling` writes it")
    draw(measure(asked.table), asked.picture)
    print(asked.picture)


if __name__ == "__main__":
    main()
