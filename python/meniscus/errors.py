"""Exceptions and warnings of this package."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .results import Result


class MeniscusError(Exception):
    """The common base of all errors of this package."""


@dataclass(frozen=True)
class Mistake:
    """One mistake in a case, a drawing or a parameter."""

    message: str
    """What was expected and what was found."""
    help: str = ""
    """A remedy; empty if the message suffices."""
    file: str | None = None
    """The file; None for a dict or a parameter."""
    line: int | None = None
    """Line in the file, from 1."""
    column: int | None = None
    """Column in the file, from 1."""
    key: str | None = None
    """Key path in a dict, or the parameter, such as ``sph.spacing``; None for a file."""


class CaseError(MeniscusError, ValueError):
    """A case, a drawing, a study or a parameter is invalid; ``str`` gives all mistakes with their locations and remedies.

    ``mistakes`` has all of them; ``file``, ``line``, ``column``, ``key``, ``message`` and ``help`` are those of the first.
    """

    def __init__(self, text: str, mistakes: Sequence[Mapping[str, Any] | Mistake] = ()) -> None:
        """Takes the whole text and the mistakes."""
        # All arguments stand in `args`, so that the error passes from process to process.
        super().__init__(text, list(mistakes))
        self.mistakes: tuple[Mistake, ...] = tuple(one if isinstance(one, Mistake) else Mistake(**one) for one in mistakes) or (Mistake(text),)
        first = self.mistakes[0]
        self.file, self.line, self.column = first.file, first.line, first.column
        self.key, self.message, self.help = first.key, first.message, first.help

    def __str__(self) -> str:
        """All mistakes, each with its location and, below it, the remedy."""
        return str(self.args[0])


class SolverError(MeniscusError, RuntimeError):
    """The solver failed. ``result`` contains the results so far, ending with the last valid state; None if there are none."""

    def __init__(self, text: str, result: Result | None = None) -> None:
        """Takes the text and the result so far."""
        super().__init__(text, result)
        self.result = result

    def __str__(self) -> str:
        """Why, when and where."""
        return str(self.args[0])


class FolderError(MeniscusError, OSError):
    """The folder for output is not empty, is in use, contains nothing to resume or cannot be written."""


class MeniscusWarning(UserWarning):
    """Something limits the validity of measures; the text is one of ``warnings`` of a result."""


def warn(texts: Iterable[str], levels: int) -> None:
    """Issues warnings at the place so many calls above that of this function, 1 being the caller itself."""
    for text in texts:
        warnings.warn(text, MeniscusWarning, stacklevel=levels + 1)
