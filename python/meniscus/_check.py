"""Checks of a case before a run."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import _meniscus
from ._given import case_source, given, listener
from .errors import warn
from .typing import Case, Progress


@dataclass(frozen=True)
class Check:
    """The expected cost of a run, estimated from its first steps."""

    unknowns: int
    """Number of particles, nodes or pores."""
    steps: float
    """Expected number of steps, or the largest number of events of a network."""
    time_step_s: float
    """Time step in s."""
    limit: str
    """The limit that determines the time step."""
    duration_s: float
    """Expected wall time in s with the number of threads of the check."""
    memory_bytes: int | None
    """Peak memory of this process so far in bytes, including everything else in it; None if the system does not report it."""
    warnings: list[str]
    """Warnings before a run, issued as `MeniscusWarning` too."""
    advice: dict[str, Any] | None
    """Cost of network and direct simulation, and which is applicable, as in ``meniscus check --json``; None if only one model is possible."""


def check(
    case: Case | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
) -> Check:
    """Checks a case and estimates the cost of a run, as ``meniscus check`` does; the parameters are those of `run`.

    Raises:
        CaseError: the case is invalid.
        SolverError: one of the first steps failed.

    """
    told: dict[str, Any] = json.loads(_meniscus.check(given(case_source(case), set), threads, listener(progress)))
    warn(told["warnings"], 2)
    return Check(
        unknowns=told["unknowns"],
        steps=told["steps"],
        time_step_s=told["time-step-s"],
        limit=told["limit"],
        duration_s=told["duration-s"],
        memory_bytes=told["memory-bytes"],
        warnings=told["warnings"],
        advice=told.get("advice"),
    )
