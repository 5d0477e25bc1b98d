"""Runs the studies of the documentation, stores their results, writes the tables of the pages, and checks that the program still gives them.

Usage: gallery.py run [NAME ...] [--program meniscus] [--out out/gallery] [--jobs N]
       gallery.py check [NAME ...] [--program meniscus] [--limit SECONDS] [--jobs N]
       gallery.py store [NAME ...] [--out out/gallery]
       gallery.py write [--check]
       gallery.py stamp NAME [NAME ...]

A name is that of a study file; without names it is every study of a page. `run` tells how long it will take, does the studies, the longest first and
`--jobs` at a time, and what `store` does: it stores their results in `docs/validation/results` and writes their figures and tables. Started again with the
same `--out` it goes on where it was. `check` does the cheapest run of each study again and fails where a measure is not the stored one within its error bar
(or, without one, within 0.1 % or the `tolerance` of the layout). `write` writes all tables from the stored results. `stamp` takes over an edit of a study or
case that changes no number.

A page shows a table between two comments:

    <!-- results: NAME -->
    <!-- end of results -->

Its layout is the table NAME in `docs/validation/results/tables.toml`:

    [sessile-angle]
    rows = "angle"
    cell = "{contact-angle-deg:.2f ±} ({height-ratio:.3f})"
    columns = [
        { head = "angle", cell = "{angle}" },
        { head = "12.5 spacings", spacing = 8e-5 },
    ]

| key | meaning |
|---|---|
| `studies` | names of the studies whose runs it shows; by default the study NAME |
| `rows` | parameters whose values make a row each; a row per run without it |
| `where` | parameter values of the runs that count, as far as they have these parameters |
| `columns` | `head`, `cell`, the study `of` several, and parameter values of the runs that the column shows |
| `cell` | the cell of columns without one |
| `names` | what stands for a value of a parameter: `names.PARAMETER.VALUE = "text"` |
| `more` | further rows at the end, as text |
| `by` | function `module.function` of this folder that makes the lines of the table from the rows of each study, in place of `columns` |
| `derived` | function that finds further columns of a run from its folder and row |
| `drawn` | figures of functions from the folder of the study: `drawn."NAME.png" = "module.function"` |
| `picture` | the `run` whose picture is taken and the `field` that it shows |
| `missed` | why the study misses expectations of a measure: `missed.MEASURE = "sentence"`; each one that is missed needs it |
| `tolerance` | relative difference that `check` allows a measure: `tolerance.MEASURE = 0.1` |

A cell is text with fields `{NAME}`, `{NAME:.3f}` or `{NAME / 2e-4 - 1:+.1%}`, where a name is that of a parameter or of a column of the study's table, and
arithmetic goes from left to right. ` ±` at the end of the format adds the error bar, that by the spacing included. A column without a head is named by its
field.

`write` also writes the table of all cases and studies with the sections that show them, between `<!-- generated: cases and studies -->` and
`<!-- end of generated -->`.
"""

import argparse
import os
import re
import subprocess
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

import gallery_check
from gallery_index import INDEX, index
from gallery_results import MISSED, RESULTS, function, head_of, of_other_files, rows_of, stamp_again, store, study_file
from gallery_tables import table

ROOT = Path(__file__).resolve().parent.parent
LAYOUTS = RESULTS / "tables.toml"
BLOCK = re.compile(r"^(<!-- results: (\S+) -->\n)(.*?)^<!-- end of results -->", re.DOTALL | re.MULTILINE)
# Keys of a layout that say how its studies are stored and checked.
OF_STUDIES = ("derived", "drawn", "missed", "tolerance")


def pages(root: Path) -> list[Path]:
    """The pages that may show tables."""
    readme = root / "README.md"
    return [*([readme] if readme.is_file() else []), *sorted((root / "docs").rglob("*.md"))]


def layouts(root: Path) -> dict[str, dict]:
    """The layouts of all tables."""
    return tomllib.loads((root / LAYOUTS).read_text(encoding="utf-8"))


def layout_of(tables: dict[str, dict], name: str) -> dict:
    """The layout of a table, with its studies."""
    if name not in tables:
        raise SystemExit(f"{LAYOUTS.as_posix()} has no [{name}]")
    return {"studies": [name]} | tables[name]


def studies_of(text: str, tables: dict[str, dict]) -> list[str]:
    """The studies whose tables a text shows."""
    return [study for block in BLOCK.finditer(text) for study in layout_of(tables, block[2])["studies"]]


def shown(root: Path) -> list[str]:
    """The names of the tables of all pages."""
    return [block[2] for page in pages(root) for block in BLOCK.finditer(page.read_text(encoding="utf-8"))]


def used(root: Path) -> dict[str, dict]:
    """The studies of the pages, each with what its layouts say of it."""
    tables, found = layouts(root), {}
    for name in shown(root):
        layout = layout_of(tables, name)
        for study in layout["studies"]:
            keys = (*OF_STUDIES, "picture") if study == layout["studies"][0] else OF_STUDIES
            found.setdefault(study, {}).update({key: layout[key] for key in keys if key in layout})
    return found


def results(root: Path, name: str) -> Path:
    """Where the results of a study are stored."""
    return root / RESULTS / f"{name}.csv"


def why_missed(root: Path, name: str, layout: dict) -> list[str]:
    """A line for each measure whose expectations a study misses, with the reason of the layout."""
    lines: dict[str, list[str]] = {}
    for line in head_of(results(root, name)):
        if line.startswith(MISSED):
            measure, _, told = line.removeprefix(MISSED).partition(": ")
            lines.setdefault(measure, []).append(told)
    reasons = layout.get("missed", {})
    without = [measure for measure in lines if measure not in reasons]
    if without:
        told = "; ".join(f"{measure}: {lines[measure][0]}" for measure in without)
        raise SystemExit(f"{name} misses {told}\n{LAYOUTS.as_posix()} has no missed.{without[0]} with the reason")
    few = {measure: "; ".join(told[:2]) + (f"; and {len(told) - 2} more" if len(told) > 2 else "") for measure, told in lines.items()}
    return [f"- **Missed**: `{measure}` ({few[measure]}). {reasons[measure]}" for measure in lines]


def sources(paths: list[Path]) -> str:
    """What stands below a table: commands and processor times of its results."""
    told = []
    for path in paths:
        command, about = [line.lstrip("# ") for line in head_of(path)[:2]]
        runs, seconds = about.split(", ")
        part = "" if runs.split()[0] == runs.split()[2] else f"{runs}, "
        told.append(f"`{command}` ({part}{seconds} of processor time)")
    return ", ".join(told) + "."


def written(root: Path, block: re.Match, tables: dict[str, dict]) -> str:
    """A block with its table, the commands of its results, and what they miss."""
    layout = layout_of(tables, block[2])
    paths = [results(root, name) for name in layout["studies"]]
    if not all(path.is_file() for path in paths):
        return block[0]
    runs = {path.stem: [row for row in rows_of(path) if row["status"] == "done"] for path in paths}
    lines = function(layout["by"])(runs) if "by" in layout else table(layout, runs)
    lines += ["", sources(paths)] if paths else []
    told = [line for name in layout["studies"] for line in why_missed(root, name, layout)]
    body = "\n" + "\n".join([*lines, *([""] if told else []), *told]).strip() + "\n\n"
    return f"{block[1]}{body}<!-- end of results -->"


def write(root: Path, check: bool = False) -> list[Path]:
    """Writes the tables of all pages, or only looks; returns the pages that change."""
    changed, tables = [], layouts(root)
    for page in pages(root):
        text = page.read_text(encoding="utf-8")
        renewed = BLOCK.sub(lambda block: written(root, block, tables), text)
        if INDEX.search(text):
            body = "\n".join(index(root, lambda text: studies_of(text, tables)))
            renewed = INDEX.sub(lambda found, body=body: f"{found[1]}\n{body}\n\n<!-- end of generated -->", renewed)
        if renewed != text:
            changed.append(page)
            if not check:
                page.write_text(renewed, encoding="utf-8")
    return changed


def stale(root: Path) -> list[str]:
    """What of the stored results is not of the present files and pages."""
    on_pages, stored = set(used(root)), {path.stem for path in (root / RESULTS).glob("*.csv")}
    found = [f"{name}: stored, and on no page" for name in sorted(stored - on_pages)]
    found += [f"{name}: on a page, and not stored" for name in sorted(on_pages - stored)]
    found += [f"{LAYOUTS.as_posix()}: no page shows [{name}]" for name in sorted(layouts(root).keys() - set(shown(root)))]
    return found + [line for name in sorted(stored & on_pages) for line in of_other_files(root, name)]


def seconds_of(root: Path, name: str) -> float | None:
    """The processor time of a stored study in s; none if it is not stored."""
    path = results(root, name)
    return float(head_of(path)[1].split()[-2]) if path.is_file() else None


def run(root: Path, studies: dict[str, dict], program: str, out: Path, jobs: int) -> list[str]:
    """Does and stores studies, the longest first, each with one thread; returns the names of those that could not be done."""
    costs = {name: seconds_of(root, name) for name in studies}
    order = sorted(studies, key=lambda name: -(costs[name] if costs[name] is not None else float("inf")))
    known = [cost for cost in costs.values() if cost is not None]
    new = f", and {len(order) - len(known)} that are not stored" if len(known) < len(order) else ""
    print(f"{len(known)} studies of {sum(known) / 60:.0f} min of processor time{new}, {jobs} at a time: at least {sum(known) / jobs / 60:.0f} min", flush=True)
    started, failed = time.monotonic(), []

    def do(name: str) -> str:
        arguments = ["study", "run", study_file(root, name), "--out", str((out / f"study-{name}").resolve()), "--jobs", "1", "--threads", "1"]
        # Expectations that it misses are for the page to tell.
        subprocess.run([program, *arguments], cwd=root, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return name

    with ThreadPoolExecutor(jobs) as pool:
        for number, done in enumerate(as_completed([pool.submit(do, name) for name in order]), start=1):
            name = done.result()
            try:
                store(root, name, out / f"study-{name}", studies[name])
            except (OSError, SystemExit) as error:
                failed.append(name)
                print(error, flush=True)
            print(f"{number} of {len(order)}: {name}, after {(time.monotonic() - started) / 60:.1f} min", flush=True)
    return failed


def main() -> None:
    """Runs, checks, stores, writes or stamps."""
    parser = argparse.ArgumentParser(description="tables and figures of the documentation")
    parser.add_argument("what", choices=["run", "check", "store", "write", "stamp"])
    parser.add_argument("names", nargs="*", help="names of studies; all by default")
    parser.add_argument("--program", default="meniscus", help="the program that runs the studies")
    parser.add_argument("--out", type=Path, default=Path("out/gallery"), help="folder of the study folders")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="studies at a time, a thread each")
    parser.add_argument("--limit", type=float, default=float("inf"), help="check only studies with a run of less processor time in s")
    parser.add_argument(
        "--check",
        action="store_true",
        help="write nothing, but fail if a table would change or a stored result is of other files",
    )
    asked = parser.parse_intermixed_args()
    if asked.what == "stamp" and not asked.names:
        parser.error("name the studies whose edits change no number")
    known = used(ROOT)
    studies = {name: known.get(name, {}) for name in asked.names or known}
    if asked.what == "check":
        different = gallery_check.check(ROOT, asked.program, studies, asked.limit, asked.jobs)
        print(*different, sep="\n", end="\n" if different else "")
        raise SystemExit("not the stored results: gallery.py run NAME" if different else 0)
    failed = run(ROOT, studies, asked.program, asked.out, asked.jobs) if asked.what == "run" else []
    for name, settings in studies.items():
        if asked.what == "store":
            store(ROOT, name, asked.out / f"study-{name}", settings)
        if asked.what == "stamp":
            stamp_again(ROOT, name)
    changed = write(ROOT, asked.check)
    for page in changed:
        print(page.relative_to(ROOT))
    found = stale(ROOT) if asked.check else []
    print(*found, sep="\n", end="\n" if found else "")
    if asked.check and (changed or found):
        raise SystemExit("not the tables of stored results, or not results of the present files: gallery.py run NAME")
    if failed:
        raise SystemExit(f"not stored: {', '.join(failed)}")


if __name__ == "__main__":
    main()
