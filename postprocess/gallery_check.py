"""Whether the program gives the stored results: the cheapest run of each study again, for `gallery.py check`."""

import json
import math
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import gallery_results

# Largest relative difference of a measure without an error bar.
RELATIVE = 1e-3
# Largest difference of a number without a unit: below it stands rounding.
ROUNDING = 1e-9
BARS = ("uncertainty", "discretization-uncertainty")


def cost(row: dict[str, str]) -> float:
    """The processor time of a run in s; infinite where it is not known."""
    return float(row.get("cpu-s") or "inf")


def cheapest(rows: list[dict[str, str]]) -> tuple[int, dict[str, str]]:
    """Number and row of the complete run with the least processor time."""
    complete = [(index, row) for index, row in enumerate(rows, start=1) if row["status"] == "done"]
    return min(complete, key=lambda run: cost(run[1]))


def tolerance(row: dict[str, str], name: str, relative: float) -> float:
    """How far a measure may be from the stored one: by its error bar, or by a relative difference where it has none."""
    bars = [row.get(f"{name}-{kind}") for kind in BARS]
    return max(math.hypot(*(float(bar) for bar in bars if bar)), relative * abs(float(row[name])))


def differences(stored: dict[str, str], found: dict[str, str], units: dict[str, str], relative: dict[str, float]) -> list[str]:
    """What of a stored row the measures that are found now are not."""
    lines = []
    for name, text in found.items():
        before = stored.get(name)
        if before is None:
            continue
        try:
            numbers = (float(before), float(text))
        except ValueError:
            numbers = None
        if numbers is None:
            is_same, within = before == text, "the same"
        else:
            allowed = max(tolerance(stored, name, relative.get(name, RELATIVE)), ROUNDING if units.get(name) == "" else 0.0)
            is_same, within = abs(numbers[0] - numbers[1]) <= allowed, f"{allowed:.2g}"
        if not is_same:
            lines.append(f"{name} was {before or 'none'}, is {gallery_results.shortened(text) or 'none'} (tolerance {within})")
    return lines


def again(root: Path, program: str, name: str, settings: dict) -> list[str]:
    """Does the cheapest run of a study again and returns what differs."""
    stored = gallery_results.rows_of(root / gallery_results.RESULTS / f"{name}.csv")
    index, row = cheapest(stored)
    with tempfile.TemporaryDirectory() as folder:
        directory = Path(folder) / f"study-{name}"
        command = [program, "study", "run", gallery_results.study_file(root, name), "--index", str(index), "--out", str(directory)]
        done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        path = directory / "runs" / row["run"] / "report.json"
        if not path.is_file():
            return [f"{name}: run {index}, {row['run']}, has no report: {done.stderr.strip()[-300:]}"]
        report = json.loads(path.read_text(encoding="utf-8"))
        found = {key: "" if reading["value"] is None else repr(reading["value"]) for key, reading in report["measures"].items()}
        units = {key: reading["unit"] for key, reading in report["measures"].items()}
        found |= gallery_results.derived(settings, directory, row | found)
    return [f"{name}, {row['run']}: {line}" for line in differences(row, found, units, settings.get("tolerance", {}))]


def check(root: Path, program: str, studies: dict[str, dict], limit: float, jobs: int) -> list[str]:
    """The differences of all studies whose cheapest run takes less than `limit` s of processor time."""
    costs, lost = {}, []
    for name in studies:
        path = root / gallery_results.RESULTS / f"{name}.csv"
        if path.is_file():
            costs[name] = cost(cheapest(gallery_results.rows_of(path))[1])
        else:
            lost.append(f"{name}: not stored")
    chosen = sorted((name for name in costs if costs[name] < limit), key=costs.get, reverse=True)
    print(f"{len(chosen)} of {len(studies)} studies, a run each: {sum(costs[name] for name in chosen):.0f} s of processor time", flush=True)
    with ThreadPoolExecutor(jobs) as pool:
        found = pool.map(lambda name: again(root, program, name, studies[name]), chosen)
        return lost + [line for lines in found for line in lines]
