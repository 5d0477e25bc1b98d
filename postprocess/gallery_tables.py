"""Tables of the validation pages from the runs of studies; `gallery.py` explains their layout."""

import math
import operator
import re

FIELD = re.compile(r"\{([^{}:]+)(?::([^{}]*))?\}")
OPERATIONS = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}
# Keys of a column that are no parameters.
RESERVED = ("head", "cell", "of")


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
