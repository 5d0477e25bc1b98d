"""What can be told of a case before it runs."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import _meniscus
from ._given import case_source, given, listener


@dataclass(frozen=True)
class Check:
    """What a run would take, from its first steps."""

    unknowns: int
    """Number of particles, nodes or pores."""
    steps: float
    """Expected number of steps, or the most events of a network."""
    time_step_s: float
    """Time step in s."""
    limit: str
    """The limit that rules the time step."""
    duration_s: float
    """Expected wall time in s with as many threads as the check had."""
    memory_bytes: int | None
    """Most memory of this process so far in bytes, other things in it included; None where the system does not tell."""
    warnings: list[str]
    """What to know before a run."""
    advice: dict[str, Any] | None
    """What network and direct simulation would take and which can answer, by the names of ``meniscus check --json``; None where that is no question."""


def check(
    case: Mapping[str, Any] | str | os.PathLike[str] | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    progress: Any = None,
    threads: int | None = None,
) -> Check:
    """Checks a case and tells what a run would take, as ``meniscus check`` does; the parameters are those of `run`.

    Raises:
        CaseError: the case is wrong.
        SolverError: one of the first steps failed.

    """
    told = json.loads(_meniscus.check(given(case_source(case), set), threads, listener(progress)))
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
