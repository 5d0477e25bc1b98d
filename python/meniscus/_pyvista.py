"""Fields as pyvista data sets. The library is imported only here, and only on demand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._optional import library

if TYPE_CHECKING:
    from .results import Fields


def to_pyvista(fields: Fields) -> Any:
    """A pyvista data set with the points, cells and fields."""
    pyvista = library("pyvista", "pyvista")
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
