"""Puts the pictures of all complete runs of a study into one figure, each with its parameters.

Usage: study_panel.py DIR [--picture study_panel.png] [--columns 4]
"""

import argparse
import csv
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Columns of `table.csv` before and after the parameters.
FIRST, LAST = "run", "status"

# Width of a picture and height of its title in inches.
WIDTH, TITLE = 4.0, 0.4


def measure(path: str | Path) -> dict:
    """The complete runs of a study folder in their order: name, row of the table, parameters as text, picture."""
    directory = Path(path)
    with (directory / "table.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    runs = []
    for row in rows:
        names = list(row)
        parameters = {name: row[name] for name in names[names.index(FIRST) + 1 : names.index(LAST)]}
        picture = directory / "runs" / row[FIRST] / "picture.png"
        if row[LAST] == "done" and picture.is_file():
            runs.append({"name": row[FIRST], "row": row, "parameters": parameters, "picture": picture})
    return {"runs": runs, "all": len(rows)}


def draw(found: dict, picture: Path, columns: int) -> None:
    """Writes the figure."""
    runs = found["runs"]
    columns = min(columns, len(runs))
    rows = math.ceil(len(runs) / columns)
    pictures = [plt.imread(run["picture"]) for run in runs]
    tallest = max(pixels.shape[0] / pixels.shape[1] for pixels in pictures)
    size = (WIDTH * columns, (WIDTH * tallest + TITLE) * rows)
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False, layout="constrained")
    for axis in axes.flat:
        axis.axis("off")
    for axis, run, pixels in zip(axes.flat, runs, pictures, strict=False):
        axis.imshow(pixels)
        axis.set_title(", ".join(f"{name} = {value}" for name, value in run["parameters"].items()), fontsize=9)
    figure.savefig(picture, dpi=150)
    plt.close(figure)


def main() -> None:
    """Writes the figure and prints its name."""
    parser = argparse.ArgumentParser(description="the pictures of all runs of a study in one figure")
    parser.add_argument("directory", type=Path, help="folder of `meniscus study run`")
    parser.add_argument("--picture", type=Path, default=Path("study_panel.png"))
    parser.add_argument("--columns", type=int, default=4)
    asked = parser.parse_args()
    found = measure(asked.directory)
    if not found["runs"]:
        raise SystemExit(f"no run of {asked.directory} is complete yet")
    draw(found, asked.picture, max(1, asked.columns))
    print(asked.picture)


if __name__ == "__main__":
    main()
