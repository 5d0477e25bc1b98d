"""Runs cases whose results are known, and compares how far off they are with the error bars that the program gives.

Usage: error_bars.py [--program target/release/meniscus] [--out out/error-bars] [--threads 1]

Menisci in slits and in the throat between two discs (pressure and angle known), drops on planes, discs and under gravity, a bridge, liquid
between discs (angle known). Prints a table in Markdown: what is known, what was measured with its bar, and the error over the bar.
"""

import argparse
import json
import math
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

TENSION = 0.025
ANGLE = "sph.wetting.young.contact-angle-deg"
ROOT = Path(__file__).resolve().parent.parent


@dataclass
class Known:
    """A run with its name, case, changed values and the capillary pressure in Pa, where that is known."""

    name: str
    case: str
    changes: dict[str, object] = field(default_factory=dict)
    pressure: float | None = None


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
    """A meniscus where its pressure is largest, between discs with centers at ±`half` (m); the fluid on the left, above 90 degrees on the
    right, fills as much as with the arc around the middle of the throat."""
    acute = math.radians(min(angle, 180.0 - angle))
    arc = root(lambda r: math.sqrt(radius**2 + r * r + 2 * radius * r * math.cos(acute)) - half, 0.0, 2.0 * half)
    contact = (arc * arc + half * half - radius**2) / (2.0 * half)
    edge = math.sqrt(max(arc * arc - contact * contact, 0.0))
    pore = lambda x: half * x - 0.5 * (x * math.sqrt(radius**2 - x * x) + radius**2 * math.asin(x / radius))
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
    if angle["value"] is not None and asked is not None:
        found.append(("angle", "deg", asked, angle["value"], angle["uncertainty"]))
    if known.pressure is not None:
        pressure = measures["capillary-pressure-Pa"]
        found.append(("pressure", "Pa", known.pressure, pressure["value"], pressure["uncertainty"]))
    for name, measure in measures.items():
        if name in ("interface-curvature-ratio", "capillary-pressure-ratio") and measure["uncertainty"]:
            found.append((name, "", 1.0, measure["value"], measure["uncertainty"]))
    return found


def main() -> None:
    """Runs all and prints the table."""
    parser = argparse.ArgumentParser(description="error bars of known cases")
    parser.add_argument("--program", type=Path, default=ROOT / "target/release/meniscus")
    parser.add_argument("--out", type=Path, default=Path("out/error-bars"))
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--at-once", type=int, default=2)
    asked = parser.parse_args()
    cases = known_cases()
    with ThreadPoolExecutor(asked.at_once) as pool:
        results = list(pool.map(lambda known: run(known, asked.program, asked.out, asked.threads), cases))
    print("| case | measure | known | measured | error over bar |\n|---|---|---|---|---|")
    count = within = 0
    for known, measures in zip(cases, results, strict=True):
        if measures is None:
            print(f"| {known.name} | failed | | | |")
            continue
        for name, unit, exact, value, bar in rows(known, measures):
            error = (value - exact) / bar
            count, within = count + 1, within + (abs(error) <= 2.0)
            print(f"| {known.name} | {name} | {exact:.4g} {unit} | {value:.4f} ± {bar:.2g} | {error:+.2f} |")
    print(f"\n{within} of {count} within two bars")


if __name__ == "__main__":
    main()
