"""Runs the studies of the validation pages, stores their results and writes the tables of the pages from them.

Usage: gallery.py run [NAME ...] [--program meniscus] [--out out/gallery]
       gallery.py store [NAME ...] [--out out/gallery]
       gallery.py write [--check]
       gallery.py stamp NAME [NAME ...]

`run` does the studies and what `store` does: it stores their results in `docs/validation/results` and writes their
figures and tables. `write` writes all tables from the stored results. `stamp` takes over an edit of a study or case
that changes no number. A name is that of a study file; without names it is every study of a page.

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
| `picture` | the `run` whose picture is taken and the `field` that it shows |

A cell is text with fields `{NAME}`, `{NAME:.3f}` or `{NAME / 2e-4 - 1:+.1%}`, where a name is that of a parameter or
of a column of the study's table, and arithmetic goes from left to right. ` ±` at the end of the format adds the error
bar, that by the spacing included. A column without a head is named by its field.

`write` also writes the table of all cases and studies with the sections that show them, between
`<!-- generated: cases and studies -->` and `<!-- end of generated -->`.

A stored result names the program that made it by a hash of its source: the first ten digits of the SHA-256 of the
sorted paths and contents of `src`, of the sources in `crates` and of `Cargo.lock`, at the time of `run`. `write
--check` lists the tables whose program has another source than the present one; that is no failure.
"""

import argparse
import csv
import hashlib
import io
import json
import re
import shutil
import subprocess
import tempfile
import tomllib
import zlib
from pathlib import Path

from gallery_index import INDEX, index
from gallery_tables import table

ROOT = Path(__file__).resolve().parent.parent
RESULTS = Path("docs/validation/results")
LAYOUTS = RESULTS / "tables.toml"
FIGURES = Path("docs/figures")
BLOCK = re.compile(r"^(<!-- results: (\S+) -->\n)(.*?)^<!-- end of results -->", re.DOTALL | re.MULTILINE)
# Parts of a study or case that change no run.
REMARKS = ("[[expect", "[[trend", "[report", "[[report")
DIGITS = 7
HASH_DIGITS = 10
# Ending of the list of the programs that have worked on a study folder.
PROGRAMS = "programs.txt"


def checksum(data: bytes) -> str:
    """CRC-32 in hexadecimal digits."""
    return f"{zlib.crc32(data):08x}"


def program(root: Path) -> str:
    """The hash of the present source of the program."""
    sources = [root / "src", *(root / "crates").glob("*/src")]
    files = [path for source in sources for path in source.rglob("*") if path.is_file()] + [root / "Cargo.lock"]
    digest = hashlib.sha256()
    for name, path in sorted((path.relative_to(root).as_posix(), path) for path in files):
        digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:HASH_DIGITS]


def noted(directory: Path) -> Path:
    """The list of programs beside a study folder, in which a study to begin allows no other file."""
    return directory.with_name(f"{directory.name}-{PROGRAMS}")


def note_program(root: Path, directory: Path) -> None:
    """Notes that the present program is about to work on a study folder."""
    directory.parent.mkdir(parents=True, exist_ok=True)
    before = programs(root, directory) if noted(directory).is_file() and directory.is_dir() else []
    noted(directory).write_text("\n".join(dict.fromkeys([*before, program(root)])) + "\n", encoding="utf-8")


def programs(root: Path, directory: Path) -> list[str]:
    """The programs that have worked on a study folder; the present one where none is noted."""
    file = noted(directory)
    return file.read_text(encoding="utf-8").split() if file.is_file() else [program(root)]


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


def blocks(root: Path) -> list[tuple[Path, re.Match]]:
    """The blocks of all pages."""
    pages = sorted((root / "docs").rglob("*.md"))
    return [(page, block) for page in pages for block in BLOCK.finditer(page.read_text(encoding="utf-8"))]


def used(root: Path) -> dict[str, dict]:
    """The studies of the pages, each with the keys of its picture."""
    tables, pictures = layouts(root), {}
    for _, block in blocks(root):
        layout = layout_of(tables, block[2])
        for name in layout["studies"]:
            pictures.setdefault(name, {}).update(layout.get("picture", {}) if name == layout["studies"][0] else {})
    return pictures


def shortened(text: str) -> str:
    """A number with as many digits as are stored; anything else as it is."""
    try:
        return f"{float(text):.{DIGITS}g}"
    except ValueError:
        return text


def store(root: Path, name: str, directory: Path, picture: dict) -> None:
    """Stores the complete runs of a study folder and the figures of it that a page shows."""
    import gallery_figures  # matplotlib is needed here only

    with (directory / "table.csv").open(newline="", encoding="utf-8") as file:
        head, *rows = list(csv.reader(file))
    complete = [row for row in rows if row[head.index("status")] == "done"]
    reports = [json.loads((directory / "runs" / row[0] / "report.json").read_text("utf-8")) for row in complete]
    if not reports:
        raise SystemExit(f"{directory} has no complete run")
    study = study_file(root, name)
    pages = "".join(page.read_text(encoding="utf-8") for page in (root / "docs").rglob("*.md"))
    figures = []
    if f"figures/{name}-" in pages:
        with tempfile.TemporaryDirectory() as folder:
            for figure in gallery_figures.write(directory, Path(folder), picture.get("run"), picture.get("field")):
                if f"figures/{figure.name}" in pages:
                    shutil.copyfile(figure, root / FIGURES / figure.name)
                    figures.append((FIGURES / figure.name).as_posix())
    rows_text = io.StringIO()
    measures = head.index("status") + 1
    writer = csv.writer(rows_text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows([row[:measures] + [shortened(text) for text in row[measures:]] for row in complete])
    made_by, seconds = " and ".join(programs(root, directory)), sum(report["cpu-s"] for report in reports)
    lines = [
        f"# meniscus study run {study}",
        f"# program {made_by}, {len(complete)} of {len(rows)} runs, {seconds:.{1 if seconds < 10 else 0}f} s",
        *[stamp(root, path) for path in [*inputs(root, study), *figures]],
        f"# {checksum(rows_text.getvalue().encode())} rows",
    ]
    (root / RESULTS).mkdir(parents=True, exist_ok=True)
    (root / RESULTS / f"{name}.csv").write_text("\n".join(lines) + "\n" + rows_text.getvalue(), encoding="utf-8")


def stamp_again(root: Path, name: str) -> None:
    """Takes over edits of the files of a stored result that change no number."""
    path = root / RESULTS / f"{name}.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    figures = [line.split()[-1] for line in lines if line.startswith("#") and line.split()[-1].startswith("docs/")]
    body = lines[next(index for index, line in enumerate(lines) if line.endswith(" rows")) :]
    stamps = [stamp(root, file) for file in [*inputs(root, study_file(root, name)), *figures]]
    path.write_text("\n".join([*lines[:2], *stamps, *body]) + "\n", encoding="utf-8")


def measure(path: Path) -> list[dict[str, str]]:
    """The runs of a stored result."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def sources(paths: list[Path]) -> str:
    """What stands below a table: programs, commands and processor times of its results."""
    commands: dict[str, list[str]] = {}
    for path in paths:
        command, about = [line.lstrip("# ") for line in path.read_text(encoding="utf-8").splitlines()[:2]]
        made_by, runs, seconds = about.split(", ")
        part = "" if runs.split()[0] == runs.split()[2] else f"{runs}, "
        commands.setdefault(made_by, []).append(f"`{command}` ({part}{seconds} of processor time)")
    return "; ".join(f"{made_by}: {', '.join(told)}" for made_by, told in commands.items()).capitalize() + "."


def written(root: Path, block: re.Match, tables: dict[str, dict]) -> str:
    """A block with its table, and the commands and programs of its results."""
    layout = layout_of(tables, block[2])
    paths = [root / RESULTS / f"{name}.csv" for name in layout["studies"]]
    if not all(path.is_file() for path in paths):
        return block[0]
    lines = table(layout, {path.stem: measure(path) for path in paths})
    lines += ["", sources(paths)]
    body = "\n" + "\n".join(lines).lstrip() + "\n\n"
    return f"{block[1]}{body}<!-- end of results -->"


def write(root: Path, check: bool = False) -> list[Path]:
    """Writes the tables of all pages, or only looks; returns the pages that change."""
    changed, tables = [], layouts(root)
    for page in sorted((root / "docs").rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        renewed = BLOCK.sub(lambda block: written(root, block, tables), text)
        if INDEX.search(text):
            body = "\n".join(index(root, lambda text: studies_of(text, tables)))
            renewed = INDEX.sub(lambda found: f"{found[1]}\n{body}\n\n<!-- end of generated -->", renewed)
        if renewed != text:
            changed.append(page)
            if not check:
                page.write_text(renewed, encoding="utf-8")
    return changed


def stale(root: Path) -> list[str]:
    """What of the stored results is not of the present files and pages."""
    shown = set(used(root))
    stored = {
        path.stem: path.read_text(encoding="utf-8").splitlines(keepends=True) for path in (root / RESULTS).glob("*.csv")
    }
    found = [f"{name}: stored, and on no page" for name in sorted(stored.keys() - shown)]
    found += [f"{name}: on a page, and not stored" for name in sorted(shown - stored.keys())]
    on_pages = {block[2] for _, block in blocks(root)}
    found += [f"{LAYOUTS.as_posix()}: no page shows [{name}]" for name in sorted(layouts(root).keys() - on_pages)]
    for name, lines in sorted(stored.items()):
        head = [line.strip() for line in lines if line.startswith("#")]
        rows = "".join(lines[len(head) :])
        kept = [f"# {checksum(rows.encode())} rows"]
        kept += [stamp(root, path) for path in inputs(root, study_file(root, name))]
        told = [line for line in head[2:] if line.split()[-1].startswith("docs/figures/")]
        kept += [stamp(root, line.split()[-1]) for line in told]
        found += [f"{name}: {line}" for line in sorted(set(kept) ^ set(head[2:]))]
    return found


def of_other_programs(root: Path) -> list[str]:
    """The names of the tables that a program of another source than the present one made, at least in part."""
    present, tables, found = program(root), layouts(root), []
    for name in sorted({block[2] for _, block in blocks(root)}):
        studies = layout_of(tables, name)["studies"]
        heads = [(root / RESULTS / f"{study}.csv").read_text(encoding="utf-8") for study in studies]
        if not all(head.splitlines()[1].startswith(f"# program {present},") for head in heads):
            found.append(name)
    return found


def main() -> None:
    """Runs, stores, writes or stamps."""
    parser = argparse.ArgumentParser(description="tables and figures of the validation pages")
    parser.add_argument("what", choices=["run", "store", "write", "stamp"])
    parser.add_argument("names", nargs="*", help="names of studies; all by default")
    parser.add_argument("--program", default="meniscus", help="the program that runs the studies")
    parser.add_argument("--out", type=Path, default=Path("out/gallery"), help="folder of the study folders")
    parser.add_argument(
        "--check",
        action="store_true",
        help="write nothing, but fail if a table would change or a stored result is of other files",
    )
    asked = parser.parse_intermixed_args()
    pictures = used(ROOT)
    if asked.what == "stamp" and not asked.names:
        parser.error("name the studies whose edits change no number")
    for name in asked.names or pictures:
        directory = asked.out / f"study-{name}"
        if asked.what == "run":
            note_program(ROOT, directory)
            command = [asked.program, "study", "run", study_file(ROOT, name), "--out", str(directory.resolve())]
            subprocess.run(command, cwd=ROOT, check=False)  # expectations that miss are for the page to tell
        if asked.what in ("run", "store"):
            store(ROOT, name, directory, pictures.get(name, {}))
        if asked.what == "stamp":
            stamp_again(ROOT, name)
    changed = write(ROOT, asked.check)
    for page in changed:
        print(page.relative_to(ROOT))
    if asked.check:
        found = stale(ROOT)
        print(*found, sep="\n", end="\n" if found else "")
        older = [] if found else of_other_programs(ROOT)
        if older:
            print(f"of another program than that of the present src ({program(ROOT)}): {', '.join(older)}")
        if changed or found:
            raise SystemExit(
                "not the tables of stored results, or not results of the present files: gallery.py run NAME"
            )


if __name__ == "__main__":
    main()
