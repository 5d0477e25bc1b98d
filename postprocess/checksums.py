"""Checksums of the results of all cases, to show that a change of the program changes no bit of them.

Usage: checksums.py store FILE [CASE ...] [--program meniscus] [--steps 40]
       checksums.py compare FILE [--program meniscus]

`store` runs every case of `cases` (or those named) to its end, or to a time of about so many steps, and stores a checksum of
its series, its files for ParaView, its saved state, its report and its other files each. `compare` runs the same cases to the same
times, prints which files differ, and ends with exit code 1 where one does. Of `report.json`, what depends on the machine and its
load is left out, and the sentences on methods. Bits are those of one kind of processor: store and compare on the same one.
"""

import argparse
import hashlib
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# What a report holds that is not a result.
OF_THE_MACHINE = ("version", "machine", "threads", "wall-time-s", "cpu-s", "restarts", "started", "output")
# Exit codes of runs with results: done, and a missed expectation, as a run that is cut short may have.
FINISHED = (0, 5)


def kind(path: Path) -> str:
    """The group in which a file of a run is counted."""
    if path.suffix in {".vtu", ".pvd"}:
        return "vtk"
    if path.parts[0] == "restart":
        return "state"
    return path.name if path.name in {"series.csv", "report.json"} else "other"


def content(path: Path) -> bytes:
    """The bytes of a file that count."""
    if path.name != "report.json":
        return path.read_bytes()
    report = json.loads(path.read_text())
    report.get("solver", {}).pop("wall-time-s", None)
    for measure in report.get("measures", {}).values():
        measure.pop("method", None)
    return json.dumps({key: value for key, value in report.items() if key not in OF_THE_MACHINE}).encode()


def checksums(folder: Path) -> dict[str, str]:
    """A checksum for each kind of file in the folder of a run."""
    found: dict[str, hashlib._Hash] = {}
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = path.relative_to(folder)
        if path.suffix in {".png", ".svg", ".lock"} or path.name == "cpu-s":
            continue
        digest = found.setdefault(kind(name), hashlib.sha256())
        digest.update(str(name).encode() + b"\0" + content(path) + b"\0")
    return {name: digest.hexdigest()[:16] for name, digest in sorted(found.items())}


def short_end(program: str, case: Path, steps: int) -> float | None:
    """A time of about so many steps in s, none where the case is short or has no time."""
    end = tomllib.loads(case.read_text()).get("time", {}).get("end")
    if end is None:
        return None
    told = subprocess.run([program, "check", str(case), "--json"], capture_output=True, text=True, check=True)
    expected = json.loads(told.stdout)["steps"]
    return float(f"{end * steps / expected:.2g}") if expected > steps else None


def run(program: str, case: Path, end: float | None) -> dict[str, str]:
    """The checksums of a run of a case to a time in s."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        command = [program, "run", str(case), "--out", str(out)]
        if end is not None:
            command += ["--set", f"time.end={end!r}"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode not in FINISHED:
            return {"exit code": str(done.returncode), "message": done.stderr.strip()[-400:]}
        return checksums(out)


def store(program: str, cases: list[Path], steps: int) -> dict:
    """The end and the checksums of each case."""
    found = {}
    for case in cases:
        name = str(case.resolve().relative_to(ROOT))
        end = short_end(program, case, steps)
        found[name] = {"end": end, "checksums": run(program, case, end)}
        print(name, *found[name]["checksums"].values(), flush=True)
    return found


def compare(program: str, stored: dict) -> bool:
    """Whether the program gives what is stored; prints what differs."""
    equal = True
    for name, before in stored.items():
        now = run(program, ROOT / name, before["end"])
        kinds = now.keys() | before["checksums"].keys()
        differing = sorted(key for key in kinds if now.get(key) != before["checksums"].get(key))
        print(name, "differs: " + ", ".join(differing) if differing else "equal", flush=True)
        equal &= not differing
    return equal


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["store", "compare"])
    parser.add_argument("file", type=Path)
    parser.add_argument("cases", nargs="*", type=Path, help="case files; without them all of cases/")
    parser.add_argument("--program", default=str(ROOT / "target/release/meniscus"))
    parser.add_argument("--steps", type=int, default=40, help="about so many steps each")
    arguments = parser.parse_args()
    if arguments.command == "store":
        cases = arguments.cases or sorted((ROOT / "cases").rglob("*.toml"))
        stored = store(arguments.program, cases, arguments.steps)
        arguments.file.write_text(json.dumps(stored, indent=1) + "\n")
    elif not compare(arguments.program, json.loads(arguments.file.read_text())):
        sys.exit(1)


if __name__ == "__main__":
    main()
