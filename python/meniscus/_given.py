"""Conversion of user input for the native part."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Mapping
from pathlib import PurePath
from typing import Any

import numpy as np

from .errors import CaseError, Mistake

Progress = Callable[[float, str], object]


def _refused(key: str, message: str, help: str = "") -> CaseError:
    text = f"{key}: {message}" if key else message
    return CaseError(f"{text}\n  help: {help}" if help else text, [Mistake(message, help, key=key or None)])


def plain(value: Any, key: str = "") -> Any:
    """The value in the types of JSON: paths become strings, numpy arrays lists."""
    if isinstance(value, Mapping):
        return {str(name): plain(inner, f"{key}.{name}" if key else str(name)) for name, inner in value.items()}
    if isinstance(value, list | tuple):
        return [plain(inner, f"{key}[{place}]") for place, inner in enumerate(value)]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist(), key)
    if isinstance(value, PurePath):
        return str(value)
    if isinstance(value, float) and not math.isfinite(value):
        raise _refused(key, f"expected a finite number, found {value}")
    if value is None:
        raise _refused(key, "expected a value, found None", "leave the key out")
    if isinstance(value, bool | int | float | str):
        return value
    raise _refused(key, f"expected a number, a text, a list or a dict, found {type(value).__name__}")


def given(
    source: tuple[str, Any],
    set: Mapping[str, Any] | None = None,
    drawing: Mapping[str, Any] | None = None,
    options: Mapping[str, Any] | None = None,
) -> dict[str, str]:
    """A case or a drawing with its kind, overrides and parameters; those that are None are left out."""
    kind, value = source
    text = json.dumps(plain(value)) if isinstance(value, Mapping) else os.fspath(value)
    there = [{name: one for name, one in (of or {}).items() if one is not None} for of in (drawing, options)]
    return {
        "kind": kind,
        "value": text,
        "set": json.dumps(plain(set or {})),
        "import": json.dumps(plain(there[0])),
        "options": json.dumps(plain(there[1])),
    }


def case_source(case: Mapping[str, Any] | str | os.PathLike[str] | None) -> tuple[str, Any]:
    """The kind of a case, and the case."""
    if case is None:
        return ("built-in", "")
    return ("dict", case) if isinstance(case, Mapping) else ("file", case)


def listener(progress: Any) -> Progress | None:
    """A function of a fraction and a text, from such a function, a tqdm progress bar, or True."""
    if progress is None or progress is False:
        return None
    if progress is True:
        from tqdm.auto import tqdm

        progress = tqdm(total=1.0, bar_format="{l_bar}{bar}| {postfix}")
    if not hasattr(progress, "update"):
        return progress
    bar = progress
    if not getattr(bar, "total", None):
        bar.total = 1.0

    def tell(share: float, text: str) -> None:
        bar.set_postfix_str(text, refresh=False)
        bar.update(share * bar.total - bar.n)

    return tell
