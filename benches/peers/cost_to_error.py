"""What a given error costs: angle within half a degree, jump and entry pressure within .1 %, sliding speed within 2 %, by this program and others.

Usage: cost_to_error.py [--program meniscus] [--only angle,large-angle,jump,entry,speed] [--without lbmpy,peclet]

Runs cases from coarse to fine on one thread until two resolutions in turn are within the goal, and prints a Markdown table with the first of the two, the
error at the next coarser and the next finer one. lbmpy and peclet run where this Python has them (`benches/peers/requirements.txt`); both have up to four
resolutions, and where none is within the goal the table has the one with the smallest error. Processor seconds are those of the whole run here. The others
do not stop at rest: theirs are those of the steps until the value stays within a fifth of the goal of its end. All of it takes about ten minutes.
"""

import argparse
import importlib.util
import json
import math
import os
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# A value has settled when it stays within this share of the goal of its end.
SETTLED = 0.2


@dataclass(frozen=True)
class Quantity:
    """What is measured in a case, its goal, and resolutions as numbers of spacings per length in m."""

    title: str
    case: str
    measures: tuple[str, ...]
    expected: str
    goal: float
    unit: str
    per: str
    length: float
    counts: tuple[float, ...]
    # A contact angle in degrees in place of that of the case.
    angle: float | None = None

    def reference(self) -> float:
        """The angle that is asked for, or the value that the case expects."""
        if self.angle is not None:
            return self.angle
        case = tomllib.loads((ROOT / "cases" / self.case).read_text(encoding="utf-8"))
        return next(entry["value"] for entry in case["expect"] if entry["measure"] == self.expected)

    def error(self, value: float) -> float:
        """The error of a value: in degrees, or in percent of the reference."""
        reference = self.reference()
        return value - reference if self.unit == "°" else 100.0 * (value / reference - 1.0)

    def tell(self, error: float) -> str:
        """An error in words."""
        space = "" if self.unit == "°" else " "
        return f"{error:+.{3 if self.goal < 0.2 else 2}f}{space}{self.unit}" if math.isfinite(error) else "no value"


@dataclass(frozen=True)
class Rung:
    """A run of a ladder."""

    resolution: str
    unknowns: int
    steps: int
    cpu_s: float
    error: float


@dataclass(frozen=True)
class Peer:
    """Another program: the package it needs, its script, and cells per radius with further options."""

    package: str
    script: str
    ladders: dict[str, tuple[tuple[int, tuple[str, ...]], ...]]


ANGLE, JUMP, ENTRY = "contact-angle-deg", "laplace-jump-ratio", "entry-pressure-ratio"
SPEEDS = ("receding-speed-m-per-s", "advancing-speed-m-per-s")
QUANTITIES = {
    "angle": Quantity("angle of 60°", "sessile-drop.toml", (ANGLE,), ANGLE, 0.5, "°", "radius", 8.0e-4, (5, 6, 8, 10, 14, 20), 60.0),
    "large-angle": Quantity("angle of 120°", "sessile-drop.toml", (ANGLE,), ANGLE, 0.5, "°", "radius", 8.0e-4, (5, 6, 8, 10, 14, 20), 120.0),
    "jump": Quantity("pressure jump", "laplace-drop.toml", (JUMP,), JUMP, 0.1, "%", "radius", 4.0e-4, (5, 6, 8, 10, 14, 20)),
    "entry": Quantity("entry pressure", "throat-entry.toml", (ENTRY,), ENTRY, 0.1, "%", "gap", 5.0e-4, (6, 8, 10, 12, 16, 24)),
    "speed": Quantity("sliding speed", "sliding-drop.toml", SPEEDS, SPEEDS[0], 2.0, "%", "slip length", 5.0e-5, (0.5, 0.7, 1, 1.5, 2)),
}
# Capillary times of a run by other programs: the sessile drop swings until then, the free drop is at rest at once.
LENGTHS = {"angle": 8.0, "large-angle": 8.0, "jump": 3.0}
# The width of the interface of lbmpy, 5 cells at 20 per radius, grows as the root: it becomes thinner and better resolved at once.
WIDTHS = tuple((cells, ("--width", str(width))) for cells, width in ((10, 4), (20, 5), (40, 7), (56, 8)))
CELLS: tuple[tuple[int, tuple[str, ...]], ...] = ((10, ()), (14, ()), (20, ()), (24, ()))
PEERS = (
    Peer("lbmpy", "lbmpy_drop.py", {"angle": WIDTHS, "large-angle": WIDTHS, "jump": WIDTHS}),
    Peer("peclet", "peclet_drop.py", {"angle": CELLS[:3], "large-angle": CELLS[:3], "jump": CELLS}),
)


def ours(program: str, quantity: Quantity, count: float) -> Rung:
    """A case at a resolution, without files for ParaView. A spacing that the program refuses gives no value."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        sets = [f"sph.spacing={quantity.length / count!r}", "expect=[]", "output.vtk.every-time=1e3"]
        sets += [] if quantity.angle is None else [f"sph.wetting.young.contact-angle-deg={quantity.angle!r}"]
        words = [program, "run", str(ROOT / "cases" / quantity.case), "--quiet", "--threads", "1", "--out", str(out)]
        words += [word for change in sets for word in ("--set", change)]
        done = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        path = out / "report.json"
        if not path.is_file():
            print(done.stderr.strip(), file=sys.stderr)
            return Rung(f"{count:g} per {quantity.per}", 0, 0, math.nan, math.nan)
        report = json.loads(path.read_text(encoding="utf-8"))
    found = [report["measures"][name]["value"] for name in quantity.measures]
    value = math.nan if None in found else sum(found) / len(found)
    return Rung(f"{count:g} per {quantity.per}", report["solver"]["unknowns"], report["steps"], report["cpu-s"], quantity.error(value))


def theirs(peer: Peer, name: str, cells: int, options: tuple[str, ...]) -> Rung:
    """A drop by another program."""
    quantity = QUANTITIES[name]
    angle = () if quantity.angle is None else (f"{quantity.angle:g}",)
    words = [sys.executable, str(Path(__file__).with_name(peer.script)), *angle, "--cells", str(cells), *options]
    words += ["--capillary-times", str(LENGTHS[name])]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}
    printed = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True, env=environment).stdout
    found = json.loads(printed.splitlines()[-1])
    errors = [quantity.error(value) for _, _, value in found["records"]]
    # A value that was not measured has not settled.
    away = [number for number, error in enumerate(errors) if not abs(error - errors[-1]) <= SETTLED * quantity.goal]
    first = min(away[-1] + 1 if away else 0, len(errors) - 1)
    cpu_s = found["records"][first][1]
    resolution = f"{cells} per {quantity.per}" + (f", interface {options[-1]}" if options else "")
    return Rung(resolution, found["unknowns"], round(found["steps"] * cpu_s / found["cpu_s"]), cpu_s, errors[-1])


def climb(runs, goal: float) -> tuple[list[Rung], int, bool]:
    """Runs until two in turn are within the goal: the runs, which one to tell, and whether it and the next are within the goal."""
    rungs: list[Rung] = []
    for run in runs:
        rungs.append(run())
        print(rungs[-1], file=sys.stderr)
        if len(rungs) > 1 and all(abs(rung.error) <= goal for rung in rungs[-2:]):
            return rungs, len(rungs) - 2, True
    if abs(rungs[-1].error) <= goal:
        return rungs, len(rungs) - 1, True
    finite = [number for number, rung in enumerate(rungs) if math.isfinite(rung.error)]
    return rungs, min(finite, key=lambda number: abs(rungs[number].error), default=len(rungs) - 1), False


def row(quantity: Quantity, program: str, rungs: list[Rung], place: int, met: bool) -> str:
    """A line of the table."""
    rung = rungs[place]
    coarser, finer = (quantity.tell(rungs[number].error) if 0 <= number < len(rungs) else "" for number in (place - 1, place + 1))
    space = "" if quantity.unit == "°" else " "
    error = quantity.tell(rung.error) + ("" if met else ", not within")
    cells = (quantity.title, f"{quantity.goal:g}{space}{quantity.unit}", program, rung.resolution, rung.unknowns, rung.steps)
    return "| " + " | ".join(map(str, (*cells, f"{rung.cpu_s:.2g}" if rung.cpu_s < 10.0 else f"{rung.cpu_s:.0f}", error, coarser, finer))) + " |"


def compare(program: str, name: str, peers: list[Peer]) -> list[str]:
    """The lines of a quantity, one for each program."""
    quantity = QUANTITIES[name]
    here = [lambda count=count: ours(program, quantity, count) for count in quantity.counts]
    lines = [row(quantity, "meniscus", *climb(here, quantity.goal))]
    for peer in peers:
        ladder = peer.ladders.get(name, ())
        there = [lambda rung=rung, peer=peer: theirs(peer, name, *rung) for rung in ladder]
        if there:
            lines.append(row(quantity, peer.package, *climb(there, quantity.goal)))
    return lines


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description="processor seconds to a given error")
    parser.add_argument("--program", default="meniscus", help="this program")
    parser.add_argument("--only", default=",".join(QUANTITIES), help="quantities, separated by commas")
    parser.add_argument("--without", default="", help="other programs to leave out, separated by commas")
    asked = parser.parse_args()
    wanted = [peer for peer in PEERS if peer.package not in asked.without.split(",")]
    peers = [peer for peer in wanted if importlib.util.find_spec(peer.package)]
    for peer in wanted:
        if peer not in peers:
            print(f"{peer.package} is not installed", file=sys.stderr)
    print("| quantity | goal | program | resolution | unknowns | steps | processor seconds | error | next coarser | next finer |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in asked.only.split(","):
        print("\n".join(compare(asked.program, name, peers)), flush=True)


if __name__ == "__main__":
    main()
