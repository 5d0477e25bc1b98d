"""Our rows beside those of six codes in the public benchmark of surface-tension-driven flows: tables for `gallery.py`.

Of drops: the median over the last half of the largest velocity error in the domain, and our rank among all codes. Of waves: the root mean square difference
over the first amplitude to the linear solution, which the public reference takes for infinitely deep fluids; ours also to that of the box.
"""

import cmath
import math
from collections import defaultdict
from pathlib import Path

from gallery_results import rows_of

OTHERS = Path(__file__).parent / "public-benchmark.csv"
OURS = "**meniscus**"
FLUIDS = {"water-air": "water and air", "gearoil-air": "gear oil and air", "oil_novec7500-water": "Novec 7500 and water"}
CELLS = (32, 64, 128)


def drops(runs: list[dict[str, str]], case: str) -> list[str]:
    """The table of a case with a drop: a row for each code, errors at 32, 64, 128 cells for each pair; then ranks and processor times."""
    errors = defaultdict(dict)
    for row in rows_of(OTHERS):
        if row["case"] == case and int(row["cells"]) in CELLS:
            errors[row["solver"]][row["fluids"], int(row["cells"])] = float(row["largest_speed_error_m_per_s"])
    seconds = {}
    for row in runs:
        key = row["fluids"], int(float(row["cells"]))
        errors[OURS][key] = float(row["parasitic-speed-m-per-s"])
        seconds[key] = float(row["cpu-s"])
    lines = ["| code | " + " | ".join(FLUIDS.values()) + " |", "|---" * (1 + len(FLUIDS)) + "|"]
    for solver in sorted(errors, key=lambda name: name != OURS):
        cells = [" / ".join(f"{errors[solver].get((fluids, n), math.nan):.2g}" for n in CELLS) for fluids in FLUIDS]
        lines.append(f"| {solver} | " + " | ".join(cells) + " |")
    ranks = []
    for fluids in FLUIDS:
        places = [sorted(errors, key=lambda name: errors[name].get((fluids, n), math.inf)).index(OURS) + 1 for n in CELLS]
        ranks.append(" / ".join(map(str, places)))
    lines.append(f"| our rank of {len(errors)} | " + " | ".join(ranks) + " |")
    return [*lines, times(seconds)]


def times(seconds: dict[tuple[str, int], float]) -> str:
    """The row of our processor times in s."""
    cells = [" / ".join(f"{seconds.get((fluids, n), math.nan):.0f}" for n in CELLS) for fluids in FLUIDS]
    return "| our processor time in s | " + " | ".join(cells) + " |"


def at_rest(results: dict[str, list[dict[str, str]]]) -> list[str]:
    """The table of drops at rest."""
    return drops(results["stationary-drop"], "stationary-drop")


def travelling(results: dict[str, list[dict[str, str]]]) -> list[str]:
    """The table of drops that travel."""
    return drops(results["translating-drop"], "translating-drop")


def beside_others(results: dict[str, list[dict[str, str]]]) -> list[str]:
    """Speeds about travelling drops at 64 cells and angles on a tilted wall, in few numbers."""
    ours = {row["fluids"]: float(row["parasitic-speed-m-per-s"]) for row in results["translating-drop"] if float(row["cells"]) == 64}
    speeds = defaultdict(dict, {OURS: ours})
    for row in rows_of(OTHERS):
        if row["case"] == "translating-drop" and int(row["cells"]) == 64:
            speeds[row["solver"]][row["fluids"]] = float(row["largest_speed_error_m_per_s"])
    wall = [row for row in results["tilted-wall"] if row["angle"] in ("30", "90", "150")]
    angles = {
        OURS: [f"{float(row['contact-angle-deg']):.1f}" for row in wall],
        "Basilisk": [row["basilisk"] for row in wall],
        "peclet": [row["peclet"] for row in wall],
    }
    lines = ["| code | " + " | ".join(f"drop of {name}" for name in FLUIDS.values()) + " | " + " | ".join(f"{row['angle']} degrees" for row in wall) + " |"]
    lines.append("|---" * (1 + len(FLUIDS) + len(wall)) + "|")
    for solver in dict.fromkeys([*speeds, *angles]):
        cells = [f"{speeds[solver][fluids]:.2g} m/s" if solver in speeds else "–" for fluids in FLUIDS]
        lines.append(f"| {solver} | " + " | ".join([*cells, *angles.get(solver, ["–"] * len(wall))]) + " |")
    return lines


def amplitude(time: float, k: float, depth: float, fluids: list[tuple[float, float]], tension: float) -> float:
    """Amplitude over the first one of a small wave of the wave number `k` (1/m) between two fluids (density, viscosity), each `depth` (m) from a slip wall."""
    if time <= 0.0:
        return 1.0
    terms, shift = 60, 11
    rate = 18.4 / (2.0 * time)
    total = transform(complex(rate, 0.0), k, depth, fluids, tension).real / 2.0
    sums = []
    for j in range(1, terms + shift + 1):
        total += (-1) ** j * transform(complex(rate, j * math.pi / time), k, depth, fluids, tension).real
        if j >= terms:
            sums.append(total)
    weights = [math.comb(shift, i) * 2.0**-shift for i in range(shift + 1)]
    return math.exp(9.2) / time * sum(weight * value for weight, value in zip(weights, sums, strict=True))


def transform(s: complex, k: float, depth: float, fluids: list[tuple[float, float]], tension: float) -> complex:
    """Its Laplace transform, with the summation of Abate and Whitt above: the conditions at the interface for both parts of the flow in each fluid."""
    (r1, m1), (r2, m2) = fluids
    q1, q2 = cmath.sqrt(k * k + s * r1 / m1), cmath.sqrt(k * k + s * r2 / m2)

    def steep(m: complex) -> complex:
        return m / cmath.tanh(m * depth) if (m * depth).real < 40.0 else m

    of_k, of_q1, of_q2 = steep(k), steep(q1), steep(q2)
    system = [
        [1, 1, -1, -1, 0, 0],
        [of_k, of_q1, of_k, of_q2, 0, 0],
        [2 * m1 * k * k, m1 * (q1 * q1 + k * k), -2 * m2 * k * k, -m2 * (q2 * q2 + k * k), 0, 0],
        [of_k * (r1 * s / k**2 + 2 * m1), 2 * m1 * of_q1, of_k * (r2 * s / k**2 + 2 * m2), 2 * m2 * of_q2, tension * k * k, 0],
        [-1, -1, 0, 0, s, 1],
    ]
    return solved(system)[-1]


def solved(rows: list[list[complex]]) -> list[complex]:
    """The solution of a linear system with its right side in the last column, by elimination with pivots."""
    count = len(rows)
    scaled = [[value / max(map(abs, row[:-1])) for value in row] for row in rows]
    for k in range(count):
        pivot = max(range(k, count), key=lambda i: abs(scaled[i][k]))
        scaled[k], scaled[pivot] = scaled[pivot], scaled[k]
        for i in range(k + 1, count):
            factor = scaled[i][k] / scaled[k][k]
            scaled[i] = [a - factor * b for a, b in zip(scaled[i], scaled[k], strict=True)]
    found = [0j] * count
    for k in reversed(range(count)):
        found[k] = (scaled[k][-1] - sum(scaled[k][j] * found[j] for j in range(k + 1, count))) / scaled[k][k]
    return found


def wave_error(directory: Path, row: dict[str, str], depth: float) -> float:
    """Root mean square difference of the amplitude to the linear solution, over the first amplitude."""
    lines = rows_of(directory / "runs" / row["run"] / "series.csv")
    series = [(float(line["time_s"]), float(line["wave_amplitude_m"])) for line in lines]
    fluids = [(float(row["density"]), float(row["viscosity"])), (float(row["other-density"]), float(row["other-viscosity"]))]
    k = 2.0 * math.pi / 2.6e-3
    first = series[0][1]
    squares = [(a / first - amplitude(t, k, depth, fluids, float(row["tension"]))) ** 2 for t, a in series]
    return math.sqrt(sum(squares) / len(squares))


def wave_errors(directory: Path, row: dict[str, str]) -> dict[str, float]:
    """The differences of a run to both solutions."""
    return {"error-of-infinite-depth": wave_error(directory, row, math.inf), "error-of-the-box": wave_error(directory, row, 1.3e-3)}


def waves(results: dict[str, list[dict[str, str]]]) -> list[str]:
    """The table of waves: differences at 32, 64, 128 cells for each pair."""
    errors = defaultdict(dict)
    for row in rows_of(OTHERS):
        if row["case"] == "wave" and int(row["cells"]) in CELLS and row["wave_rms_error"]:
            errors[row["solver"]][row["fluids"], int(row["cells"])] = float(row["wave_rms_error"])
    box, seconds = OURS + ", against the solution of the box", {}
    for row in results["wave"]:
        key = row["fluids"], int(float(row["cells"]))
        errors[OURS][key] = float(row["error-of-infinite-depth"])
        errors[box][key] = float(row["error-of-the-box"])
        seconds[key] = float(row["cpu-s"])
    lines = ["| code | " + " | ".join(FLUIDS.values()) + " |", "|---" * (1 + len(FLUIDS)) + "|"]
    for solver in sorted(errors, key=lambda name: not name.startswith(OURS)):
        cells = [" / ".join(f"{errors[solver][fluids, n]:.3g}" if (fluids, n) in errors[solver] else "–" for n in CELLS) for fluids in FLUIDS]
        lines.append(f"| {solver} | " + " | ".join(cells) + " |")
    return [*lines, times(seconds)]
