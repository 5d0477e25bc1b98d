"""The table of all cases and studies with the sections of the book that show them, for `gallery.py`."""

import re
import tomllib
from collections.abc import Callable
from pathlib import Path

INDEX = re.compile(r"^(<!-- generated: cases and studies -->\n).*?^<!-- end of generated -->", re.DOTALL | re.MULTILINE)


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


def index(root: Path, shown_in: Callable[[str], list[str]]) -> list[str]:
    """The lines of the table of all cases and studies, with their sections; `shown_in` gives the studies of a text."""
    parts = sections(root)
    order = {address: number for number, (_, address, _) in reversed(list(enumerate(parts)))}
    nowhere = ("", "")
    shown = {study: (title, address) for title, address, text in reversed(parts) for study in shown_in(text)}

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
