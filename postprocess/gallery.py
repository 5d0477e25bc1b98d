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
sorted paths and contents of `src` and of `Cargo.lock`, at the time of `run`. `write --check` lists the tables whose
program has another source than the present one; that is no failure.
"""

import argparse
import csv
import hashlib
import io
import json
import math
import operator
import re
import shutil
import subprocess
import tempfile
import tomllib
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RESULTS = Path("docs/validation/results")
LAYOUTS = RESULTS / "tables.toml"
FIGURES = Path("docs/figures")
BLOCK = re.compile(r"^(<!-- results: (\S+) -->\n)(.*?)^<!-- end of results -->", re.DOTALL | re.MULTILINE)
FIELD = re.compile(r"\{([^{}:]+)(?::([^{}]*))?\}")
INDEX = re.compile(r"^(<!-- generated: cases and studies -->\n).*?^<!-- end of generated -->", re.DOTALL | re.MULTILINE)
# Parts of a study or case that change no run.
REMARKS = ("[[expect", "[[trend", "[report", "[[report")
DIGITS = 7
HASH_DIGITS = 10
# File of a study folder with the programs that have worked on it.
PROGRAMS = "programs.txt"
OPERATIONS = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}
# Keys of a column that are no parameters.
RESERVED = ("head", "cell", "of")


def checksum(data: bytes) -> str:
    """CRC-32 in hexadecimal digits."""
    return f"{zlib.crc32(data):08x}"


def program(root: Path) -> str:
    """The hash of the present source of the program."""
    files = [path for path in (root / "src").rglob("*") if path.is_file()] + [root / "Cargo.lock"]
    digest = hashlib.sha256()
    for name, path in sorted((path.relative_to(root).as_posix(), path) for path in files):
        digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:HASH_DIGITS]


def noted(directory: Path) -> Path:
    """The file beside a study folder that names the programs that have worked on it; within it `meniscus study run` allows no other file."""
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


def same(a: str, b: str) -> bool:
    """Whether two values are the same text or, to three digits, the same number."""
    try:
        return a == b or math.isclose(float(a), float(b), rel_tol=1e-3)
    except ValueError:
        return False


def matches(run: dict[str, str], values: dict) -> bool:
    """Whether a run has these values of those of its parameters that they name."""
    return all(same(run.get(key, str(value)), str(value)) for key, value in values.items())


def value(expression: str, run: dict[str, str]) -> float | None:
    """The value of an expression, from left to right; none where the run lacks a measure."""
    first, *rest = [run.get(word, word) for word in expression.split()]
    if "" in [first, *rest]:
        return None
    result = float(first)
    for sign, word in zip(rest[::2], rest[1::2], strict=True):
        number = float(word)
        result = OPERATIONS[sign](result, number)
    return result


def cell(template: str, run: dict[str, str], names: dict) -> str:
    """A cell of a table."""

    def field(match: re.Match) -> str:
        expression, form = match[1].strip(), match[2]
        if form is None:
            text = run.get(expression, "")
            return names.get(expression, {}).get(text, text)
        found = value(expression, run)
        if found is None:
            return "none"
        text = format(found, form.removesuffix("±").strip())
        bars = [run.get(f"{expression.split()[0]}-{kind}") for kind in ("uncertainty", "discretization-uncertainty")]
        bar = math.hypot(*(float(bar) for bar in bars if bar))
        if form.endswith("±") and bar:
            name = expression.split()[0]
            moved = value(expression, run | {name: str(float(run[name]) + bar)})
            text += f" ± {format(abs(moved - found), form.removesuffix('±').strip().lstrip('+'))}"
        return re.sub(r"^-|(?<=[ (])-", "\u2212", text).replace("%", " %")

    return FIELD.sub(field, template)


def table(layout: dict, results: dict[str, list[dict[str, str]]]) -> list[str]:
    """The lines of a table; none without columns."""
    keys = layout.get("rows", [])
    keys = [keys] if isinstance(keys, str) else keys
    heads, lines = [], []
    for column in layout.get("columns", []):
        named = FIELD.search(column.get("cell", ""))
        heads.append(column.get("head", f"`{named[1].split()[0]}`" if named else ""))
    runs = [run for found in results.values() for run in found if matches(run, layout.get("where", {}))]
    rows: dict[tuple, list] = {}
    for index, run in enumerate(runs):
        rows.setdefault(tuple(run.get(key) for key in keys) if keys else (index,), []).append(run)
    for row in rows.values():
        cells = []
        for column in layout.get("columns", []):
            among = [run for run in row if "of" not in column or run in results[column["of"]]]
            found = [run for run in among if matches(run, {k: v for k, v in column.items() if k not in RESERVED})]
            template = column.get("cell", layout.get("cell", ""))
            texts = list(dict.fromkeys(cell(template, run, layout.get("names", {})) for run in found))
            if len(texts) > 1:
                raise SystemExit(f"{', '.join(results)}: {len(found)} runs for {column}: {texts}")
            cells += texts or [""]
        lines.append(cells)
    lines = [heads, ["---"] * len(heads), *lines, *layout.get("more", [])] if heads else []
    return ["|" + "".join(f" {text} |" if text != "---" else "---|" for text in line) for line in lines]


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


def sections(root: Path) -> list[tuple[str, str, str]]:
    """Title, address seen from the gallery, and text: of sections of the validation pages, then of the other pages."""
    summary = (root / "docs/SUMMARY.md").read_text(encoding="utf-8")
    pages = re.findall(r"\]\(([^)]+)\)", summary)
    found = []
    for page in sorted(pages, key=lambda page: not page.startswith("validation/")):
        text = INDEX.sub("", (root / "docs" / page).read_text(encoding="utf-8"))
        is_validation = page.startswith("validation/")
        address = page.removeprefix("validation/") if is_validation else f"../{page}"
        for part in re.split(r"^(?=## )", text, flags=re.MULTILINE) if is_validation else [text]:
            title = part.split("\n")[0].lstrip("# ")
            anchor = re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")
            found.append((title, f"{address}#{anchor}" if part.startswith("## ") else address, part))
    return found


def index(root: Path) -> list[str]:
    """The lines of the table of all cases and studies, with the sections that show them."""
    tables, parts = layouts(root), sections(root)
    order = {address: number for number, (_, address, _) in reversed(list(enumerate(parts)))}
    nowhere = ("", "")
    shown = {
        study: (title, address)
        for title, address, text in reversed(parts)
        for block in BLOCK.finditer(text)
        for study in layout_of(tables, block[2])["studies"]
    }

    def place(path: str) -> tuple[str, str]:
        if path.startswith("studies/") and Path(path).stem in shown:
            return shown[Path(path).stem]
        named = re.compile(rf"(?<!/){re.escape(path)}")
        return next(((title, address) for title, address, text in parts if named.search(text)), nowhere)

    def key(entry: tuple) -> tuple:
        return order.get(entry[0][1], len(parts)), entry[1]

    studies: dict[str, list] = {}
    for path in sorted(file.relative_to(root).as_posix() for file in (root / "studies").rglob("*.toml")):
        case = tomllib.loads((root / path).read_text(encoding="utf-8")).get("case")
        case = case and ((root / path).parent / case).resolve().relative_to(root.resolve()).as_posix()
        studies.setdefault(case or "", []).append((place(path), path))
    groups = [(*entry, [entry]) for entry in studies.get("", [])]
    for path in sorted(file.relative_to(root).as_posix() for file in (root / "cases").rglob("*.toml")):
        own = sorted(studies.get(path, []), key=key)
        groups.append((own[0][0] if own else place(path), path, own or [(place(path), "")]))
    lines, last = ["| section | case | study |", "|---|---|---|"], None
    for _, path, own in sorted(groups, key=key):
        for number, (at, study) in enumerate(own):
            link = f"[{at[0]}]({at[1]})" if at != nowhere else "others"
            link = "" if at == last else link
            case = f"`{path}`" if number == 0 and path != study else ""
            lines.append(f"| {link} | {case} | {f'`{study}`' if study else ''} |")
            last = at
    return lines


def write(root: Path, check: bool = False) -> list[Path]:
    """Writes the tables of all pages, or only looks; returns the pages that change."""
    changed, tables = [], layouts(root)
    for page in sorted((root / "docs").rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        renewed = BLOCK.sub(lambda block: written(root, block, tables), text)
        if INDEX.search(text):
            body = "\n".join(index(root))
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
    found = [f"{name}: on no page, or not stored" for name in sorted(shown ^ stored.keys())]
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
