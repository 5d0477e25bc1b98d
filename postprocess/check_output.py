"""Checks output folders against the output contract.

Every file opens, arrays are present with the right sizes and finite, times ascend and are unique, and each collection
lists the files that lie in its folder, no more and no fewer.

Usage: check_output.py DIR ...
"""

import argparse
import base64
import functools
import itertools
import json
import sys
from pathlib import Path

import numpy as np
import pyvista as pv

import results

# Columns of the series that every record must have; the others are NaN where the quantity does not exist.
ALWAYS_FINITE = ["time_s", "displaced_pore_volumes", "step"]

# More pores than a page shows.
MOST_PORES = 200_000


def measure(path: str | Path) -> dict:
    """What is wrong with the folder (`problems`, empty when nothing is), with the times and counts that were found."""
    directory = Path(path)
    problems: list[str] = []
    if results.is_network(directory):
        return measure_network(directory, problems)
    film = results.is_film(directory)
    arrays = results.FILM_PARTICLE_ARRAYS if film else results.PARTICLE_ARRAYS
    found = {
        "problems": problems,
        "times": check_collection(directory, "particles", functools.partial(check_particles, arrays), problems),
        "interface-times": check_collection(directory, "interface", check_interface, problems),
        "records": check_series(directory / "series.csv", results.series_columns(directory), problems),
        "status": check_report(directory, problems),
    }
    if not film:
        found["grid-times"] = check_collection(directory, "grid", check_grid, problems)
    for kind in ("grid-times", "interface-times"):
        if found.get(kind, found["times"]) != found["times"]:
            problems.append(f"the {kind} are not the times of the particles")
    solid = directory / "solid.vtu"
    if not solid.is_file():
        problems.append("solid.vtu is missing")
    else:
        check_cells(results.read(solid), pv.CellType.LINE, "solid.vtu", problems)
    problems.extend(f"{left.relative_to(directory)} is a temporary file" for left in directory.rglob("*.tmp"))
    return found


def measure_network(directory: Path, problems: list[str]) -> dict:
    """The same of a network: regions over the displaced volume, tables and texts; of one with `results = "curve"` series and report."""
    is_whole = results.models(directory)["network"].get("results") != "curve"
    found = {
        "problems": problems,
        "times": check_collection(directory, "regions", check_regions, problems) if is_whole else [],
        "records": check_series(directory / "series.csv", results.series_columns(directory), problems),
        "status": check_report(directory, problems),
    }
    wanted = results.NETWORK_FILES if is_whole else ["network.json"]
    problems.extend(f"{name} is missing" for name in wanted if not (directory / name).is_file())
    if is_whole and (directory / "events.csv").is_file():
        check_page(directory, problems)
    return found


def check_page(directory: Path, problems: list[str]) -> None:
    """The page of a displacement has a row of data for each event; more than `MOST_PORES` have none."""
    page, events = directory / "network.html", directory / "events.csv"
    if not page.is_file():
        if sum(1 for _ in (directory / "pores.csv").open()) - 1 <= MOST_PORES:
            problems.append("network.html is missing")
        return
    text = page.read_text(encoding="utf-8").partition('id="data">')[2].partition("</script>")[0]
    saturations = json.loads(text)["runs"][0]["events"]["saturation"]
    rows, wanted = len(base64.b64decode(saturations["base64"])) // np.dtype(np.float32).itemsize, sum(1 for _ in events.open()) - 1
    if rows != wanted:
        problems.append(f"network.html: {rows} events, {wanted} in events.csv")


def check_regions(data, place: str, problems: list[str]) -> None:
    """Polygons with arrays on cells; what was not invaded has no pressure at invasion (NaN)."""
    check_cells(data, pv.CellType.POLYGON, place, problems)
    if data.n_cells == 0:
        problems.append(f"{place}: no polygons")
        return
    problems.extend(f"{place}: no array {name}" for name in results.REGION_ARRAYS if name not in data.cell_data)


def check_cells(data, kind: pv.CellType, place: str, problems: list[str]) -> None:
    """An unstructured grid with cells of one kind; there may be none."""
    if not isinstance(data, pv.UnstructuredGrid):
        problems.append(f"{place}: no unstructured grid")
    elif not (data.celltypes == kind).all():
        problems.append(f"{place}: cells other than {kind.name}")


def check_collection(directory: Path, name: str, check, problems: list[str]) -> list[float]:
    """Checks one .pvd and its files; returns the times."""
    collection = directory / f"{name}.pvd"
    if not collection.is_file():
        problems.append(f"{name}.pvd is missing")
        return []
    frames = results.frames(collection)
    times = [frame.time for frame in frames]
    if not frames:
        problems.append(f"{name}.pvd lists no file")
    if any(b <= a for a, b in itertools.pairwise(times)):
        problems.append(f"{name}.pvd: the times do not ascend: {times}")
    listed = {frame.file.resolve() for frame in frames}
    stored = {file.resolve() for file in (directory / name).glob("*.vt?")}
    problems.extend(f"{file.name} is listed in {name}.pvd but missing" for file in sorted(listed - stored))
    problems.extend(f"{file.name} is not listed in {name}.pvd" for file in sorted(stored - listed))
    for frame in frames:
        if frame.file.is_file():
            data = results.read(frame.file)
            place = f"{name}/{frame.file.name}"
            check(data, place, problems)
    return times


def check_arrays(data, arrays: dict[str, int], may_be_nan, place: str, problems: list[str]) -> None:
    """Arrays on points: present, with the right number of components, finite but where `may_be_nan`."""
    for name, components in arrays.items():
        if name not in data.point_data:
            problems.append(f"{place}: the array {name} is missing")
            continue
        values = np.asarray(data.point_data[name])
        shape = (data.n_points,) if components == 1 else (data.n_points, components)
        if values.shape != shape:
            problems.append(f"{place}: {name} has the shape {values.shape}, not {shape}")
            continue
        finite = np.isfinite(values) if components == 1 else np.isfinite(values).all(axis=1)
        wrong = int(np.count_nonzero(~(finite | may_be_nan)))
        if wrong:
            problems.append(f"{place}: {name} is not finite at {wrong} of {data.n_points} points")


def check_particles(arrays: dict[str, int], data, place: str, problems: list[str]) -> None:
    """Each particle is a vertex cell with all arrays; ids are unique and phases known."""
    check_cells(data, pv.CellType.VERTEX, place, problems)
    if data.n_points == 0 or data.n_cells != data.n_points:
        problems.append(f"{place}: {data.n_points} particles, {data.n_cells} cells")
        return
    check_arrays(data, arrays, np.zeros(data.n_points, dtype=bool), place, problems)
    if "id" in data.point_data and len(np.unique(data.point_data["id"])) != data.n_points:
        problems.append(f"{place}: ids are not unique")
    if "phase" in data.point_data and not np.isin(data.point_data["phase"], [0, 1, 2]).all():
        problems.append(f"{place}: phases other than 0, 1 and 2")
    for name in ("density", "volume"):
        if name in data.point_data and not (np.asarray(data.point_data[name]) > 0).all():
            problems.append(f"{place}: {name} is not positive everywhere")


def check_grid(data, place: str, problems: list[str]) -> None:
    """Fields on a grid of quadrilaterals; they may be missing (NaN) inside of the solids."""
    check_cells(data, pv.CellType.QUAD, place, problems)
    if data.n_cells == 0:
        problems.append(f"{place}: no grid")
        return
    solid = np.zeros(data.n_points, dtype=bool)
    if "wall-distance" in data.point_data:
        solid = np.asarray(data.point_data["wall-distance"]) <= 0.0
    check_arrays(data, results.GRID_ARRAYS, solid, place, problems)


def check_interface(data, place: str, problems: list[str]) -> None:
    """Lines with curvature; a state without interface has none. The curvature of very short lines is unknown (NaN)."""
    check_cells(data, pv.CellType.LINE, place, problems)
    if data.n_points > 0:
        if data.n_cells == 0:
            problems.append(f"{place}: {data.n_points} points but no lines")
        check_arrays(data, results.INTERFACE_ARRAYS, np.ones(data.n_points, dtype=bool), place, problems)


def check_series(path: Path, expected: list[str], problems: list[str]) -> int:
    """Columns are present and times ascend; returns the number of records."""
    if not path.is_file():
        problems.append("series.csv is missing")
        return 0
    columns = results.series(path)
    problems.extend(f"series.csv: no column {name}" for name in expected if name not in columns)
    for name in ALWAYS_FINITE:
        if name in columns and not np.isfinite(columns[name]).all():
            problems.append(f"series.csv: {name} is not finite in every row")
    times = columns.get("time_s", columns.get("displaced_pore_volumes", np.array([])))
    if (np.diff(times) <= 0).any():
        problems.append("series.csv: the times do not ascend")
    if len(times) == 0:
        problems.append("series.csv: no record")
    return len(times)


def check_report(directory: Path, problems: list[str]) -> str | None:
    """The report has its parts, and each measure value, unit, uncertainty and method; returns how the run ended."""
    if not (directory / "report.json").is_file():
        problems.append("report.json is missing")
        return None
    report = results.report(directory)
    problems.extend(f"report.json: no {key}" for key in ("version", "case", "status", "measures") if key not in report)
    for name, parts in report.get("measures", {}).items():
        missing = {"value", "unit", "uncertainty", "method"} - set(parts)
        problems.extend(f"report.json: the measure {name} has no {part}" for part in sorted(missing))
    return report.get("status")


def main() -> int:
    """Prints what is wrong, with the folder where there are several; exit code 1 where something is."""
    parser = argparse.ArgumentParser(description="check output folders against the output contract")
    parser.add_argument("directory", type=Path, nargs="+", help="output folder of `meniscus run`")
    directories = parser.parse_args().directory
    wrong = False
    for directory in directories:
        found = measure(directory)
        whose = f"{directory}: " if len(directories) > 1 else ""
        for problem in found["problems"]:
            print(f"{whose}{problem}")
        if not found["problems"]:
            print(f"{whose}{len(found['times'])} times and {found['records']} records, all as the contract says")
        wrong |= bool(found["problems"])
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
