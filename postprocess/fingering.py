"""Saturation at breakthrough and width of fingers of a study over viscosities, rates and seeds: means over the seeds, and some pictures.

Usage: fingering.py DIR [--picture fingering.png] [--seed 1]
"""

import argparse
import csv
import math
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# What is above and beside the square map, over height and width of a picture.
TOP, BESIDE = 0.073, 0.0558
MEASURES = ("capillary-number", "saturation-at-breakthrough", "finger-width-m", "fingers-per-line", "solves-per-event")


def measure(path: str | Path) -> list[dict]:
    """A row for each viscosity and rate, in the order of the table: means over the seeds, and the scatter of the saturation."""
    groups = defaultdict(list)
    with (Path(path) / "table.csv").open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["status"] == "done":
                groups[float(row["viscosity"]), float(row["rate"])].append(row)
    found = []
    for (viscosity, rate), rows in groups.items():
        means = {name: sum(float(row[name]) for row in rows) / len(rows) for name in MEASURES}
        saturations = [float(row["saturation-at-breakthrough"]) for row in rows]
        mean = means["saturation-at-breakthrough"]
        scatter = math.sqrt(sum((s - mean) ** 2 for s in saturations) / max(len(rows) - 1, 1))
        found.append({"viscosity": viscosity, "rate": rate, "runs": len(rows), "scatter": scatter, "rows": rows, **means})
    return found


def draw(found: list[dict], directory: Path, picture: Path, seed: str) -> None:
    """A picture for each viscosity and every second rate."""
    viscosities = sorted({row["viscosity"] for row in found})
    rates = sorted({row["rate"] for row in found})[1::2]
    figure, axes = plt.subplots(len(viscosities), len(rates), figsize=(3.2 * len(rates), 3.7 * len(viscosities)), squeeze=False)
    for row in found:
        if row["rate"] not in rates:
            continue
        axis = axes[viscosities.index(row["viscosity"])][rates.index(row["rate"])]
        for run in row["rows"]:
            if run["seed"] == seed:
                image = plt.imread(directory / "runs" / run["run"] / "picture.png")
                # The map without title, arrows and legend.
                height, width = image.shape[:2]
                top, left, side = int(TOP * height), int(BESIDE * width), int((1 - 2 * BESIDE) * width)
                axis.imshow(image[top : top + side + 2, left : left + side])
        ratio = float(row["rows"][0]["viscosity-ratio"])
        axis.set_title(f"viscosity ratio {ratio:g}, Ca {row['capillary-number']:.0e}", fontsize=9)
    for axis in axes.flat:
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(picture, dpi=70)


def main() -> None:
    """Prints the table and draws the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dir", type=Path)
    parser.add_argument("--picture", type=Path, default=Path("fingering.png"))
    parser.add_argument("--seed", default="1")
    arguments = parser.parse_args()
    found = measure(arguments.dir)
    print("| viscosity ratio | Ca | saturation | finger width in µm | fingers per line | solves per event |")
    print("|---|---|---|---|---|---|")
    for row in found:
        ratio = float(row["rows"][0]["viscosity-ratio"])
        print(
            f"| {ratio:g} | {row['capillary-number']:.1e} | {row['saturation-at-breakthrough']:.3f} ± {row['scatter']:.3f} "
            f"| {1e6 * row['finger-width-m']:.0f} | {row['fingers-per-line']:.2f} | {row['solves-per-event']:.1f} |"
        )
    draw(found, arguments.dir, arguments.picture, arguments.seed)


if __name__ == "__main__":
    main()
