"""Injected volume of a spontaneous imbibition over time: its exponent, and the capillary pressure that drives it by the law of Washburn.

Usage: washburn.py RUN [--picture imbibition.svg] [--from 0.1]

With the displaced share S, the length L, porosity, permeability K and viscosity of the entering phase, a front that a capillary pressure p drives against a
thin phase has (S L)² = 2 K p t/(porosity × viscosity).
"""

import argparse
import csv
import json
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def measure(run: str | Path, first: float = 0.1) -> dict:
    """Times and injected volumes, the exponent of the volume over time from `first` pore volumes on, and the driving pressure in Pa there."""
    run = Path(run)
    with (run / "series.csv").open(newline="", encoding="utf-8") as file:
        rows = [(float(row["time_s"]), float(row["injected_pore_volumes"])) for row in csv.DictReader(file)]
    report = json.loads((run / "report.json").read_text(encoding="utf-8"))
    used = [row for row in rows if row[1] >= first]
    x, y = [math.log(time) for time, _ in used], [math.log(volume) for _, volume in used]
    mean = sum(x) / len(x), sum(y) / len(y)
    exponent = sum((a - mean[0]) * (b - mean[1]) for a, b in zip(x, y, strict=True)) / sum((a - mean[0]) ** 2 for a in x)
    case = report["case"]
    measures = report["measures"]
    length = case["geometry"]["max"][0] - case["geometry"]["min"][0]
    viscosity = case["model"]["network"]["wetting"]["viscosity"]
    # Slope of the squared volume over time.
    squared = [volume**2 for _, volume in used]
    times = [time for time, _ in used]
    middle = sum(times) / len(times), sum(squared) / len(squared)
    slope = sum((t - middle[0]) * (s - middle[1]) for t, s in zip(times, squared, strict=True)) / sum((t - middle[0]) ** 2 for t in times)
    pressure = slope * length**2 * measures["porosity"]["value"] * viscosity / (2 * measures["permeability-x-m2"]["value"])
    return {"rows": rows, "exponent": exponent, "pressure": pressure, "slope": slope}


def draw(found: dict, picture: Path) -> None:
    """Injected volume over the root of time."""
    figure, axis = plt.subplots(figsize=(5.0, 3.4))
    axis.plot([math.sqrt(time) for time, _ in found["rows"]], [volume for _, volume in found["rows"]])
    axis.set_xlabel("square root of the time in s")
    axis.set_ylabel("injected pore volumes")
    axis.set_xlim(left=0)
    axis.set_ylim(bottom=0)
    figure.tight_layout()
    figure.savefig(picture)


def main() -> None:
    """Prints the exponent and the pressure and writes the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=Path)
    parser.add_argument("--picture", type=Path, default=Path("imbibition.svg"))
    parser.add_argument("--from", dest="first", type=float, default=0.1)
    arguments = parser.parse_args()
    found = measure(arguments.run, arguments.first)
    print(f"exponent {found['exponent']:.3f}, driving pressure {found['pressure']:.0f} Pa")
    draw(found, arguments.picture)


if __name__ == "__main__":
    main()
