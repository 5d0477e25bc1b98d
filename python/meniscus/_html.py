"""Results in notebooks: pictures, measures with units and error bars, warnings."""

from __future__ import annotations

import io
from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._study import Study
    from .measures import Measure
    from .results import Result

LARGEST_TABLE = 50
"""Rows of a study that are shown."""
STUDY_CURVES = ("curve-1.svg", "capillary-pressure.svg")


def result(of: Result) -> str:
    """A result."""
    return _framed(of.report["case"]["title"], of.status, _pictures(of), measures(of.measures), of.warnings)


def study(of: Study) -> str:
    """A study: its first curve, its runs, its warnings."""
    curve = next((_inline(path.read_bytes(), "svg+xml") for path in map(of.folder.joinpath, STUDY_CURVES) if path.is_file()), "")
    done = sum(sample.status == "done" for sample in of)
    return _framed(of.title, f"{done} of {len(of)} runs done", curve, _runs(of), of.warnings)


def measures(of: Mapping[str, Measure]) -> str:
    """Measures by name; the method of each appears below the pointer."""
    return _table(["measure", "value"], ([_cell(name, one.method), _value(one)] for name, one in of.items()))


def _framed(title: str, status: str, pictures: str, table: str, warnings: Sequence[str]) -> str:
    told = "".join(f"<li>{escape(text)}</li>" for text in warnings)
    list_of_warnings = f"<p>Warnings</p><ul>{told}</ul>" if told else ""
    return f'<div><p><b>{escape(title)}</b>: {escape(status)}</p>{pictures}{list_of_warnings}<div style="overflow-x: auto">{table}</div></div>'


def _runs(of: Study) -> str:
    shown = of[:LARGEST_TABLE]
    parameters = dict.fromkeys(name for sample in shown for name in sample.parameters)
    found = dict.fromkeys(name for sample in shown for name in sample.measures)
    rows = (
        [
            _cell(sample.name),
            _cell(sample.status, sample.error),
            *(_cell(str(sample.parameters.get(name, ""))) for name in parameters),
            *(_value(sample.measures.get(name)) for name in found),
        ]
        for sample in shown
    )
    more = f"<p>{len(of) - len(shown)} more runs: <code>to_frame()</code> has all.</p>" if len(of) > len(shown) else ""
    return _table(["run", "status", *parameters, *found], rows) + more


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head = "".join(f"<th>{escape(name)}</th>" for name in heads)
    body = "".join(f"<tr>{''.join(cells)}</tr>" for cells in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _cell(text: str, title: str = "") -> str:
    return f'<td style="text-align: left"{f" title={chr(34)}{escape(title)}{chr(34)}" if title else ""}>{escape(text)}</td>'


def _value(measure: Measure | None) -> str:
    return "<td></td>" if measure is None else _cell(measure.told(), measure.method)


def _pictures(of: Result) -> str:
    """Those of the folder, which the program has drawn; without one those of matplotlib, if it is installed."""
    from ._plot import curve_of

    curve = curve_of(of)
    if of.folder is not None and (drawn := of.folder / "picture.png").is_file():
        diagram = of.folder / f"diagram-{curve}.svg"
        return _inline(drawn.read_bytes(), "png") + (_inline(diagram.read_bytes(), "svg+xml") if diagram.is_file() else "")
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError:
        return ""
    kinds = ["picture"] if curve is None else ["picture", curve]
    figure = Figure(figsize=(5.0 * len(kinds), 3.8), layout="constrained")
    for ax, kind in zip(figure.subplots(1, len(kinds), squeeze=False)[0], kinds, strict=True):
        of.plot(kind, ax=ax)
    png = io.BytesIO()
    figure.savefig(png, format="png")
    return _inline(png.getvalue(), "png")


def _inline(image: bytes, kind: str) -> str:
    return f'<img style="max-width: 50em; max-height: 25em" src="data:image/{kind};base64,{b64encode(image).decode()}">'
