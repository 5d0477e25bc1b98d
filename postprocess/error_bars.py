"""Runs cases whose results are known, and compares how far off they are with the error bars that the program gives.

Usage: error_bars.py [--program target/release/meniscus] [--out out/error-bars] [--threads 1] [--drawn SEED [--runs N]]

Menisci in slits and in the throat between two discs (pressure and angle known), drops on planes, discs and under gravity, a bridge, liquid
between discs (angle known). With --drawn 60 runs instead, by a seed: 15 of these, 15 slits and throats between a floor and a lid (pressure known),
and 30 drops that are stopped while they spread or recede (angle, base and height at rest known). Prints a table in Markdown: what is known, what was
measured with its bar, and the error over the bar; then by kind the share within two bars, and the median bar over the median error.
"""

import argparse
import json
import math
import random
import shutil
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

TENSION = 0.025
ANGLE = "sph.wetting.young.contact-angle-deg"
ROOT = Path(__file__).resolve().parent.parent


@dataclass
class Known:
    """A run with its name, case, changed values and the capillary pressure in Pa, where that is known, and its kind."""

    name: str
    case: str
    changes: dict[str, object] = field(default_factory=dict)
    pressure: float | None = None
    kind: str = "plane"


def root(function, low: float, high: float) -> float:
    """Where a function that changes its sign between `low` and `high` vanishes."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        if (function(low) > 0.0) == (function(middle) > 0.0):
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def slit(angle: float, spacing: float) -> Known:
    """A meniscus between plates half a millimeter apart."""
    pressure = 2.0 * TENSION * math.cos(math.radians(angle)) / 5.0e-4
    return Known(f"slit {angle:g} deg, {5.0e-4 / spacing:g} across", "slit", {ANGLE: angle, "sph.spacing": spacing}, pressure)


def throat(angle: float, spacing: float, radius: float = 1.0e-3, half: float = 1.25e-3) -> Known:
    """A meniscus where its pressure is largest, between discs with centers at ±`half` (m).

    The fluid on the left, above 90 degrees on the right, fills as much as with the arc around the middle of the throat.
    """
    acute = math.radians(min(angle, 180.0 - angle))
    arc = root(lambda r: math.sqrt(radius**2 + r * r + 2 * radius * r * math.cos(acute)) - half, 0.0, 2.0 * half)
    contact = (arc * arc + half * half - radius**2) / (2.0 * half)
    edge = math.sqrt(max(arc * arc - contact * contact, 0.0))

    def pore(x: float) -> float:
        return half * x - 0.5 * (x * math.sqrt(radius**2 - x * x) + radius**2 * math.asin(x / radius))

    beyond = 0.5 * (arc * arc * math.acos(edge / arc) - edge * math.sqrt(arc * arc - edge * edge))
    start = root(lambda x: pore(x) - pore(edge) - beyond, 0.0, 0.999 * radius)
    side = 1.0 if angle <= 90.0 else -1.0
    changes = {
        ANGLE: angle,
        "sph.spacing": spacing,
        "sph.initial.wetting[0].rectangle.center": [start + side * 1.0e-3, 0.0],
        "expect": [],
    }
    return Known(f"throat {angle:g} deg, {5.0e-4 / spacing:g} across", "throat-entry", changes, side * TENSION / arc)


def known_cases() -> list[Known]:
    """All runs."""
    fine = 3.125e-5
    slits = [slit(angle, fine) for angle in (0, 2, 5, 10, 20, 40, 60, 90, 120, 170, 175, 178, 180)] + [slit(60, 5.0e-5), slit(30, 2.0e-5)]
    throats = [throat(angle, fine) for angle in (0, 2, 5, 10, 20, 40, 60, 90, 140, 170, 175, 178, 180)]
    throats += [throat(40, 6.25e-5), throat(60, 6.25e-5)]
    drops = [
        Known(f"drop {angle:g} deg, spacing {spacing:g} m", "sessile-drop", {ANGLE: angle, "sph.spacing": spacing, "expect": []})
        for angle, spacing in ((30, 5e-5), (60, 1e-4), (60, 5e-5), (90, 5e-5), (120, 5e-5), (150, 5e-5))
    ]
    puddles = [Known(f"drop under gravity {angle:g} deg", "sessile-gravity", {ANGLE: angle, "expect": []}) for angle in (60, 90, 120)]
    rest = [Known(name, name) for name in ("capillary-bridge", "drop-on-disc", "four-discs", "sessile-drop-turned")]
    return slits + throats + drops + puddles + rest


def with_depth(known: Known, angle: float, depth: float) -> Known:
    """The same between a floor and a lid, which add 2 cos(angle)/depth to the curvature where no corner holds a film."""
    geometry = {"slit": "geometry.depth", "throat-entry": "geometry.depth"}[known.case]
    pressure = known.pressure + 2.0 * TENSION * math.cos(math.radians(angle)) / depth
    changes = known.changes | {geometry: depth, "expect": []}
    return Known(f"{known.name}, {depth:.2g} m deep", known.case, changes, pressure, "depth")


def stopped(angle: float, end: float, spacing: float) -> Known:
    """A drop that has spread or receded from 90 degrees towards `angle` until `end` (s)."""
    changes = {
        ANGLE: round(angle, 2),
        "sph.spacing": spacing,
        "time.end": end,
        "time.steady.stop": False,
        "output.series.every-time": end / 60.0,
        "expect": [],
    }
    return Known(f"drop towards {angle:.1f} deg, {end:.2g} s", "sessile-drop", changes, kind="moving")


def drawn_cases(seed: int) -> list[Known]:
    """60 runs drawn by a seed, half of them moving."""
    dice = random.Random(seed)
    plane = dice.sample(known_cases(), 15)
    depth = []
    for i in range(15):
        angle, deep = round(dice.uniform(46.0, 134.0), 1), 10.0 ** dice.uniform(-4.3, -3.0)
        spacing = dice.choice((5.0e-5, 4.0e-5, 3.125e-5))
        depth.append(with_depth((slit if i % 2 else throat)(angle, spacing), angle, float(f"{deep:.3g}")))
    moving = [stopped(dice.uniform(30.0, 130.0), float(f"{10.0 ** dice.uniform(-2.7, -1.3):.3g}"), dice.choice((1.0e-4, 8.0e-5))) for _ in range(30)]
    return plane + depth + moving


def run(known: Known, program: Path, folder: Path, threads: int) -> dict | None:
    """The measures of a run, none where it failed."""
    out = folder / known.name.replace(" ", "-").replace(",", "")
    shutil.rmtree(out, ignore_errors=True)
    changes = [part for key, value in known.changes.items() for part in ("--set", f"{key}={json.dumps(value)}")]
    command = [program, "run", ROOT / "cases" / f"{known.case}.toml", "--out", out, "--threads", str(threads), *changes]
    subprocess.run(command, capture_output=True, check=False)
    report = out / "report.json"
    return json.loads(report.read_text(encoding="utf-8"))["measures"] if report.is_file() else None


def rows(known: Known, measures: dict) -> list[tuple[str, str, float, float, float]]:
    """Name, unit, known and measured value and bar of what is known of a run."""
    found = []
    angle, asked = measures["contact-angle-deg"], measures["requested-angle-deg"]["value"]
    if angle["value"] is not None and asked is not None and known.kind != "depth":
        found.append(("angle", "deg", asked, angle["value"], angle["uncertainty"]))
    if known.pressure is not None and abs(known.pressure) > 1.0e-9 * TENSION / 1.0e-3:
        pressure = measures["capillary-pressure-Pa"]
        found.append(("pressure", "Pa", known.pressure, pressure["value"], pressure["uncertainty"]))
    for name, measure in measures.items():
        if name in ("interface-curvature-ratio", "capillary-pressure-ratio", "base-ratio", "height-ratio") and measure["uncertainty"]:
            found.append((name, "", 1.0, measure["value"], measure["uncertainty"]))
    return found


def within_two_bars(values: list[tuple[float, float]]) -> int:
    """How many of the pairs of error and bar have an error of two bars at most."""
    return sum(abs(error) <= 2.0 * bar for error, bar in values)


def main() -> None:
    """Runs all and prints the table."""
    parser = argparse.ArgumentParser(description="error bars of known cases")
    parser.add_argument("--program", type=Path, default=ROOT / "target/release/meniscus")
    parser.add_argument("--out", type=Path, default=Path("out/error-bars"))
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--at-once", type=int, default=2)
    parser.add_argument("--drawn", type=int, metavar="SEED", help="60 runs drawn by this seed")
    parser.add_argument("--runs", type=int, help="only so many of the 60, drawn by the same seed")
    asked = parser.parse_args()
    cases = known_cases() if asked.drawn is None else drawn_cases(asked.drawn)
    if asked.runs is not None:
        cases = random.Random(asked.drawn).sample(cases, asked.runs)
    with ThreadPoolExecutor(asked.at_once) as pool:
        results = list(pool.map(lambda known: run(known, asked.program, asked.out, asked.threads), cases))
    print("| case | measure | known | measured | error over bar |\n|---|---|---|---|---|")
    found: dict[str, list[tuple[float, float]]] = {}
    for known, measures in zip(cases, results, strict=True):
        if measures is None:
            print(f"| {known.name} | failed | | | |")
            continue
        for name, unit, exact, value, bar in rows(known, measures):
            found.setdefault(known.kind, []).append(((value - exact) / exact if exact else value, bar / abs(exact or 1.0)))
            print(f"| {known.name} | {name} | {exact:.4g} {unit} | {value:.4f} ± {bar:.2g} | {(value - exact) / bar:+.2f} |")
    print("\n| kind | values | within two bars | median error | median bar |\n|---|---|---|---|---|")
    for kind, values in found.items():
        within = within_two_bars(values)
        error, bar = (statistics.median(abs(value[i]) for value in values) for i in (0, 1))
        print(f"| {kind} | {len(values)} | {100.0 * within / len(values):.0f} % | {100.0 * error:.2g} % | {100.0 * bar:.2g} % |")
    everything = [value for values in found.values() for value in values]
    if None in results or not 10 * within_two_bars(everything) >= 9 * len(everything):
        sys.exit("runs failed, or fewer than 90 % of the values lie within two bars")


if __name__ == "__main__":
    main()
