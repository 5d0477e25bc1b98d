"""Results of a run: numbers, series, fields, tables and diagrams, as numpy arrays."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from .measures import Measures, measures_of
from .typing import FieldsKind, Status, Stroke

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from xarray import Dataset

Array = NDArray[Any]


def _arrays(data: Any) -> Any:
    """Arrays from the data of the native part."""
    if isinstance(data, tuple):
        kind, columns, values = data
        array = np.frombuffer(values, dtype=kind)
        return array if columns == 1 else array.reshape(-1, columns)
    if isinstance(data, dict):
        return {name: _arrays(inner) for name, inner in data.items()}
    return data


class Fields(Mapping[str, Array]):
    """Points of the plane, cells between them, and fields by name, each with one value, or one row of two components, per point or cell.

    Names and units are those of the VTK files, in which points and vectors have a third component of zero.
    """

    def __init__(self, data: Mapping[str, Any]) -> None:
        """Takes the data of the native part."""
        self._fields: dict[str, Array] = _arrays(data["fields"])
        self.units: dict[str, str] = dict(data["units"])
        """Unit of each field; empty if dimensionless."""
        self.kind: FieldsKind = data.get("kind", "lines" if "ends" in data else "grid" if "counts" in data else "points")
        """``points``, ``lines``, ``polygons`` or ``grid``."""
        self.counts: tuple[int, int] | None = None
        """Number of nodes along x and y of a grid; fields run along x first: ``field.reshape(counts[1], counts[0])``."""
        if "counts" in data:
            columns, rows = (int(count) for count in _arrays(data["counts"]))
            self.counts = (columns, rows)
            self._origin, self._spacing = _arrays(data["origin"]), _arrays(data["spacing"])
        else:
            self._points: Array = _arrays(data["points"])
        self._vertices, self._ends = _arrays(data.get("vertices")), _arrays(data.get("ends"))

    def __getitem__(self, name: str) -> Array:
        """The values of a field: shape (n,) or (n, 2)."""
        return self._fields[name]

    def __iter__(self) -> Iterator[str]:
        """The names of the fields."""
        return iter(self._fields)

    def __len__(self) -> int:
        """The number of fields."""
        return len(self._fields)

    def __repr__(self) -> str:
        """Number of points and names of the fields."""
        return f"<Fields: {len(self.points)} points, {', '.join(self._fields) or 'no fields'}>"

    @property
    def points(self) -> Array:
        """Positions in m, of shape (n, 2); for a grid, those of its nodes, along x first."""
        if self.counts is None:
            return self._points
        columns, rows = self.counts
        x = self._origin[0] + np.arange(columns) * self._spacing[0]
        y = self._origin[1] + np.arange(rows) * self._spacing[1]
        return np.stack(np.broadcast_arrays(x[None, :], y[:, None]), axis=-1).reshape(-1, 2)

    @cached_property
    def cells(self) -> list[Array]:
        """Each line or polygon as indices into `points`; a line that repeats its first index at its end is closed. Empty for points and grids."""
        return [] if self._ends is None else np.split(self._vertices, self._ends[:-1]) if len(self._ends) else []

    def to_pyvista(self) -> Any:
        """The fields as a pyvista data set; requires pyvista."""
        from ._pyvista import to_pyvista

        return to_pyvista(self)

    def to_xarray(self) -> Dataset:
        """Fields on a grid as an xarray data set, with the dimensions ``y``, ``x`` and, for vectors, ``component``; requires xarray.

        Raises:
            ValueError: the points are not those of a grid.

        """
        from ._xarray import of_grid

        return of_grid(self)


@dataclass(frozen=True)
class Frame:
    """The state at one time."""

    time: float
    """Time in s; for a quasi-static displacement, the displaced pore volumes."""
    particles: Fields | None
    """Particles of a direct simulation, or particles or nodes of a thin film."""
    grid: Fields | None
    """The same fields on a regular grid, for direct simulations."""
    interface: Fields | None
    """The interface; for a thin film its profile, x and height in m; for a network the menisci."""
    layers: dict[str, Fields] = field(default_factory=dict)
    """Parts of a network: ``regions`` and, at the end, ``pores`` and ``throats``."""

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> Frame:
        parts = {name: Fields(data[name]) if data[name] else None for name in ("particles", "grid", "interface")}
        return cls(data["time"], **parts, layers={name: Fields(one) for name, one in data["layers"].items()})


@dataclass(frozen=True)
class Trace:
    """A line or dots of a diagram."""

    name: str
    """Its name in the legend; empty for none."""
    stroke: Stroke
    """``full``, ``thin``, ``dashed``, ``dots``, or ``band``: the area within the points."""
    points: Array
    """x and y, of shape (n, 2)."""


@dataclass(frozen=True)
class Diagram:
    """A diagram of the run, such as the capillary pressure over the saturation."""

    title: str
    """Title."""
    labels: tuple[str, str]
    """Quantities along x and y, with units."""
    logarithmic: tuple[bool, bool]
    """Whether the axes are logarithmic."""
    traces: list[Trace]
    """The lines."""

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> Diagram:
        traces = [Trace(one["name"], one["stroke"], _arrays(one["points"])) for one in data["traces"]]
        x, y = (bool(flag) for flag in _arrays(data["logarithmic"]))
        return cls(data["title"], tuple(data["labels"]), (x, y), traces)


class Result:
    """The results of a run."""

    def __init__(self, data: Mapping[str, Any]) -> None:
        """Takes the data of the native part."""
        self._data = data
        end = data["end"]
        self.series: dict[str, Array] = _arrays(data["series"])
        """Columns of ``series.csv`` by name, each of shape (records,); NaN for missing values."""
        self.notes: list[str] = data["notes"]
        """Notes on how the case and its drawing were read."""
        self.folder: Path | None = None if data["folder"] is None else Path(data["folder"])
        """Folder of the files; None if nothing was written."""
        self.clock: tuple[str, str] = (end["clock"]["name"], end["clock"]["unit"])
        """The clock of the run and its unit: ``("time", "s")`` for most models."""
        self.documents: dict[str, str] = dict(end["documents"])
        """Text files by name, such as ``at-end.json``."""

    @cached_property
    def report(self) -> dict[str, Any]:
        """The content of ``report.json``."""
        return cast("dict[str, Any]", json.loads(self._data["report"]))

    @property
    def status(self) -> Status:
        """``done`` or ``expectation-failed``; ``failed`` for the result of a `SolverError`."""
        return cast("Status", self.report["status"])

    @cached_property
    def measures(self) -> Measures:
        """The final measures by name: a dict, with ``to_frame()``."""
        return measures_of(self.report["measures"])

    @property
    def warnings(self) -> list[str]:
        """Warnings that limit the validity of the measures."""
        return cast("list[str]", self.report["warnings"])

    @cached_property
    def frame(self) -> Frame:
        """The state at the end."""
        return Frame._of(self._data["end"]["frame"])

    @cached_property
    def frames(self) -> list[Frame]:
        """The state at each time of ``[output.vtk]`` with ``keep_frames=True``; otherwise only that at the end."""
        kept = [Frame._of(one) for one in self._data["frames"]]
        return kept or [self.frame]

    @property
    def particles(self) -> Fields | None:
        """Particles of a direct simulation, or particles or nodes of a thin film, at the end."""
        return self.frame.particles

    @property
    def grid(self) -> Fields | None:
        """Fields of a direct simulation on a regular grid, at the end."""
        return self.frame.grid

    @property
    def interface(self) -> Fields | None:
        """Interface of a direct simulation, profile of a thin film (x and height in m) or menisci of a network, at the end."""
        return self.frame.interface

    @cached_property
    def solid(self) -> Fields:
        """Outline of the solids."""
        return Fields(self._data["end"]["solid"])

    @cached_property
    def tables(self) -> dict[str, dict[str, Array]]:
        """Tables of a network by the name of their file, such as ``pores`` for ``pores.csv``.

        Each is a dict of columns: numbers, with NaN for missing ones; integers, with -1 where the file has an empty field; booleans; words.
        """
        found = _arrays(self._data["end"]["tables"])
        return {name: {head: np.asarray(column) for head, column in one.items()} for name, one in found.items()}

    @property
    def pores(self) -> dict[str, Array]:
        """Columns of ``pores.csv``, each of shape (pores,)."""
        return self.tables["pores"]

    @property
    def throats(self) -> dict[str, Array]:
        """Columns of ``throats.csv``, each of shape (throats,)."""
        return self.tables["throats"]

    @property
    def events(self) -> dict[str, Array]:
        """Columns of ``events.csv``, each of shape (events,): the capillary pressure curve, event by event."""
        return self.tables["events"]

    @cached_property
    def diagrams(self) -> dict[str, Diagram]:
        """Diagrams by name, such as ``capillary-pressure``."""
        return {name: Diagram._of(one) for name, one in self._data["end"]["diagrams"].items()}

    def __repr__(self) -> str:
        """Status and measures."""
        numbers = ", ".join(f"{name} = {one.told()}" for name, one in self.measures.items())
        return f"<Result: {self.status}; {numbers}>"

    def _repr_html_(self) -> str:
        """Pictures, measures and warnings for notebooks."""
        from ._html import result

        return result(self)

    def to_xarray(self) -> Dataset:
        """Fields of a direct simulation on a grid as an xarray data set with the dimensions ``time``, ``y``, ``x`` and, for vectors, ``component``.

        It has all times of `frames`. Requires xarray. Particles are not part of it: they are at other points at each time.

        Raises:
            ValueError: the result has no fields on a grid.

        """
        from ._xarray import of_frames

        return of_frames(self.frames, self.report["case"]["title"])

    def plot(self, kind: str | None = None, *, field: str | None = None, label: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the result with matplotlib, which it requires. Several curves on the same axes have different colors.

        Args:
            kind: ``picture``, or the name of one of `diagrams`, such as ``capillary-pressure``. If None, the capillary pressure curve of a network with a
                displacement, otherwise the picture.
            field: the field that colors particles or regions in a picture; their phase if None.
            label: name of the curve in the legend, before those of its parts if there are several; the title of a picture.
            ax: axes to draw on; new ones if None.

        Returns:
            The axes.

        """
        from ._plot import plot

        return plot(self, kind, field, label, ax)
