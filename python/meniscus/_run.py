"""Runs of cases, and networks of drawings."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from . import _meniscus
from ._given import case_source, given, listener
from .errors import SolverError
from .results import Result

Path = str | os.PathLike[str]


def run(
    case: Mapping[str, Any] | Path | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    out: Path | None = None,
    resume: bool = False,
    progress: Any = None,
    threads: int | None = None,
    keep_frames: bool = False,
) -> Result:
    """Runs a case to its end, as ``meniscus run`` does, to the same bits.

    Other Python threads go on meanwhile, and may run cases too. Ctrl-C stops the run after the present step; the packing of particles before the first
    step, and the extraction of a network, are not interrupted.

    Args:
        case: path of a case file; or the same as a dict, such as ``{"format": 1, "title": "drop", "geometry": {...}, "sph": {...}}``, whose files are
            looked for in the working folder; the built-in case where there is none.
        set: values of keys in place of those of the case, by key, such as ``{"sph.spacing": 2e-5, "expect": []}``.
        out: folder for the files that the command line writes, new or empty. Nothing is written where there is none.
        resume: whether to continue the run in ``out``.
        progress: a function that is called with the share of the run that is done, 0 to 1, and a text; or a bar of tqdm; or True for a new bar.
            What the function raises stops the run.
        threads: number of threads; all cores where there is none. The result does not depend on it.
        keep_frames: whether ``Result.frames`` has the state at each time of ``[output.vtk]``, and not only at the end. Each frame of a direct simulation
            takes about 200 bytes per particle.

    Returns:
        The result. Its ``status`` is ``expectation-failed`` where a measure is not what ``[[expect]]`` says.

    Raises:
        CaseError: the case, a file that it names or a value of ``set`` is wrong.
        SolverError: the solver failed.
        FolderError: ``out`` is not empty, is in use, holds nothing to resume or cannot be written.
        KeyboardInterrupt: Ctrl-C; with ``out`` the state was saved, and ``resume=True`` goes on.

    """
    output = None if out is None else (os.fspath(out), resume)
    if resume and out is None:
        raise ValueError("resume needs out: the folder of the run to go on with")
    return _result(given(case_source(case), set), output, progress, threads, keep_frames)


def network(
    drawing: Mapping[str, Any] | Path,
    *,
    angle_deg: float | None = None,
    tension: float | None = None,
    inlet: str | None = None,
    outlet: str | None = None,
    process: str | None = None,
    cycles: int | None = None,
    trapping: bool | None = None,
    periodic: str | None = None,
    depth: float | None = None,
    persistence: float | None = None,
    unit: str | None = None,
    scale: float | None = None,
    window: Sequence[float] | None = None,
    layers: Sequence[str] | None = None,
    join_within: float | None = None,
    threshold: float | None = None,
    pixel_size: float | None = None,
    invert: bool | None = None,
    recognize_circles: bool | None = None,
    smooth_below_deg: float | None = None,
    columns: Sequence[int] | None = None,
    separator: str | None = None,
    diameters: bool | None = None,
    frame: str | None = None,
    nested: str | None = None,
    out: Path | None = None,
    progress: Any = None,
    threads: int | None = None,
) -> Result:
    """Extracts the pore network of a drawing and displaces one fluid by another in it, as ``meniscus network`` does, to the same bits.

    Args:
        drawing: path of a drawing (SVG, DXF, shapefile, GeoJSON, WKT, list of discs, image, shape file in TOML) or of a case file; or a shape file as a
            dict, such as ``{"format": 1, "min": [0, 0], "max": [1e-3, 1e-3], "solid": "inside", "shapes": [{"disc": {"center": [0, 0], "radius": 1e-4}}]}``.
        angle_deg: contact angle through the wetting phase in degrees; 0 where there is none.
        tension: interfacial tension in N/m; 1 where there is none, so that pressures are those per N/m.
        inlet: side that the invading phase enters through: ``left``, ``right``, ``bottom`` or ``top``. Without one nothing is displaced.
        outlet: side that the defending phase leaves through.
        process: ``drainage`` (default), ``imbibition`` or ``cycle``.
        cycles: number of cycles of ``process="cycle"``.
        trapping: whether a defending region without a path to the outlet is trapped (default yes).
        periodic: sides that are joined: ``x``, ``y`` or ``xy``.
        depth: distance of floor and lid in m; that of the file where there is none, or everything is per meter of depth.
        persistence: ratio above which two maxima of the wall distance are one pore, 0.5 to 1.
        unit: unit of the drawing: m, cm, mm, um, nm, in, mil, ft, pt or px.
        scale: length of the drawing unit in m, in place of ``unit``.
        window: corners of the domain in m: x0, y0, x1, y1.
        layers: names of the layers that are read; all where there is none.
        join_within: gap below which the ends of lines in a DXF drawing are joined, in units of the drawing.
        threshold: gray value between solid and pore of an image, 0 (black) to 1 (white).
        pixel_size: side of a pixel of an image in m.
        invert: whether what is drawn is the pore.
        recognize_circles: whether polygons whose vertices lie on a circle become discs (default yes).
        smooth_below_deg: vertices with a turning angle below this many degrees become arcs (default 20); 0: none.
        columns: columns of x, y and radius in a list of discs, from 0.
        separator: the character between the columns of a list of discs.
        diameters: whether the third column of a list of discs holds diameters.
        frame: the inside of the outline without fill around all others, ``pore`` or ``solid``, where the drawing leaves it open.
        nested: what shapes of another color on larger ones, or outlines in others on layers of GDS, are: ``pore`` or ``solid``.
        out: as in `run`.
        progress: as in `run`.
        threads: as in `run`.

    Returns:
        The result, with ``pores``, ``throats`` and ``events``.

    Raises:
        CaseError: the drawing or a parameter is wrong.
        FolderError: as in `run`.
        KeyboardInterrupt: Ctrl-C.

    """
    of_import = {
        "unit": unit,
        "scale": scale,
        "window": None if window is None else [list(window)[:2], list(window)[2:]],
        "layers": layers,
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
    axes = {None: None, "x": [True, False], "y": [False, True], "xy": [True, True]}
    if periodic not in axes:
        raise ValueError(f"periodic: expected 'x', 'y' or 'xy', found {periodic!r}")
    options = {
        "angle_deg": angle_deg,
        "tension": tension,
        "inlet": inlet,
        "outlet": outlet,
        "process": process,
        "cycles": cycles,
        "trapping": trapping,
        "periodic": axes[periodic],
        "depth": depth,
        "persistence": persistence,
    }
    kind = "shapes" if isinstance(drawing, Mapping) else "drawing"
    output = None if out is None else (os.fspath(out), False)
    return _result(given((kind, drawing), None, of_import, options), output, progress, threads, False)


def _result(case: dict[str, str], output: tuple[str, bool] | None, progress: Any, threads: int | None, keep_frames: bool) -> Result:
    result = Result(_meniscus.run(case, output, threads, listener(progress), keep_frames))
    if result.status == "failed":
        raise SolverError(result.report["error"] or "the solver failed", result)
    if result.status == "interrupted":
        raise KeyboardInterrupt
    return result
