"""Conversion of user input for the native part."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Mapping
from pathlib import PurePath
from typing import Any

import numpy as np

from ._optional import library
from .errors import CaseError, Mistake
from .typing import Case, Listener, Progress


def refused(key: str, message: str, help: str = "") -> CaseError:
    """An error in a parameter or a key of a dict."""
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
        raise refused(key, f"expected a finite number, found {value}")
    if value is None:
        raise refused(key, "expected a value, found None", "leave the key out")
    if isinstance(value, bool | int | float | str):
        return value
    raise refused(key, f"expected a number, a text, a list or a dict, found {type(value).__name__}")


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


def listed(names: str | Iterable[str] | None) -> list[str] | None:
    """Names as a list; one name may stand alone."""
    if names is None:
        return None
    return [names] if isinstance(names, str) else list(names)


def case_source(case: Case | None) -> tuple[str, Any]:
    """The kind of a case, and the case."""
    if case is None:
        return ("built-in", "")
    return ("dict", case) if isinstance(case, Mapping) else ("file", case)


def listener(progress: Progress | None) -> Listener | None:
    """A function of a fraction and a text, from such a function, a tqdm progress bar, or True."""
    if progress is None or progress is False:
        return None
    if progress is True:
        progress = library("tqdm.auto", "progress").tqdm(total=1.0, bar_format="{l_bar}{bar}| {postfix}")
    if callable(progress) and not hasattr(progress, "update"):
        return progress
    bar: Any = progress
    if not getattr(bar, "total", None):
        bar.total = 1.0

    def tell(share: float, text: str) -> None:
        bar.set_postfix_str(text, refresh=False)
        bar.update(share * bar.total - bar.n)

    return tell
