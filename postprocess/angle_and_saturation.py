"""Draws contact angle and saturation against time, the requested angle as a line.

Usage: angle_and_saturation.py DIR [--picture angle_and_saturation.png]
"""

import argparse
from pathlib import Path

import matplotlib
import numpy as np

import results

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def measure(path: str | Path) -> dict:
    """Times (s), angles (deg, NaN without contact line), saturations, and the requested and the last measured angle."""
    directory = Path(path)
    columns = results.series(directory / "series.csv")
    angles = columns["contact_angle_deg"]
    known = angles[np.isfinite(angles)]
    return {
        "time": columns["time_s"],
        "angle": angles,
        "saturation": columns["saturation"],
        "requested-angle": results.requested_angle(results.report(directory).get("case", {})),
        "last-angle": float(known[-1]) if len(known) else None,
    }


def draw(found: dict, picture: Path) -> None:
    """Writes the figure."""
    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 5.6), constrained_layout=True)
    upper.plot(found["time"], found["angle"], marker=".", label="measured")
    if found["requested-angle"] is not None:
        upper.axhline(found["requested-angle"], color="black", linestyle="--", label="requested")
    upper.set_ylabel("contact angle (deg)")
    upper.legend()
    lower.plot(found["time"], found["saturation"], marker=".")
    lower.set_ylabel("saturation of the wetting phase (-)")
    lower.set_xlabel("time (s)")
    figure.savefig(picture, dpi=150)
    plt.close(figure)


def main() -> None:
    """Writes the figure and prints its name."""
    parser = argparse.ArgumentParser(description="contact angle and saturation against time")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus run`")
    parser.add_argument("--picture", type=Path, default=Path("angle_and_saturation.png"))
    asked = parser.parse_args()
    draw(measure(asked.directory), asked.picture)
    print(asked.picture)


if __name__ == "__main__":
    main()
