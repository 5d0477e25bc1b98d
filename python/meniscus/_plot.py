"""Pictures of results with matplotlib, and pyvista data sets. Both libraries are imported only here, and only on demand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .results import Fields, Result

CURVES = ("capillary-pressure", "pressure-difference")
# Wetting, non-wetting, solid.
PHASES = ("#56b4e9", "#e69f00", "#8a8a8a")
STROKES: dict[str, dict[str, Any]] = {
    "full": {},
    "thin": {"color": "0.7", "linewidth": 0.6},
    "dashed": {"color": "black", "linestyle": "--"},
    "dots": {"linestyle": "", "marker": "."},
}


def plot(result: Result, kind: str | None, field: str | None, ax: Axes | None) -> Axes:
    """Draws a picture or a diagram."""
    import matplotlib.pyplot as plt

    ax = plt.subplots()[1] if ax is None else ax
    if kind is None:
        kind = next((name for name in CURVES if name in result.diagrams and field is None), "picture")
    if kind == "picture":
        return _picture(result, field, ax)
    if kind not in result.diagrams:
        there = ", ".join(["picture", *result.diagrams])
        raise ValueError(f"there is no {kind!r} of this result; there is {there}")
    diagram = result.diagrams[kind]
    for trace in diagram.traces:
        if trace.stroke == "band":
            ax.fill(*trace.points.T, label=trace.name or None, alpha=0.3)
            continue
        style = STROKES[trace.stroke]
        ax.plot(*trace.points.T, label=trace.name or None, **style)
    ax.set(title=diagram.title, xlabel=diagram.labels[0], ylabel=diagram.labels[1])
    for is_logarithmic, scale in zip(diagram.logarithmic, (ax.set_xscale, ax.set_yscale), strict=True):
        if is_logarithmic:
            scale("log")
    if any(trace.name for trace in diagram.traces):
        ax.legend()
    return ax


def _picture(result: Result, field: str | None, ax: Axes) -> Axes:
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
    aspect = "auto" if is_film else "equal"
    ax.set(xlabel="x (m)", ylabel="y (m)", title=result.report["case"]["title"], aspect=aspect)
    ax.autoscale_view()
    return ax


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


def to_pyvista(fields: Fields) -> Any:
    """A pyvista data set with the points, cells and fields."""
    import pyvista

    points = _in_space(fields.points)
    if fields.counts is not None:
        columns, rows = fields.counts
        data = pyvista.StructuredGrid(*(axis.reshape(rows, columns, 1) for axis in points.T))
        # The nodes of a structured grid run along the first axis of these arrays first.
        order = np.arange(rows * columns).reshape(rows, columns).T.ravel()
        return _with_fields(data.point_data, data, fields, order)
    if fields.kind == "points":
        data = pyvista.PolyData(points)
        return _with_fields(data.point_data, data, fields, None)
    cells = np.concatenate([[len(cell), *cell] for cell in fields.cells]) if fields.cells else np.zeros(0, int)
    data = pyvista.PolyData(points, **{"faces" if fields.kind == "polygons" else "lines": cells})
    on_points = all(len(fields[name]) == len(points) for name in fields)
    return _with_fields(data.point_data if on_points else data.cell_data, data, fields, None)


def _with_fields(target: Any, data: Any, fields: Fields, order: Any) -> Any:
    for name in fields:
        values = fields[name] if fields[name].ndim == 1 else _in_space(fields[name])
        target[name] = values if order is None else values[order]
    return data


def _in_space(vectors: Any) -> Any:
    return np.column_stack([vectors, np.zeros(len(vectors))])
