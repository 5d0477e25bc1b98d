"""The scene that pictures and movies share: a field on the grid, the interface as a line, the solids in gray."""

from pathlib import Path

import numpy as np
import pyvista as pv

import results

# Pixels of the longer side; a multiple of 16, as video codecs want it.
LONG_SIDE = 1280
SOLID_COLOR = "gray"


def scalar(data, field: str) -> np.ndarray:
    """A field as one number per point: the magnitude of a vector."""
    values = np.asarray(data.point_data[field], dtype=float)
    return np.linalg.norm(values, axis=1) if values.ndim == 2 else values


def value_range(directory: Path, field: str, frames: list[results.Frame]) -> tuple[float, float]:
    """Smallest and largest value of a field in the pore over the frames."""
    ends = []
    for frame in frames:
        data = results.read(frame.file)
        values = scalar(data, field)[np.asarray(data.point_data["wall-distance"]) > 0.0]
        values = values[np.isfinite(values)]
        if len(values):
            ends.extend([float(values.min()), float(values.max())])
    if not ends:
        raise ValueError(f"{field} has no finite value in {directory}")
    return min(ends), max(ends)


def window_size(bounds) -> list[int]:
    """Window in pixels for the bounds of a flat data set, its sides multiples of 16."""
    width, height = bounds[1] - bounds[0], bounds[3] - bounds[2]
    longer = max(width, height)
    # A quarter more height leaves room for the bar and the axes.
    return [max(16 * round(LONG_SIDE * side / longer / 16), 320) for side in (width, 1.25 * height)]


def draw(plotter, directory: Path, frame: results.Frame, field: str, limits: tuple[float, float]) -> None:
    """Puts one frame into a plotter, replacing what it shows."""
    plotter.clear()
    grid = results.read(frame.file)
    grid.point_data["shown"] = scalar(grid, field)
    pore = grid.threshold(0.0, scalars="wall-distance")
    if pore.n_points:
        bar = {"title": results.label(field), "fmt": "%.3g", "color": "black"}
        plotter.add_mesh(pore, scalars="shown", clim=limits, cmap="viridis", scalar_bar_args=bar, nan_opacity=0.0)
    interface = results.frame_at(directory / "interface.pvd", frame.time)
    lines = results.read(interface.file)
    if lines.n_points:
        plotter.add_mesh(lines, color="red", line_width=3, scalars=None)
    solid = results.read(directory / "solid.vtp")
    if solid.n_points:
        plotter.add_mesh(solid, color=SOLID_COLOR, line_width=2, scalars=None)
    plotter.add_text(f"t = {frame.time:.4g} s", font_size=11, color="black")
    plotter.show_bounds(grid=False, location="outer", xtitle="x (m)", ytitle="y (m)", color="black", fmt="%.2g")
    plotter.view_xy()


def plotter(directory: Path, frame: results.Frame):
    """An off-screen plotter of the right size."""
    pv.OFF_SCREEN = True
    made = pv.Plotter(off_screen=True, window_size=window_size(results.read(frame.file).bounds))
    made.set_background("white")
    return made
