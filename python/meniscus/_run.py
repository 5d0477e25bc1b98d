"""Runs of cases, and networks of drawings."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from . import _meniscus
from ._given import case_source, given, listed, listener, refused
from .errors import SolverError, warn
from .results import Result
from .typing import Case, Drawing, Films, Inside, Path, Periodic, Process, Progress, Region, Results, Side, Unit

AXES: dict[Periodic, list[bool]] = {"x": [True, False], "y": [False, True], "xy": [True, True]}


def run(
    case: Case | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    out: Path | None = None,
    resume: bool = False,
    progress: Progress | None = None,
    threads: int | None = None,
    keep_frames: bool = False,
) -> Result:
    """Runs a case to its end, as ``meniscus run`` does, to the same bits.

    Other Python threads continue meanwhile, and may run cases as well. Ctrl-C stops the run after the present step; the packing of particles before the
    first step and the extraction of a network cannot be interrupted.

    Args:
        case: path of a case file; or its content as a dict, such as ``{"format": 1, "title": "drop", "geometry": {...}, "sph": {...}}``, in which file names
            are relative to the working folder; the built-in case if None.
        set: values that override those of the case, by key, such as ``{"sph.spacing": 2e-5, "expect": []}``.
        out: new or empty folder for the files that the command line writes. If None, nothing is written.
        resume: whether to resume the interrupted run in ``out``.
        progress: a function called with the completed fraction of the run, 0 to 1, and a text; or a tqdm progress bar; or True for a new one.
            An exception raised by the function stops the run.
        threads: number of threads; all cores if None. The result does not depend on it.
        keep_frames: whether ``Result.frames`` has the state at each time of ``[output.vtk]``, and not only at the end. Each frame of a direct simulation
            takes about 200 bytes per particle.

    Returns:
        The result. Its ``status`` is ``expectation-failed`` if a measure does not meet an expectation in ``[[expect]]``. Its ``warnings`` are issued as
        `MeniscusWarning`, too.

    Raises:
        CaseError: the case, a file that it names or a value of ``set`` is invalid.
        SolverError: the solver failed.
        FolderError: ``out`` is not empty, is in use, contains nothing to resume or cannot be written.
        KeyboardInterrupt: Ctrl-C; with ``out`` the state was saved, and ``resume=True`` resumes the run.

    """
    output = None if out is None else (os.fspath(out), resume)
    if resume and out is None:
        raise ValueError("resume requires out: the folder of an interrupted run to resume")
    return _result(given(case_source(case), set), output, progress, threads, keep_frames)


def network(
    drawing: Drawing,
    *,
    angle_deg: float | None = None,
    tension: float | None = None,
    inlet: Side | None = None,
    outlet: Side | None = None,
    process: Process | None = None,
    cycles: int | None = None,
    trapping: bool | None = None,
    films: Films | None = None,
    region: Region | None = None,
    results: Results | None = None,
    periodic: Periodic | None = None,
    depth: float | None = None,
    persistence: float | None = None,
    unit: Unit | None = None,
    scale: float | None = None,
    window: Sequence[float] | None = None,
    layers: str | Iterable[str] | None = None,
    join_within: float | None = None,
    threshold: float | None = None,
    pixel_size: float | None = None,
    invert: bool | None = None,
    recognize_circles: bool | None = None,
    smooth_below_deg: float | None = None,
    columns: Sequence[int] | None = None,
    separator: str | None = None,
    diameters: bool | None = None,
    frame: Inside | None = None,
    nested: Inside | None = None,
    out: Path | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
) -> Result:
    """Extracts the pore network of a drawing and displaces one fluid by another in it, as ``meniscus network`` does, to the same bits.

    Args:
        drawing: path of a drawing (SVG, DXF, shapefile, GeoJSON, WKT, list of discs, network of OpenPNM, image, shape file in TOML) or of a
            case file; or a shape file as a dict, such as
            ``{"format": 1, "min": [0, 0], "max": [1e-3, 1e-3], "solid": "inside", "shapes": [{"disc": {"center": [0, 0], "radius": 1e-4}}]}``.
        angle_deg: contact angle through the wetting phase in degrees (default 0).
        tension: interfacial tension in N/m; 1 if None, so that pressures are per N/m.
        inlet: side through which the invading phase enters: ``left``, ``right``, ``bottom`` or ``top``. If None, nothing is displaced.
        outlet: side through which the defending phase leaves.
        process: ``drainage`` (default), ``imbibition`` or ``cycle``.
        cycles: number of cycles of ``process="cycle"``.
        trapping: whether a defending region without a path to the outlet is trapped (default yes).
        films: how films in the corners of a chip are connected: ``none``, ``rings`` (default where corners hold any) or ``joined``.
        region: the region of saturations and relative permeabilities: ``pack`` (default where the drawing has a manifold) or ``domain``.
        results: ``all`` (default), or ``curve`` for events, curve and measures of the displacement alone, as for very many pores.
        periodic: periodic directions: ``x``, ``y`` or ``xy``.
        depth: distance between floor and lid in m; that of the file if None, and without one all results are per meter of depth.
        persistence: persistence ratio above which two maxima of the wall distance count as one pore, 0.5 to 1.
        unit: unit of the drawing: m, cm, mm, um, nm, in, mil, ft, pt or px.
        scale: length of the drawing unit in m, in place of ``unit``.
        window: corners of the domain in m: x0, y0, x1, y1.
        layers: name of the layer to read, or a list of names; all layers if None.
        join_within: largest gap across which ends of lines in a DXF drawing are joined, in units of the drawing.
        threshold: gray value of an image that separates solid and pore, 0 (black) to 1 (white).
        pixel_size: side of a pixel of an image in m.
        invert: whether the drawn shapes are the pore space.
        recognize_circles: whether polygons whose vertices lie on a circle become discs (default yes).
        smooth_below_deg: vertices with a turning angle below this many degrees become arcs (default 20); 0: none.
        columns: columns of x, y and radius in a list of discs, from 0.
        separator: the character between the columns of a list of discs.
        diameters: whether the third column of a list of discs holds diameters.
        frame: whether the inside of an unfilled outline around all others is ``pore`` or ``solid``, if the drawing does not determine it.
        nested: whether shapes of another color on larger ones, or outlines within others on layers of GDS, are ``pore`` or ``solid``.
        out: as in `run`.
        progress: as in `run`.
        threads: as in `run`.

    Returns:
        The result, with ``events``, and unless ``results="curve"`` with ``pores`` and ``throats``.

    Raises:
        CaseError: the drawing or a parameter is invalid.
        FolderError: as in `run`.
        KeyboardInterrupt: Ctrl-C.

    """
    of_import = {
        "unit": unit,
        "scale": scale,
        "window": None if window is None else _corners(window),
        "layers": listed(layers),
        "join_within": join_within,
        "threshold": threshold,
        "pixel_size": pixel_size,
        "invert": invert,
        "recognize_circles": recognize_circles,
        "smooth_below_deg": smooth_below_deg,
        "columns": columns,
        "separator": separator,
        "diameters": diameters,
        "frame": frame,
        "nested": nested,
    }
    if periodic is not None and periodic not in AXES:
        raise refused("periodic", f"expected one of {', '.join(AXES)}, found {periodic!r}")
    options = {
        "angle_deg": angle_deg,
        "tension": tension,
        "inlet": inlet,
        "outlet": outlet,
        "process": process,
        "cycles": cycles,
        "trapping": trapping,
        "films": films,
        "region": region,
        "results": results,
        "periodic": None if periodic is None else AXES[periodic],
        "depth": depth,
        "persistence": persistence,
    }
    kind = "shapes" if isinstance(drawing, Mapping) else "drawing"
    output = None if out is None else (os.fspath(out), False)
    return _result(given((kind, drawing), None, of_import, options), output, progress, threads, False)


def _corners(window: Iterable[float]) -> list[list[float]]:
    numbers = [] if isinstance(window, str) else list(window)
    if len(numbers) != 4:
        raise refused("window", f"expected four numbers in m, x0, y0, x1 and y1, found {window!r}")
    return [numbers[:2], numbers[2:]]


def _result(case: dict[str, str], output: tuple[str, bool] | None, progress: Progress | None, threads: int | None, keep_frames: bool) -> Result:
    result = Result(_meniscus.run(case, output, threads, listener(progress), keep_frames))
    if result.status == "failed":
        raise SolverError(result.report["error"] or "the solver failed", result)
    if result.report["status"] == "interrupted":
        raise KeyboardInterrupt
    # Those who called `run` or `network`.
    warn(result.warnings, 3)
    return result
