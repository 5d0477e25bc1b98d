"""Libraries that only some functions need, imported on demand."""

from __future__ import annotations

import importlib
from typing import Any


def library(name: str, extra: str) -> Any:
    """The module ``name``, or an error with the command that installs it, which is that of an extra of this package."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        top = name.partition(".")[0]
        if error.name != top:
            raise
        raise ModuleNotFoundError(f"{top} is not installed: pip install {top}, or install meniscus[{extra}]", name=top) from error
