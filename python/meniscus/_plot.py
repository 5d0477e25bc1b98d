"""Pictures and curves of results with matplotlib, which is imported on demand only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._optional import library

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

    from .results import Diagram, Fields, Result

CURVES = ("capillary-pressure", "pressure-difference")
# Wetting, non-wetting, solid.
PHASES = ("#56b4e9", "#e69f00", "#8a8a8a")
GRAY = "0.7"
STROKES: dict[str, dict[str, Any]] = {
    "full": {},
    "thin": {"color": GRAY, "linewidth": 0.6},
    "dashed": {"linestyle": "--"},
    "dots": {"linestyle": "", "marker": "."},
}
# For full lines beyond the number of colors, so that all are distinct.
FURTHER_STYLES = ("-", "-.", ":")
# Units of lengths in m, the largest first.
LENGTHS = ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))
# Room of a tick label in inches, along x and along y.
TICK_ROOM = (0.6, 0.35)
# Ticks at most.
MOST_TICKS = 6
# Names of a legend beyond which its letters are small.
FEW_NAMES = 5
# Powers of ten between which the numbers of a curve are written in full.
PLAIN_POWERS = (-2, 4)


def plot(result: Result, kind: str | None, field: str | None, label: str | None, ax: Axes | None) -> Axes:
    """Draws a picture or a diagram."""
    if kind is None:
        kind = (curve_of(result) if field is None else None) or "picture"
    if kind != "picture" and kind not in result.diagrams:
        there = ", ".join(["picture", *result.diagrams])
        raise ValueError(f"there is no {kind!r} of this result; there is {there}")
    on: Axes = library("matplotlib.pyplot", "plot").subplots()[1] if ax is None else ax
    return _picture(result, field, label, on) if kind == "picture" else _diagram(result.diagrams[kind], label, on)


def curve_of(result: Result) -> str | None:
    """The name of the diagram that is drawn unless another one is asked for, if there is one."""
    return next((name for name in CURVES if name in result.diagrams), None)


def _diagram(diagram: Diagram, label: str | None, ax: Axes) -> Axes:
    from matplotlib.ticker import ScalarFormatter

    is_one = sum(bool(trace.name) for trace in diagram.traces) == 1
    for trace in diagram.traces:
        name = trace.name if label is None or not trace.name else label if is_one else f"{label}, {trace.name}"
        name = _distinct(name, ax)
        if trace.stroke == "band":
            ax.fill(*trace.points.T, label=name or None, alpha=0.3)
            continue
        ax.plot(*trace.points.T, label=name or None, **{"linestyle": _linestyle(ax), **STROKES[trace.stroke]})
    ax.set(title=diagram.title, xlabel=diagram.labels[0], ylabel=diagram.labels[1])
    for is_logarithmic, scale, axis, quantity in zip(diagram.logarithmic, (ax.set_xscale, ax.set_yscale), (ax.xaxis, ax.yaxis), diagram.labels, strict=True):
        if is_logarithmic:
            scale("log")
        elif quantity.endswith(" in m"):
            _in_its_unit(axis, np.ptp(axis.get_view_interval()), quantity.removesuffix("m") + "{}")
        elif isinstance(formatter := axis.get_major_formatter(), ScalarFormatter):
            formatter.set_powerlimits(PLAIN_POWERS)
            formatter.set_useMathText(True)
    if any(trace.name for trace in diagram.traces):
        ax.legend(fontsize="small" if len(ax.get_legend_handles_labels()[1]) > FEW_NAMES else None)
    return ax


def _distinct(name: str, ax: Axes) -> str:
    """The name, with a number if the legend has it already."""
    there = ax.get_legend_handles_labels()[1]
    number = next(number for number in range(1, len(there) + 2) if _numbered(name, number) not in there)
    return _numbered(name, number)


def _numbered(name: str, number: int) -> str:
    return name if number == 1 or not name else f"{name} ({number})"


def _linestyle(ax: Axes) -> str:
    """The style of the next line: colors begin again when each was taken once."""
    from matplotlib import rcParams

    colored = sum(line.get_color() != GRAY for line in ax.lines)
    return FURTHER_STYLES[colored // len(rcParams["axes.prop_cycle"]) % len(FURTHER_STYLES)]


def _picture(result: Result, field: str | None, label: str | None, ax: Axes) -> Axes:
    frame = result.frame
    if "regions" in frame.layers:
        _regions(frame.layers["regions"], field, ax)
    elif frame.particles is not None:
        _particles(frame.particles, field, ax)
    for part, color, width in ((result.solid, "black", 0.8), (frame.interface, "crimson", 1.2)):
        if part is not None:
            _lines(part, color, width, ax)
    # A film is flat: its heights are magnified.
    is_film = frame.particles is not None and "film-height" in frame.particles
    ax.set(title=label or result.report["case"]["title"], aspect="auto" if is_film else "equal")
    ax.autoscale_view()
    extents = [np.ptp(axis.get_view_interval()) for axis in (ax.xaxis, ax.yaxis)]
    _in_its_unit(ax.xaxis, extents[0] if is_film else max(extents), "x ({})")
    _in_its_unit(ax.yaxis, extents[1] if is_film else max(extents), "y ({})")
    return ax


def _in_its_unit(axis: Axis, extent: float, label: str) -> None:
    """Ticks and label in the unit that suits an extent in m; the axis itself stays in m, so that more can be drawn on it."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    size, unit = next((one for one in LENGTHS if extent >= one[0]), LENGTHS[-1])
    box, is_vertical = axis.axes.bbox, axis is axis.axes.yaxis
    inches = (box.height if is_vertical else box.width) / axis.axes.figure.dpi
    axis.set_major_locator(MaxNLocator(int(np.clip(inches / TICK_ROOM[is_vertical], 2, MOST_TICKS)), steps=[1, 2, 5, 10]))
    axis.set_major_formatter(FuncFormatter(lambda length, _: f"{length / size:.6g}".replace("-", "\N{MINUS SIGN}")))
    axis.set_label_text(label.format(unit))


def _lines(lines: Fields, color: str, width: float, ax: Axes) -> None:
    from matplotlib.collections import LineCollection

    segments = [lines.points[cell] for cell in lines.cells]
    ax.add_collection(LineCollection(segments, colors=color, linewidths=width), autolim=True)


def _regions(regions: Fields, field: str | None, ax: Axes) -> None:
    from matplotlib.collections import PolyCollection

    polygons = PolyCollection([regions.points[cell] for cell in regions.cells], edgecolors="white", linewidths=0.2)
    _color(polygons, regions, field, ax)
    ax.add_collection(polygons, autolim=True)


def _particles(particles: Fields, field: str | None, ax: Axes) -> None:
    x, y = particles.points.T
    # Dots that about fill axes of the usual size, in square points.
    _color(ax.scatter(x, y, s=min(20.0, 3e4 / max(len(x), 1)), linewidths=0), particles, field, ax)


def _color(artist: Any, fields: Fields, field: str | None, ax: Axes) -> None:
    """Colors by a field, with a color bar, vectors by their magnitude; by the phase without a field."""
    if field is None:
        phases = fields.get("phase")
        artist.set_facecolor(["0.85"] if phases is None else [PHASES[phase] for phase in phases])
        return
    if field not in fields:
        raise ValueError(f"there is no field {field!r}; there is {', '.join(fields)}")
    values = fields[field]
    artist.set_array(values if values.ndim == 1 else np.linalg.norm(values, axis=1))
    unit = fields.units.get(field)
    ax.figure.colorbar(artist, ax=ax, label=f"{field} ({unit})" if unit else field)
