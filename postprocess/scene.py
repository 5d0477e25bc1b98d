"""The scene that pictures and movies share: a field on the grid, the interface as a line, the solids filled."""

from pathlib import Path

import numpy as np
import pyvista as pv
from matplotlib.colors import LinearSegmentedColormap

import colors
import results

# Pixels of the longer side where nothing else is asked for.
LONG_SIDE = 1280
# Pixels that bar and axes need at least.
SHORT_SIDE = 640
# Height of the picture over that of the data.
ROOM = 1.4
# Where fields have colors of their own: the color function is 0 in the non-wetting and 1 in the wetting phase.
COLORMAPS = {"color": LinearSegmentedColormap.from_list("phases", [colors.NON_WETTING, colors.WETTING])}
# The color bar on the right.
BAR = {
    "fmt": "%.4g",
    "color": "black",
    "vertical": True,
    "position_x": 0.86,
    "position_y": 0.2,
    "height": 0.6,
    "title_font_size": 20,
    "label_font_size": 18,
}


def scalar(data, field: str) -> np.ndarray:
    """A field as one number per point: the magnitude of a vector."""
    values = np.asarray(data.point_data[field], dtype=float)
    return np.linalg.norm(values, axis=1) if values.ndim == 2 else values


def up_to_walls(grid, values: np.ndarray) -> np.ndarray:
    """Values that points of the solids next to the pore have from the pore points of their cells, for cells that a wall cuts."""
    cells = grid.cells_dict[pv.CellType.QUAD]
    known = np.asarray(grid.point_data["wall-distance"]) > 0.0

    def sums(weights: np.ndarray) -> np.ndarray:
        each = np.repeat(weights[cells].sum(axis=1), cells.shape[1])
        return np.bincount(cells.ravel(), weights=each, minlength=len(values))

    counts = sums(known.astype(float))
    means = sums(np.where(known, values, 0.0)) / np.maximum(counts, 1.0)
    return np.where(known | (counts == 0.0), values, means)


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


def length_unit(bounds) -> tuple[float, str]:
    """What meters are multiplied with, and the unit, so that the longer side has few digits before its point."""
    longer = max(bounds[1] - bounds[0], bounds[3] - bounds[2])
    # The axes have no letter for micrometers.
    units = [(1.0, 1.0, "m"), (0.1, 1e3, "mm")]
    return next(((factor, unit) for least, factor, unit in units if longer * factor >= least), (1e6, "1e-6 m"))


def in_thousands(label: str, limits: tuple[float, float]) -> tuple[float, str]:
    """What values are multiplied with, and their label: kPa in place of thousands of Pa."""
    is_large = "(Pa)" in label and max(abs(limit) for limit in limits) >= 1e4
    return (1e-3, label.replace("(Pa)", "(kPa)")) if is_large else (1.0, label)


def window_size(bounds, size: int) -> list[int]:
    """Window in pixels for the bounds of a flat data set, its sides multiples of 16 as video codecs want them."""
    width, height = bounds[1] - bounds[0], bounds[3] - bounds[2]
    longer = max(width, height)
    return [max(16 * round(size * side / longer / 16), SHORT_SIDE) for side in (width, height)]


def draw(plotter, directory: Path, frame: results.Frame, field: str, limits: tuple[float, float]) -> None:
    """Puts one frame into a plotter, replacing what it shows."""
    plotter.clear()
    grid = results.read(frame.file)
    bounds = grid.bounds
    factor, label = in_thousands(results.label(field), limits)
    grid.point_data["shown"] = factor * up_to_walls(grid, scalar(grid, field))
    solids = grid.clip_scalar(scalars="wall-distance", value=0.0)
    if solids.n_points:
        plotter.add_mesh(solids, color=colors.SOLID, lighting=False)
    pore = grid.clip_scalar(scalars="wall-distance", value=0.0, invert=False)
    if pore.n_points:
        bar, clim = {**BAR, "title": f"{label}\n "}, [factor * limit for limit in limits]
        plotter.add_mesh(pore, scalars="shown", clim=clim, cmap=COLORMAPS.get(field, "viridis"), scalar_bar_args=bar, nan_opacity=0.0)
    # Lines are lifted towards the viewer, or the field in the same plane covers them.
    lift = (0.0, 0.0, 1e-2 * max(bounds[1] - bounds[0], bounds[3] - bounds[2]))
    lines = results.read(results.frame_at(directory / "interface.pvd", frame.time).file)
    if lines.n_points:
        plotter.add_mesh(lines.translate(lift), color=colors.MENISCUS, line_width=4)
    solid = results.read(directory / "solid.vtu")
    if solid.n_points:
        plotter.add_mesh(solid.translate(lift), color=colors.WALL, line_width=3)
    plotter.add_text(f"t = {frame.time:.4g} s", font_size=12, color="black")
    factor, unit = length_unit(bounds)
    plotter.show_bounds(
        bounds=bounds,
        axes_ranges=[factor * end for end in bounds],
        xtitle=f"x ({unit})",
        ytitle=f"y ({unit})",
        color="black",
        fmt="%.4g",
        n_xlabels=2,
        n_ylabels=2,
        grid=False,
        location="outer",
        font_size=10,
    )
    look_down(plotter, bounds)


def look_down(plotter, bounds) -> None:
    """The whole data set without perspective, with room for axes and bar."""
    plotter.view_xy()
    plotter.enable_parallel_projection()
    width, height = plotter.window_size
    half = 0.5 * max(bounds[3] - bounds[2], (bounds[1] - bounds[0]) * height / width)
    plotter.camera.parallel_scale = ROOM * half
    # The bar stands on the right, so the scene moves to the left by a part of the room.
    shift = 0.06 * half * width / height
    x, y = 0.5 * (bounds[0] + bounds[1]) + shift, 0.5 * (bounds[2] + bounds[3])
    plotter.camera.focal_point = (x, y, 0.0)
    plotter.camera.position = (x, y, 10.0 * half)
    plotter.reset_camera_clipping_range()
    # From the second picture on, view_xy has rendered already, before the lines after it.
    plotter.render()


def plotter(directory: Path, frame: results.Frame, size: int = LONG_SIDE):
    """An off-screen plotter for a frame, `size` pixels along its longer side."""
    pv.OFF_SCREEN = True
    made = pv.Plotter(off_screen=True, window_size=window_size(results.read(frame.file).bounds, size))
    made.set_background("white")
    return made
