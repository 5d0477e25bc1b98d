"""What the cases of `studies/benchmark` have that their reports have not, and their pictures: for the layouts of `gallery.py`.

Drops on a tilted wall, a small bubble at rest, and a plate drawn out of a bath, the last beside the fold of all steady menisci by lubrication theory: Navier
slip, a fluid above without viscosity, the wedge of Huh and Scriven (1971) with a free side, as in Chan, Snoeijer and Eggers (2012).
"""

import functools
import itertools
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import colors
import results
from gallery_results import rows_of

# Degrees found, by degrees asked.
BASILISK = {15: 46.7, 30: 39.1, 45: 43.2, 60: 58.9, 75: 72.8, 90: 86.6, 105: 98.0, 120: 116.3, 135: 133.8, 150: 141.1, 165: 130.9}
PECLET = {30: 30.69, 60: 59.98, 90: 88.84, 120: 116.86, 150: 146.23}
# The largest speed in m/s that a user of a volume-of-fluid code reports.
REPORTED = 2.3


def runs(directory: Path) -> list[dict[str, str]]:
    """The finished runs of a study."""
    return [row for row in rows_of(directory / "table.csv") if row["status"] == "done"]


def series(directory: Path, run: str, columns: list[str]) -> np.ndarray:
    """Columns of the series of a run; empty fields are NaN."""
    rows = rows_of(directory / "runs" / run / "series.csv")
    return np.array([[float(row[name] or "nan") for name in columns] for row in rows]).T


def interface(directory: Path, run: str, time: float | None = None) -> list[np.ndarray]:
    """The pieces of the interface at a time (the end) as rows of x, y in m, in two columns each."""
    frame = results.frame_at(directory / "runs" / run / "interface.pvd", time)
    lines = results.read(frame.file)
    points = np.asarray(lines.points)[:, :2]
    return [points[cell.point_ids] for cell in lines.cell]


def angle_of(radius: float, area: float) -> float:
    """The angle in degrees of a circular drop of a radius of curvature and an area on a flat wall."""
    low, high = 0.0, math.pi
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        if radius**2 * (middle - math.sin(middle) * math.cos(middle)) < area:
            low = middle
        else:
            high = middle
    return math.degrees(low)


def radius_of(points: np.ndarray) -> float:
    """The radius of the circle of least squares through points."""
    center = points.mean(axis=0)
    x, y = (points - center).T
    a, b, c = np.linalg.lstsq(np.column_stack([2 * x, 2 * y, np.ones(len(x))]), x**2 + y**2, rcond=None)[0]
    return math.sqrt(c + a**2 + b**2)


def tilted(directory: Path, row: dict[str, str]) -> dict[str, float | str]:
    """The angle in degrees by the area of a drop and the radius of the circle of least squares through its interface, and those of other codes."""
    asked = round(float(row["angle"]))
    area = series(directory, row["run"], ["wetting_area_m2"])[0, -1]
    radius = radius_of(np.concatenate(interface(directory, row["run"])))
    return {"angle-by-radius": angle_of(radius, area), "basilisk": BASILISK[asked], "peclet": PECLET.get(asked, "–")}


def exact_arc(angle: float, area: float) -> np.ndarray:
    """The arc of a drop of an area on the wall y = 0 that it meets at an angle, in two rows."""
    radius = math.sqrt(area / (angle - math.sin(angle) * math.cos(angle)))
    turn = np.linspace(-angle, angle, 200)
    return radius * np.array([np.sin(turn), np.cos(turn) - math.cos(angle)])


def draw_tilted(directory: Path, picture: Path) -> None:
    """The interfaces at the end beside the exact arcs, all turned into the frame of the wall."""
    figure, axes = plt.subplots(figsize=(8, 3.4), layout="constrained")
    for row in runs(directory):
        angle = float(row["angle"])
        arc = 1e3 * exact_arc(math.radians(angle), 0.5 * math.pi * 2.5e-4**2)
        axes.plot(*arc, color="0.75", lw=4, zorder=1)
        for piece in interface(directory, row["run"]):
            along, above = (piece[:, 0] - piece[:, 1]) / math.sqrt(2), (piece[:, 0] + piece[:, 1]) / math.sqrt(2)
            axes.plot(1e3 * along, 1e3 * above, color=colors.MENISCUS, lw=1, zorder=2)
    axes.axhline(0.0, color=colors.WALL, lw=2)
    axes.set(xlabel="along the wall (mm)", ylabel="above the wall (mm)", aspect="equal", ylim=(-0.03, 0.55))
    figure.savefig(picture, dpi=110)
    plt.close(figure)


def bubble(directory: Path, row: dict[str, str]) -> dict[str, float]:
    """How far the center of the bubble is from the middle of the box, over the radius."""
    return {"drift": float(np.linalg.norm(np.concatenate(interface(directory, row["run"])).mean(axis=0)) / 3e-5)}


def draw_bubble(directory: Path, picture: Path) -> None:
    """The largest speed over time at each spacing, and the reported one."""
    figure, axes = plt.subplots(figsize=(6, 3.6), layout="constrained")
    for row, color in zip(runs(directory), (colors.WETTING, colors.NON_WETTING, colors.MARK), strict=True):
        time, speed = series(directory, row["run"], ["time_s", "max_relative_speed_m_per_s"])
        axes.semilogy(1e3 * time[1:], speed[1:], color=color, label=f"{3e-5 / float(row['spacing']):.0f} spacings in the radius")
    axes.axhline(REPORTED, color="0.4", ls="--", label="reported for a volume-of-fluid code")
    axes.set(xlabel="time (ms)", ylabel="largest speed (m/s)")
    axes.legend(fontsize=8)
    figure.savefig(picture, dpi=110)
    plt.close(figure)


def wall_angle(capillary_number: float, start: float, slip: float, far: float = 6.0) -> tuple[float, float]:
    """Angle at the plate and height of the line, lengths in capillary lengths, of the steady meniscus that is `start` above the bath at the distance `far`.

    With arc length, distance h from the plate and slope θ to it: h' = sin θ, θ' = κ, κ' = 3 Ca F/(h (h + 3 slip)) - cos θ. NaN: it ends in a film.
    """

    def drag(h: float, theta: float) -> float:
        wedge = 2.0 * math.sin(theta) ** 3 / (3.0 * (theta - math.sin(theta) * math.cos(theta))) if theta > 1e-2 else 1.0
        return 3.0 * capillary_number * wedge / (h * (h + 3.0 * slip))

    pull = drag(far, 0.5 * math.pi)
    h, theta, curvature, height = far, 0.5 * math.pi - pull - start, start + 2.0 * pull / far, start + pull * far
    while h > 1e-4 * slip:
        step = -min(0.03, 0.1 * h / max(math.sin(theta), 0.1), 0.1 / (abs(curvature) + 1e-9))
        middle = h + 0.5 * step * math.sin(theta), theta + 0.5 * step * curvature, curvature + 0.5 * step * (drag(h, theta) - math.cos(theta))
        h, theta = h + step * math.sin(middle[1]), theta + step * middle[2]
        curvature, height = curvature + step * (drag(*middle[:2]) - math.cos(middle[1])), height - step * math.cos(middle[1])
        if not (1e-3 < theta < 3.0 and middle[1] > 1e-3):
            return math.nan, height
    return theta, height


def steady_menisci(capillary_number: float, slip: float, count: int = 160) -> np.ndarray:
    """Angles in degrees and heights of steady menisci at a capillary number, from low to high lines."""
    starts = math.exp(-6.0) * np.geomspace(0.2, 12.0, count)
    found = np.array([wall_angle(capillary_number, start, slip) for start in starts])
    found[:, 0] = np.degrees(found[:, 0])
    return found[np.isfinite(found[:, 0])]


@functools.cache
def fold(angle: float, slip: float) -> tuple[float, float]:
    """The largest capillary number at which a line rests, and its height in capillary lengths."""
    low, high = 1e-4, 0.5
    while high > 1.001 * low:
        middle = math.sqrt(low * high)
        if steady_menisci(middle, slip)[:, 0].min() > angle:
            high = middle
        else:
            low = middle
    found = steady_menisci(low, slip)
    return low, found[found[:, 0].argmin(), 1]


# Capillary length in m, and tension over viscosity in m/s, of the case.
LENGTH, UNIT_SPEED, ANGLE = 1.5e-3, 0.2163, 60.0


def resting_height(capillary_number: float, slip: float) -> float:
    """Height in capillary lengths of the lowest steady meniscus at the angle of the case; NaN if there is none."""
    found = steady_menisci(capillary_number, slip)
    for (a, low), (b, high) in itertools.pairwise(found):
        if (a - ANGLE) * (b - ANGLE) <= 0.0:
            return low + (high - low) * (ANGLE - a) / (b - a)
    return math.nan


def bath_and_line(directory: Path, run: str) -> np.ndarray:
    """Over the frames of a run: time in s, and height in m of the contact line (displacement in the series) above the interface at the other side."""
    time, line = series(directory, run, ["time_s", "receding_line_m"])
    time, line = time[np.isfinite(line)], line[np.isfinite(line)]
    found = []
    for frame in results.frames(directory / "runs" / run / "interface.pvd"):
        points = np.asarray(results.read(frame.file).points)
        found.append((frame.time, np.interp(frame.time, time, line) - points[points[:, 0].argmax(), 1]))
    return np.array(found).T


def plate(directory: Path, row: dict[str, str]) -> dict[str, float]:
    """The height of the line beside that of lubrication theory, in capillary lengths, its rise, and how often liquid stays on the plate."""
    slip, number = float(row["slip"]) / LENGTH, float(row["speed"]) / UNIT_SPEED
    time, height = bath_and_line(directory, row["run"])
    late = time >= 0.75 * time[-1]
    return {
        "capillary-number": number,
        "over-fold": number / fold(ANGLE, slip)[0],
        "height": height[late].mean() / LENGTH,
        "lubrication": resting_height(number, slip),
        "rise-over-speed": np.polyfit(time[late], height[late], 1)[0] / float(row["speed"]),
        "with-pieces": (series(directory, row["run"], ["wetting_blobs"])[0] > 1).mean(),
    }


def folds(_: dict) -> list[str]:
    """The table of folds: capillary number and height."""
    lines = ["| fold at a slip length of | at 30 degrees: capillary number, height | at 60 degrees |", "|---" * 3 + "|"]
    for slip in (0.1, 0.05):
        lines.append(f"| {slip} | " + " | ".join("{:.4f}, {:.2f}".format(*fold(angle, slip)) for angle in (30.0, 60.0)) + " |")
    return lines


def draw_plate(directory: Path, picture: Path) -> None:
    """Height over time in units of the capillary length and of capillary length over speed, a panel for each slip length and spacing."""
    rows = sorted(runs(directory), key=lambda row: float(row["speed"]))
    walls = sorted({(row["slip"], row["spacing"]) for row in rows}, key=lambda wall: (-float(wall[0]), -float(wall[1])))
    figure, panels = plt.subplots(1, len(walls), figsize=(11, 3.8), sharey=True, layout="constrained")
    for (slip, spacing), axes in zip(walls, panels, strict=True):
        chosen = [row for row in rows if (row["slip"], row["spacing"]) == (slip, spacing)]
        for row, shade in zip(chosen, plt.cm.viridis(np.linspace(0.0, 0.85, len(chosen))), strict=True):
            time, height = bath_and_line(directory, row["run"])
            number = float(row["speed"]) / UNIT_SPEED
            axes.plot(time * float(row["speed"]) / LENGTH, height / LENGTH, color=shade, label=f"Ca = {number:.2f}")
            level = resting_height(number, float(slip) / LENGTH)
            axes.axhline(level, color=shade, ls=":", lw=1)
        axes.set(xlabel="time x speed/capillary length", ylim=(0.0, 3.2))
        axes.set_title(f"slip length {float(slip) / LENGTH:.2g}, spacing {float(spacing) / LENGTH:.2g}")
        axes.legend(fontsize=8, loc="upper left", ncol=2)
    panels[0].set_ylabel("height of the line/capillary length")
    figure.savefig(picture, dpi=100)
    plt.close(figure)
