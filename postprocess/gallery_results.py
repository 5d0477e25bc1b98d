"""Results of studies as the documentation keeps them: `docs/validation/results/NAME.csv`, for `gallery.py`.

    # meniscus study run studies/validation/jurin.toml
    # 4 of 4 runs, 214 s
    # missed rise-ratio: spacing=5e-5: 1 ± 0.015, found 1.0161
    # 3ef47fae studies/validation/jurin.toml
    # 95cb6f22 rows
    run,spacing,status,rise-ratio,...,cpu-s

Below the command, the number of runs and their processor time stand the expectations that are missed, checksums of the study, of the files that it names, of
its figures and of the rows, and the rows of the table of the study with the processor time of each run in s. Measures have seven digits.
"""

import csv
import importlib
import io
import json
import re
import shutil
import tempfile
import zlib
from collections.abc import Callable
from pathlib import Path

RESULTS = Path("docs/validation/results")
FIGURES = Path("docs/figures")
# Parts of a study or case that change no run.
REMARKS = ("[[expect", "[[trend", "[report", "[[report")
DIGITS = 7
MISSED = "# missed "


def checksum(data: bytes) -> str:
    """CRC-32 in hexadecimal digits."""
    return f"{zlib.crc32(data):08x}"


def essence(text: str) -> str:
    """What of a study, case or shape file can change a run: no comments, title, expectations and report."""
    kept, counts = [], True
    for line in (line.split("#")[0].strip() for line in text.splitlines()):
        if line.startswith("["):
            counts = not line.startswith(REMARKS)
        if line and counts and not line.startswith("title"):
            kept.append(line)
    return "\n".join(kept)


def stamp(root: Path, path: str) -> str:
    """The line of a stored result that tells the content of a file."""
    data = (root / path).read_bytes()
    is_text = path.endswith((".toml", ".csv"))
    return f"# {checksum(essence(data.decode()).encode() if is_text else data)} {path}"


def inputs(root: Path, path: str) -> list[str]:
    """A study or case file and the files that it names, and so on."""
    found = [path]
    if path.endswith(".toml"):
        for name in re.findall(r'"([^"\n]+\.\w+)"', (root / path).read_text(encoding="utf-8")):
            named = (root / path).parent / name
            if named.is_file():
                found += inputs(root, named.resolve().relative_to(root.resolve()).as_posix())
    return list(dict.fromkeys(found))


def study_file(root: Path, name: str) -> str:
    """Path of the study of a name."""
    found = [path.relative_to(root).as_posix() for path in sorted((root / "studies").rglob(f"{name}.toml"))]
    if len(found) != 1:
        raise SystemExit(f"studies has {len(found)} files {name}.toml")
    return found[0]


def function(name: str) -> Callable:
    """The function `module.function` of this folder."""
    module, _, inside = name.partition(".")
    return getattr(importlib.import_module(module), inside)


def shortened(text: str) -> str:
    """A number with as many digits as are stored; anything else as it is."""
    try:
        return f"{float(text):.{DIGITS}g}"
    except ValueError:
        return text


def derived(settings: dict, directory: Path, row: dict[str, str]) -> dict[str, str]:
    """The further columns of a complete run that a function of the layout finds in its folder; empty where it finds none."""
    found = function(settings["derived"])(directory, row) if "derived" in settings else {}
    return {name: "" if value is None or value != value else str(value) for name, value in found.items()}


def table_of(directory: Path, settings: dict) -> list[dict[str, str]]:
    """The rows of the table of a study folder, those of complete runs with further columns and the processor time in s."""
    rows = rows_of(directory / "table.csv")
    for row in rows:
        if row["status"] == "done":
            report = json.loads((directory / "runs" / row["run"] / "report.json").read_text("utf-8"))
            row |= derived(settings, directory, row) | {"cpu-s": str(report["cpu-s"])}
    if not any("cpu-s" in row and row["cpu-s"] for row in rows):
        raise SystemExit(f"{directory} has no complete run")
    return rows


def missed(directory: Path) -> list[str]:
    """The lines of the expectations and trends that a study misses."""
    path = directory / "expectations.csv"
    if not path.is_file():
        return []
    judged = [row for row in rows_of(path) if row["verdict"] == "missed"]
    return [f"{MISSED}{row['measure']}: {row['run']}: {row['expected']}, found {row['found']}" for row in judged]


def draw(root: Path, name: str, directory: Path, settings: dict) -> list[str]:
    """Writes the figures of a study that a page shows: curves, the picture of a run, and those of functions of the layout."""
    import gallery_figures  # matplotlib is needed here only

    pages = "".join(page.read_text(encoding="utf-8") for page in (root / "docs").rglob("*.md"))
    picture, written = settings.get("picture", {}), []
    with tempfile.TemporaryDirectory() as folder:
        drawn = [Path(folder) / figure for figure in settings.get("drawn", {})]
        for figure in drawn:
            function(settings["drawn"][figure.name])(directory, figure)
        if f"figures/{name}-" in pages:
            drawn += gallery_figures.write(directory, Path(folder), picture.get("run"), picture.get("field"))
        for figure in drawn:
            if f"figures/{figure.name}" in pages:
                shutil.copyfile(figure, root / FIGURES / figure.name)
                written.append((FIGURES / figure.name).as_posix())
    return written


def store(root: Path, name: str, directory: Path, settings: dict) -> None:
    """Stores the results of a study folder and the figures of it that a page shows."""
    rows = table_of(directory, settings)
    complete = [row for row in rows if row["status"] == "done"]
    figures = draw(root, name, directory, settings)
    study = study_file(root, name)
    heads = list(dict.fromkeys(head for row in rows for head in row))
    measures = heads[heads.index("status") + 1 :]
    text = io.StringIO()
    writer = csv.DictWriter(text, heads, lineterminator="\n")
    writer.writeheader()
    writer.writerows([row | {head: shortened(row.get(head, "")) for head in measures} for row in rows])
    seconds = sum(float(row["cpu-s"]) for row in complete)
    lines = [
        f"# meniscus study run {study}",
        f"# {len(complete)} of {len(rows)} runs, {seconds:.{1 if seconds < 10 else 0}f} s",
        *missed(directory),
        *[stamp(root, path) for path in [*inputs(root, study), *figures]],
        f"# {checksum(text.getvalue().encode())} rows",
    ]
    (root / RESULTS).mkdir(parents=True, exist_ok=True)
    (root / RESULTS / f"{name}.csv").write_text("\n".join(lines) + "\n" + text.getvalue(), encoding="utf-8")


def head_of(path: Path) -> list[str]:
    """The lines above the rows of a stored result."""
    return [line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("#")]


def rows_of(path: Path) -> list[dict[str, str]]:
    """The rows of a table in CSV, below lines of comments."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def stamp_again(root: Path, name: str) -> None:
    """Takes over edits of the files of a stored result that change no number."""
    path = root / RESULTS / f"{name}.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    figures = [line.split()[-1] for line in lines if line.startswith("#") and line.split()[-1].startswith("docs/")]
    body = lines[next(index for index, line in enumerate(lines) if line.endswith(" rows")) :]
    told = [line for line in lines[2:] if line.startswith(MISSED)]
    stamps = [stamp(root, file) for file in [*inputs(root, study_file(root, name)), *figures]]
    path.write_text("\n".join([*lines[:2], *told, *stamps, *body]) + "\n", encoding="utf-8")


def of_other_files(root: Path, name: str) -> list[str]:
    """The stamps of a stored result that the present files do not have, and the other way round."""
    lines = (root / RESULTS / f"{name}.csv").read_text(encoding="utf-8").splitlines(keepends=True)
    head = [line.strip() for line in lines if line.startswith("#")]
    rows = "".join(lines[len(head) :])
    kept = [f"# {checksum(rows.encode())} rows"]
    kept += [stamp(root, path) for path in inputs(root, study_file(root, name))]
    told = [line for line in head[2:] if not line.startswith(MISSED)]
    kept += [stamp(root, line.split()[-1]) for line in told if line.split()[-1].startswith("docs/figures/")]
    return [f"{name}: {line}" for line in sorted(set(kept) ^ set(told))]
