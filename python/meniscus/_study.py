"""Parameter studies, with runs on any executor."""

from __future__ import annotations

import json
import os
import uuid
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, Future, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from . import _meniscus
from ._given import listener
from ._optional import library
from .errors import warn
from .measures import Measures, measures_of
from .typing import Path as AnyPath
from .typing import Progress, SampleStatus

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True)
class Sample:
    """One run of a study."""

    index: int
    """Number, from 1."""
    name: str
    """Name, equal to that of its folder."""
    folder: Path
    """Folder of its files."""
    status: SampleStatus
    """``done``, ``partial``, ``failed`` or ``to do``."""
    error: str
    """Why it failed; empty otherwise."""
    parameters: dict[str, Any]
    """Values of the parameters, by name."""
    measures: Measures
    """Measures by name, if the run is done."""
    warnings: list[str] = field(default_factory=list)
    """Warnings that limit the validity of the measures."""


class Study(Sequence[Sample]):
    """A study with its runs, in the order of their numbers."""

    def __init__(self, title: str, folder: Path, samples: list[Sample]) -> None:
        """Takes title, folder and runs."""
        self.title, self.folder, self._samples = title, folder, samples

    @overload
    def __getitem__(self, place: int) -> Sample: ...
    @overload
    def __getitem__(self, place: slice) -> list[Sample]: ...
    def __getitem__(self, place: int | slice) -> Sample | list[Sample]:
        """A run, or several by a slice."""
        return self._samples[place]

    def __len__(self) -> int:
        """The number of runs."""
        return len(self._samples)

    def __iter__(self) -> Iterator[Sample]:
        """The runs."""
        return iter(self._samples)

    def __repr__(self) -> str:
        """Title and progress."""
        done = sum(sample.status == "done" for sample in self)
        return f"<Study: {self.title}; {done} of {len(self)} runs done>"

    def _repr_html_(self) -> str:
        """First curve, runs and warnings for notebooks."""
        from ._html import study

        return study(self)

    @property
    def warnings(self) -> list[str]:
        """Why runs have failed, and warnings that limit the validity of measures, each behind the name of its run."""
        failed = [f"{sample.name}: failed: {sample.error}" for sample in self if sample.error]
        return failed + [f"{sample.name}: {text}" for sample in self for text in sample.warnings]

    def column(self, name: str) -> NDArray[Any]:
        """A parameter or a measure of all runs, of shape (runs,); NaN if a run does not have the measure."""
        if all(name in sample.parameters for sample in self):
            return np.array([sample.parameters[name] for sample in self])
        if not any(name in sample.measures for sample in self):
            raise KeyError(name)
        return np.array([sample.measures.get(name, np.nan) for sample in self])

    def table(self) -> dict[str, NDArray[Any]]:
        """All parameters and measures by name, for ``pandas.DataFrame``."""
        names = dict.fromkeys(name for sample in self for name in (*sample.parameters, *sample.measures))
        return {"run": np.array([sample.name for sample in self]), **{name: self.column(name) for name in names}}

    def to_frame(self) -> DataFrame:
        """Parameters, status and measures by the name of the run, with the columns of ``table.csv``; requires pandas.

        Where a measure has an error bar, a column ``NAME-uncertainty`` follows it. ``attrs["units"]`` has the units of the measures.
        """
        columns = self.table()
        parameters = {name: columns.pop(name) for name in list(columns) if name == "run" or all(name in sample.parameters for sample in self)}
        found = parameters | {"status": np.array([sample.status for sample in self])}
        for name, column in columns.items():
            found[name] = column
            bars = [sample.measures[name].uncertainty if name in sample.measures else None for sample in self]
            if any(bar is not None for bar in bars):
                found[f"{name}-uncertainty"] = np.array(bars, dtype=float)
        frame: DataFrame = library("pandas", "pandas").DataFrame(found).set_index("run")
        frame.attrs["units"] = {name: one.unit for sample in self for name, one in sample.measures.items()}
        return frame


def do_run(path: str, out: str, index: int, digest: str, threads: int | None, token: str) -> tuple[str, str]:
    """Does one run of a study and writes its files to the folder of the study. All arguments are plain, so that any process can do it."""
    return _meniscus.study_run(path, out, (index, digest), threads, token)


def study(
    path: AnyPath,
    executor: Executor | None = None,
    *,
    out: AnyPath | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Study:
    """Does all runs of a study that are not complete, and writes its report, as ``meniscus study run`` does.

    Each run is one call of a function of this package with plain arguments, and writes its files to the folder of the study, which contains ``report.html``
    and ``table.csv`` at the end: processes on other machines must see the study file and this folder under the same paths. After an interruption, the same
    call resumes the study; complete runs are not repeated.

    Args:
        path: the study file.
        executor: executor of the runs, with the interface of ``concurrent.futures``, such as ``ProcessPoolExecutor``, ``MPIPoolExecutor`` of
            mpi4py, or ``client.get_executor()`` of Dask. If None, they are done in this process, one after the other.
        out: folder of the study, new or of this study; ``out/study-NAME`` if None.
        threads: threads of each run; if None, 1 with an executor, all cores without.
        progress: as in `run`; called whenever a run has ended.

    Returns:
        The runs with their parameters and measures. A failed run does not prevent the others: see its ``status`` and ``error``. If there are any
        `Study.warnings`, a `MeniscusWarning` gives the first of them and their number.

    Raises:
        CaseError: the study or the case of a run is invalid; nothing was run.
        FolderError: the folder cannot be used.
        KeyboardInterrupt: Ctrl-C; the runs in progress in this process have saved their states.

    """
    file = str(Path(path).absolute())
    plan = json.loads(_meniscus.study_plan(file, None if out is None else os.fspath(out)))
    folder, tell = str(Path(plan["folder"]).absolute()), listener(progress)
    threads = 1 if threads is None and executor is not None else threads
    token = uuid.uuid4().hex
    calls = [(file, folder, run["index"], run["digest"], threads, token) for run in plan["runs"]]
    endings: dict[int, tuple[str, str]] = {}
    for number, (index, ending) in enumerate(_endings(executor, calls, token), 1):
        endings[index] = ending
        if tell is not None:
            tell(number / len(calls), f"run {index} of {len(calls)}: {ending[0]}")
    if any(status == "interrupted" for status, _ in endings.values()):
        raise KeyboardInterrupt
    samples = [_sample(row, endings) for row in json.loads(_meniscus.study_report(file, folder))]
    found = Study(plan["title"], Path(folder), samples)
    warn(_in_short(found.warnings), 2)
    return found


def _in_short(warnings: list[str]) -> list[str]:
    """One warning for all: a study may have a thousand."""
    more = f" (and {len(warnings) - 1} more: see `warnings` of the study)" if len(warnings) > 1 else ""
    return [warnings[0] + more] if warnings else []


def _endings(executor: Executor | None, calls: list[Any], token: str) -> Iterator[tuple[int, tuple[str, str]]]:
    """The number of each run and how it ended, in the order in which they end."""
    if executor is None:
        yield from ((call[2], do_run(*call)) for call in calls)
        return
    futures: dict[Future[tuple[str, str]], int] = {executor.submit(do_run, *call): call[2] for call in calls}
    try:
        for future in as_completed(futures):
            yield futures[future], future.result()
    except BaseException:
        for future in futures:
            future.cancel()
        _meniscus.stop(token)
        raise


def _sample(row: dict[str, Any], endings: dict[int, tuple[str, str]]) -> Sample:
    status, error = endings.get(row["index"], ("", ""))
    failed = status == "failed"
    report = Path(row["folder"]) / "report.json"
    return Sample(
        index=row["index"],
        name=row["name"],
        folder=Path(row["folder"]),
        status="failed" if failed else row["status"],
        error=error,
        parameters=row["parameters"],
        measures=measures_of(row["measures"] or {}),
        warnings=json.loads(report.read_text(encoding="utf-8")).get("warnings", []) if report.is_file() else [],
    )
