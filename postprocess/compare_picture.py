"""Takes one picture out of the page of `meniscus compare`: network and direct simulation at equal saturation, with titles, scale and legend.

Usage: compare_picture.py DIR [--number 4] [--picture picture.svg].
"""

import argparse
import re
from pathlib import Path


def measure(path: str | Path) -> dict:
    """The pictures at equal saturations as texts of SVG, in the order of the page."""
    page = (Path(path) / "compare.html").read_text(encoding="utf-8")
    figures = re.findall(r"<figure>(<svg.*?</svg>)", page, re.DOTALL)
    if not figures:
        raise ValueError(f"{path}/compare.html has no picture at equal saturation")
    return {"pictures": figures}


def main() -> None:
    """Writes the picture and prints its name."""
    parser = argparse.ArgumentParser(description="take one picture out of the page of a comparison")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus compare`")
    parser.add_argument("--number", type=int, default=4, help="which picture of the page, from 1")
    parser.add_argument("--picture", type=Path, default=Path("picture.svg"))
    asked = parser.parse_args()
    pictures = measure(asked.directory)["pictures"]
    if not 1 <= asked.number <= len(pictures):
        parser.error(f"the page has pictures 1 to {len(pictures)}")
    asked.picture.write_text(pictures[asked.number - 1] + "\n", encoding="utf-8")
    print(asked.picture)


if __name__ == "__main__":
    main()
