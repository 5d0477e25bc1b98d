"""Fields on grids as xarray data sets. The library is imported only here, and only on demand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._optional import library

if TYPE_CHECKING:
    from collections.abc import Sequence

    from xarray import Dataset

    from .results import Fields, Frame


def of_grid(fields: Fields) -> Dataset:
    """A data set with the dimensions ``y`` and ``x``, and ``component`` for vectors."""
    if fields.counts is None:
        raise ValueError(f"expected fields on a grid, found {fields.kind}: particles and networks have no regular axes; to_pyvista() takes them")
    xarray = library("xarray", "xarray")
    columns, rows = fields.counts
    nodes = fields.points.reshape(rows, columns, 2)
    axes = {name: (name, values, {"units": "m"}) for name, values in (("x", nodes[0, :, 0]), ("y", nodes[:, 0, 1]))}
    has_vectors = any(values.ndim == 2 for values in fields.values())
    components = {"component": ["x", "y"]} if has_vectors else {}
    variables = {
        name: (("y", "x", "component")[: values.ndim + 1], values.reshape(rows, columns, *values.shape[1:]), {"units": fields.units[name] or "1"})
        for name, values in fields.items()
    }
    found: Dataset = xarray.Dataset(variables, coords={**axes, **components})
    return found


def of_frames(frames: Sequence[Frame], title: str) -> Dataset:
    """A data set of the grids of all frames, with the dimension ``time`` before the others."""
    grids = [(frame.time, frame.grid) for frame in frames if frame.grid is not None]
    if not grids:
        raise ValueError("there are no fields on a grid: only direct simulations have them; particles, films and networks have to_pyvista()")
    xarray = library("xarray", "xarray")
    found: Dataset = xarray.concat([of_grid(grid).expand_dims(time=[time]) for time, grid in grids], dim="time")
    found["time"].attrs["units"] = "s"
    return found.assign_attrs(title=title)
