"""Types for annotations: the words that functions of this package take and give, as the program has them.

>>> from meniscus.typing import Side
>>> def drain(chip: str, inlet: Side = "left") -> float: ...
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any, Literal, Protocol, TypeAlias

Side = Literal["left", "right", "bottom", "top"]
"""A side of the domain: x = min, x = max, y = min, y = max."""
Process = Literal["drainage", "imbibition", "cycle"]
"""A displacement in a network."""
Films = Literal["none", "rings", "joined"]
"""How films in the corners of a chip are connected."""
Region = Literal["pack", "domain"]
"""The region of saturations, porosity and relative permeabilities."""
Results = Literal["all", "curve"]
"""What a displacement in a network yields besides events, curve and measures."""
Periodic = Literal["x", "y", "xy"]
"""Periodic directions."""
Unit = Literal["m", "cm", "mm", "um", "nm", "in", "mil", "ft", "pt", "px"]
"""Unit of a drawing."""
Inside = Literal["pore", "solid"]
"""What lies within a frame or within nested shapes of a drawing."""
Status = Literal["done", "expectation-failed", "failed"]
"""How a run ended."""
SampleStatus = Literal["done", "partial", "failed", "to do"]
"""How far a run of a study is."""
Stroke = Literal["full", "thin", "dashed", "dots", "band"]
"""How a trace of a diagram is drawn; ``band`` is the area within its points."""
FieldsKind = Literal["points", "lines", "polygons", "grid"]
"""Where fields have their values."""

Path: TypeAlias = str | os.PathLike[str]
"""A path of a file or folder."""
Case: TypeAlias = Mapping[str, Any] | Path
"""A case file, or its content."""
Drawing: TypeAlias = Mapping[str, Any] | Path
"""A drawing, or the content of a shape file."""
Listener: TypeAlias = Callable[[float, str], object]
"""A function of the completed fraction of a run, 0 to 1, and a text."""


class ProgressBar(Protocol):
    """A progress bar with the interface of tqdm."""

    def update(self, n: float, /) -> object:
        """Advances the bar."""

    def set_postfix_str(self, s: str, refresh: bool) -> object:
        """Sets the text behind the bar."""


Progress: TypeAlias = Listener | ProgressBar | bool
"""What is told about the progress: a function, a bar, or True for a new bar of tqdm."""
