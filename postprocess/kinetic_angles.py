"""Dynamic contact angles by molecular kinetic theory: the split of a flow at a crevice, and angles in curved channels.

Two tables for `gallery.py`: the share of the flow that enters the crevice, by balance of both menisci, for 24 conditions, and 31 angles in four channels by
one law, fitted on the straight one. Both experiments: Zhang and others (2024). cos(theta) = cos(theta_0) - 2 k T/(sigma lambda^2) asinh(u/(2 kappa lambda))
(Blake and Haynes 1969).
"""

import math
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

from gallery_results import rows_of

SPLITS = Path(__file__).parent / "crevice-split.csv"
ANGLES = Path(__file__).parent / "curved-channels.csv"
BOLTZMANN = 1.380649e-23  # J/K
TEMPERATURE = 295.15  # K
TENSION = {"water": 0.07274, "glycerin-water 50 wt%": 0.06812}  # N/m
# The main channel is 1 mm wide and everything 0.4 mm deep.
WIDTH, DEPTH = 1.0e-3, 0.4e-3  # m
AT_REST = 93.0  # degrees, the measured static angle of the crevice experiment
# Both readings of a split differ by up to 0.06; a model is asked for both within this.
BAR = 0.03


class Law(NamedTuple):
    """Molecular kinetic theory: static angle in degrees, jump length in m, jump frequency in 1/s."""

    static: float
    jump: float
    frequency: float

    def cosine(self, speed: float, tension: float) -> float:
        """The cosine of the advancing angle at a speed in m/s."""
        work = 2.0 * BOLTZMANN * TEMPERATURE / (tension * self.jump**2)
        return math.cos(math.radians(self.static)) - work * math.asinh(speed / (2.0 * self.frequency * self.jump))

    def angle(self, speed: float, tension: float) -> float:
        """The advancing angle in degrees."""
        return math.degrees(math.acos(max(-1.0, self.cosine(speed, tension))))


# Jumps of water as the authors fitted them to curved channels 1 and 3, with the static angle of this chip: nothing is fitted to the splits.
CHANNELS = {"channel 1": Law(AT_REST, 0.81e-9, 756560.0), "channel 3": Law(AT_REST, 1.07e-9, 284860.0)}


def share(law: Law, upstream: float, width: float) -> float:
    """The share of the flow into a crevice of a width (m) at which both menisci have one capillary pressure, at an upstream speed in m/s."""

    def excess(part: float) -> float:
        main = law.cosine((1.0 - part) * upstream, TENSION["water"]) * (1.0 / WIDTH + 1.0 / DEPTH)
        return main - law.cosine(part * upstream * WIDTH / width, TENSION["water"]) * (1.0 / width + 1.0 / DEPTH)

    low, high = 0.0, 1.0
    if excess(low) > 0.0:
        return 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0.0 else (low, middle)
    return low


def split(_: dict) -> list[str]:
    """The table of all splits, and how many lie within both readings and the bar."""
    lines = ["| crevice, edge in mm | upstream in mm/s | measured | " + " | ".join(f"jumps of {name}" for name in CHANNELS) + " |"]
    lines.append("|---" * (3 + len(CHANNELS)) + "|")
    met = dict.fromkeys(CHANNELS, 0)
    for row in rows_of(SPLITS):
        width, speed = float(row["crevice_width_mm"]) * 1e-3, float(row["u_upstream_mm_s"]) * 1e-3
        low, high = sorted((float(row["share_by_crevice_velocity"]), float(row["share_by_balance"])))
        found = {name: share(law, speed, width) for name, law in CHANNELS.items()}
        is_met = {name: low - BAR <= value <= high + BAR for name, value in found.items()}
        for name in CHANNELS:
            met[name] += is_met[name]
        cells = [f"{value:.3f}" + ("" if is_met[name] else " (off)") for name, value in found.items()]
        place = f"{row['crevice_width_mm']}, {row['edge_radius_mm']}"
        lines.append(f"| {place} | {1e3 * speed:.3g} | {low:.3f} to {high:.3f} | " + " | ".join(cells) + " |")
    lines.append("| within | | | " + " | ".join(f"{count} of {len(rows_of(SPLITS))}" for count in met.values()) + " |")
    return lines


def spread(law: Law, of: list[dict[str, str]]) -> float:
    """Root mean square difference in degrees to measured angles."""
    errors = [law.angle(1e-3 * float(row["speed_measured_mm_s"]), TENSION[row["fluid"]]) - float(row["angle_image_deg"]) for row in of]
    return math.sqrt(sum(error * error for error in errors) / len(errors))


def fitted(of: list[dict[str, str]]) -> Law:
    """The law nearest to measured angles, by a search that halves its steps in the static angle and the logarithms of both jump parameters."""
    at, steps = [85.0, math.log(1.0e-9), math.log(1.0e6)], [4.0, 0.3, 2.0]

    def error(point: list[float]) -> float:
        return spread(Law(point[0], math.exp(point[1]), math.exp(point[2])), of)

    while max(steps) > 1e-6:
        moves = [[x + sign * step * (k == j) for k, (x, step) in enumerate(zip(at, steps, strict=True))] for j in range(3) for sign in (-1, 1)]
        best = min(moves, key=error)
        if error(best) < error(at) - 1e-12:
            at = best
        else:
            steps = [0.5 * step for step in steps]
    return Law(at[0], math.exp(at[1]), math.exp(at[2]))


def angles(_: dict) -> list[str]:
    """The law of the straight channel in all four."""
    channels = defaultdict(list)
    for row in rows_of(ANGLES):
        channels[row["channel"]].append(row)
    law = fitted(channels["straight"])
    lines = [f"static angle {law.static:.1f} degrees, jumps of {1e9 * law.jump:.2f} nm at {law.frequency:.3g}/s", ""]
    lines += ["| channel | liquid | rows | law of the straight channel: rms, largest difference in degrees | its own law: rms |", "|---|---|---|---|---|"]
    for name, of in channels.items():
        liquid = of[0]["fluid"]
        errors = [law.angle(1e-3 * float(row["speed_measured_mm_s"]), TENSION[liquid]) - float(row["angle_image_deg"]) for row in of]
        largest = max(errors, key=abs)
        lines.append(f"| {name} | {liquid} | {len(of)} | {spread(law, of):.1f}, {largest:+.1f} | {spread(fitted(of), of):.1f} |")
    return lines
