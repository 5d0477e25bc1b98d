"""Final results of a run as numbers with unit, error bar and method."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ._optional import library

if TYPE_CHECKING:
    from pandas import DataFrame


class Measure(float):
    """A final result with its error bar; a float in ``unit``, NaN if it could not be measured.

    Arithmetic and comparison are those of floats, and give plain ones: units and error bars are not carried on. ``str`` is the number alone, for files of
    numbers; ``repr`` has the unit and the error bar too, to four digits.
    """

    __slots__ = ("method", "rate", "uncertainty", "unit")

    unit: str
    """Unit; empty if dimensionless."""
    uncertainty: float | None
    """One standard uncertainty in ``unit``; None if not known."""
    method: str
    """How it was measured, in one sentence; or why it could not be."""
    rate: float | None
    """Its rate of change at the end in ``unit`` per s, if it still changes by more than its uncertainty."""

    def __new__(cls, value: float | None, unit: str = "", uncertainty: float | None = None, method: str = "", rate: float | None = None) -> Measure:
        """Takes the value, None if it could not be measured, and the attributes."""
        measure = super().__new__(cls, math.nan if value is None else value)
        measure.unit, measure.uncertainty, measure.method, measure.rate = unit, uncertainty, method, rate
        return measure

    def __reduce__(self) -> tuple[type[Measure], tuple[Any, ...]]:
        """What copies and other processes make it from."""
        return (type(self), (self.value, self.unit, self.uncertainty, self.method, self.rate))

    @property
    def value(self) -> float | None:
        """Value in ``unit`` as a plain float; None if it could not be measured, for the reason in ``method``."""
        return None if math.isnan(self) else float(self)

    __str__ = float.__repr__

    def __repr__(self) -> str:
        """Value, error bar and unit; or why there is no value."""
        return f"<Measure: {self.told()}{f' ({self.method})' if self.value is None else ''}>"

    def told(self) -> str:
        """Value, error bar and unit to four digits, and the rate of change of one that is not at rest, as in the summary of a run."""
        if self.value is None:
            return "not measured"
        bar = "" if self.uncertainty is None else f" ± {self.uncertainty:.4g}"
        motion = "" if self.rate is None else f", not at rest: {self.rate:.4g} {self.unit}/s"
        return f"{self:.4g}{bar} {self.unit}".rstrip() + motion


class Measures(dict[str, Measure]):
    """Measures by name."""

    def to_frame(self) -> DataFrame:
        """A table with the columns ``value``, ``unit``, ``uncertainty``, ``rate`` and ``method``, by name of the measure; requires pandas."""
        pandas = library("pandas", "pandas")
        rows = [(float(one), one.unit, one.uncertainty, one.rate, one.method) for one in self.values()]
        names = pandas.Index(list(self), name="measure", dtype="str")
        table: DataFrame = pandas.DataFrame(rows, names, ["value", "unit", "uncertainty", "rate", "method"])
        return table.astype({"uncertainty": float, "rate": float})

    def _repr_html_(self) -> str:
        """The table for notebooks."""
        from ._html import measures

        return measures(self)


def measures_of(readings: Mapping[str, Any]) -> Measures:
    """Measures from their entries in a report."""
    return Measures({name: _measure(reading) for name, reading in readings.items()})


def _measure(reading: Mapping[str, Any]) -> Measure:
    motion = reading.get("not-at-rest")
    rate = None if motion is None else motion["rate"]
    return Measure(reading["value"], reading["unit"], reading["uncertainty"], reading["method"], rate)
