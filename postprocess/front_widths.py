"""Width of fronts under gravity over the Bond number, of a study over tilts and packs: means over the packs, and the law of gradient percolation.

Usage: front_widths.py DIR [--picture gravity-fronts.png]
"""

import argparse
import csv
import math
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# ν/(1 + ν) with the exponent ν = 4/3 of the correlation length of percolation in the plane.
EXPONENT = 4.0 / 7.0


def measure(path: str | Path) -> list[dict[str, float]]:
    """A row for each tilt: means over the packs, and their standard deviations."""
    groups = defaultdict(list)
    with (Path(path) / "table.csv").open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["status"] == "done":
                groups[float(row["tilt"])].append(row)
    return [mean_of(tilt, rows) for tilt, rows in sorted(groups.items())]


def mean_of(tilt: float, rows: list[dict[str, str]]) -> dict[str, float]:
    """Means and standard deviations over the packs of one tilt."""
    found = {"tilt": tilt, "packs": len(rows)}
    scaled = [float(row["front-width-m"]) * float(row["bond-number"]) ** EXPONENT for row in rows]
    columns = {name: [float(row[name]) for row in rows] for name in ("bond-number", "front-width-m", "saturation-at-breakthrough", "trapped-saturation")}
    for name, values in {**columns, "scaled": scaled}.items():
        mean = sum(values) / len(values)
        found[name] = mean
        found[name + "-scatter"] = math.sqrt(sum((x - mean) ** 2 for x in values) / max(len(values) - 1, 1))
    return found


def slope(found: list[dict[str, float]]) -> tuple[float, float]:
    """Exponent of the width over the Bond number by least squares in logarithms, and its standard error from the scatter of the packs."""
    x = [math.log(row["bond-number"]) for row in found]
    y = [math.log(row["front-width-m"]) for row in found]
    error = [row["front-width-m-scatter"] / row["front-width-m"] / math.sqrt(row["packs"]) for row in found]
    middle = sum(x) / len(x)
    spread = sum((a - middle) ** 2 for a in x)
    value = sum((a - middle) * b for a, b in zip(x, y, strict=True)) / spread
    return value, math.sqrt(sum(((a - middle) * e) ** 2 for a, e in zip(x, error, strict=True))) / spread


def draw(found: list[dict[str, float]], picture: Path) -> None:
    """Widths with the scatter of the packs, and the law through their middle."""
    figure, axis = plt.subplots(figsize=(5.0, 3.8))
    bonds = [row["bond-number"] for row in found]
    axis.errorbar(
        bonds,
        [1e3 * row["front-width-m"] for row in found],
        yerr=[1e3 * row["front-width-m-scatter"] for row in found],
        fmt="o",
        capsize=3,
        label="ten packs, mean and standard deviation",
    )
    level = math.exp(sum(math.log(row["front-width-m"] * row["bond-number"] ** EXPONENT) for row in found) / len(found))
    ends = [min(bonds) / 1.2, max(bonds) * 1.2]
    axis.plot(ends, [1e3 * level * bond**-EXPONENT for bond in ends], "k--", label="Bo$^{-4/7}$")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks(bonds, [f"{bond:.2g}" for bond in bonds])
    widths = [5, 10, 20, 40]
    axis.set_yticks(widths, [str(width) for width in widths])
    axis.minorticks_off()
    axis.set_xlabel("Bond number")
    axis.set_ylabel("width of the front in mm")
    axis.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def main() -> None:
    """Prints the table and writes the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dir", type=Path)
    parser.add_argument("--picture", type=Path, default=Path("gravity-fronts.png"))
    arguments = parser.parse_args()
    found = measure(arguments.dir)
    print("| tilt in degrees | Bo | width in mm | width × Bo^(4/7) in mm | saturation at breakthrough | trapped |")
    print("|---|---|---|---|---|---|")
    for row in found:
        cells = [f"{1e3 * row[name]:.2f} ± {1e3 * row[name + '-scatter']:.2f}" for name in ("front-width-m", "scaled")]
        shares = [f"{row[name]:.3f} ± {row[name + '-scatter']:.3f}" for name in ("saturation-at-breakthrough", "trapped-saturation")]
        print(f"| {row['tilt']:g} | {row['bond-number']:.4f} | " + " | ".join([*cells, *shares]) + " |")
    stable = [row for row in found if row["tilt"] > 0.0]
    exponent, error = slope(stable)
    print(f"\nexponent {exponent:.2f} ± {error:.2f}, by percolation {-EXPONENT:.2f}")
    draw(stable, arguments.picture)


if __name__ == "__main__":
    main()
