"""Draws advancing and receding angles over the surface tension, measured and simulated, with straight lines through both.

Usage: hysteresis.py STUDY [--picture hysteresis.png]. STUDY is the folder of `meniscus study run studies/hysteresis.toml`.
"""

import argparse
import csv
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Whose angles, columns of the advancing and the receding one, color.
ANGLES = [
    ("experiment", ("advancing", "receding"), "tab:blue"),
    ("simulation", ("advancing-angle-deg", "receding-angle-deg"), "tab:red"),
]
# Name, marker and line of the advancing and the receding angle.
ENDS = [("advancing", "x", "-"), ("receding", "o", "--")]


def measure(path: str | Path) -> dict:
    """Surface tensions in N/m and angles in degrees of the complete runs, and the slopes in degrees per N/m."""
    with (Path(path) / "table.csv").open(newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "done"]
    found = {"tension": np.array([float(row["tension"]) for row in rows]), "slopes": {}}
    for _, columns, _ in ANGLES:
        for column in columns:
            found[column] = np.array([float(row[column]) for row in rows])
            if len(rows) > 1:
                found["slopes"][column] = float(np.polyfit(found["tension"], found[column], 1)[0])
    return found


def draw(found: dict, picture: Path) -> None:
    """Writes the figure."""
    figure, axis = plt.subplots(figsize=(7.0, 4.6), layout="constrained")
    tension = found["tension"]
    ends = np.array([tension.min(), tension.max()])
    for whose, columns, color in ANGLES:
        for column, (name, marker, line) in zip(columns, ENDS, strict=True):
            face = {"facecolors": "none"} if marker == "o" else {}
            # Scatter takes a color of the edge for hollow markers and of the whole for crosses.
            paint = {"edgecolors": color} if marker == "o" else {"color": color}
            axis.scatter(1e3 * tension, found[column], marker=marker, s=45, label=f"{whose}, {name}", **face, **paint)
            if len(tension) > 1:
                axis.plot(1e3 * ends, np.polyval(np.polyfit(tension, found[column], 1), ends), line, color=color, lw=1)
    axis.set(xlabel="surface tension (mN/m)", ylabel="contact angle (degrees)")
    axis.legend(fontsize=9)
    figure.savefig(picture, dpi=110)
    plt.close(figure)


def main() -> None:
    """Writes the figure and prints its name."""
    parser = argparse.ArgumentParser(description="advancing and receding angles over the surface tension")
    parser.add_argument("directory", type=Path, help="folder of `meniscus study run`")
    parser.add_argument("--picture", type=Path, default=Path("hysteresis.png"))
    asked = parser.parse_args()
    found = measure(asked.directory)
    if not len(found["tension"]):
        raise SystemExit(f"no run of {asked.directory} is complete yet")
    draw(found, asked.picture)
    print(asked.picture)


if __name__ == "__main__":
    main()
