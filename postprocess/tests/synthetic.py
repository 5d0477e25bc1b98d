"""Writes a small output folder by the output contract: a drop between two plates that grows over three times."""

import json
from pathlib import Path

import numpy as np
import pyvista as pv

import results

SPACING = 5.0e-5
COUNT = 20
TIMES = [0.0, 1.0e-3, 2.0e-3]


def write(directory: Path) -> None:
    """Writes all files of the contract below `directory`."""
    for name in ("particles", "grid", "interface"):
        (directory / name).mkdir(parents=True)
    for index in range(len(TIMES)):
        radius = (4.0 + index) * SPACING
        for name, data in {"particles": particles(radius), "grid": grid(radius), "interface": circle(radius)}.items():
            data.save(directory / name / f"{index:06}.vtu")
    for name in ("particles", "grid", "interface"):
        write_collection(directory, name)
    plate = np.array([[-10.0, -9.5, 0.0], [10.0, -9.5, 0.0]]) * SPACING
    lines(plate, [[0, 1]]).save(directory / "solid.vtu")
    write_series(directory / "series.csv")
    (directory / "report.json").write_text(json.dumps(report()), encoding="utf-8")


def fields(points: np.ndarray, radius: float) -> dict[str, np.ndarray]:
    """Every array of the contract at the points."""
    count = len(points)
    inside = np.linalg.norm(points, axis=1) < radius
    wall_distance = points[:, 1] + 9.5 * SPACING
    values = {name: np.zeros(count if n == 1 else (count, n)) for name, n in results.PARTICLE_ARRAYS.items()}
    values |= {
        "id": np.arange(count),
        "phase": np.where(wall_distance < 0.0, 2, np.where(inside, 0, 1)),
        "color": inside.astype(float),
        "pressure": np.where(inside, 0.03 / radius, 0.0),
        "density": np.full(count, 770.0),
        "volume": np.full(count, SPACING**2),
        "wall-distance": wall_distance,
    }
    return values


def lattice() -> np.ndarray:
    """Points of a square lattice about the origin."""
    along = (np.arange(COUNT) - 0.5 * (COUNT - 1)) * SPACING
    x, y = np.meshgrid(along, along)
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(COUNT * COUNT)])


def particles(radius: float) -> pv.UnstructuredGrid:
    """Each particle as a vertex cell."""
    points = lattice()
    cells = np.column_stack([np.ones(len(points), dtype=int), np.arange(len(points))]).ravel()
    data = pv.UnstructuredGrid(cells, np.full(len(points), pv.CellType.VERTEX), points)
    for name, values in fields(points, radius).items():
        data.point_data[name] = values
    return data


def grid(radius: float) -> pv.UnstructuredGrid:
    """The same fields on a regular grid."""
    points = lattice()
    corner = np.arange(COUNT * COUNT).reshape(COUNT, COUNT)[:-1, :-1].ravel()
    quadrilaterals = np.column_stack([corner, corner + 1, corner + 1 + COUNT, corner + COUNT])
    data = pv.UnstructuredGrid({pv.CellType.QUAD: quadrilaterals}, points)
    values = fields(points, radius)
    for name in results.GRID_ARRAYS:
        data.point_data[name] = values[name]
    return data


def lines(points: np.ndarray, segments) -> pv.UnstructuredGrid:
    """Lines between points."""
    return pv.UnstructuredGrid({pv.CellType.LINE: np.array(segments)}, points)


def circle(radius: float) -> pv.UnstructuredGrid:
    """The interface as a closed line."""
    angles = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    points = radius * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(40)])
    data = lines(points, [[i, (i + 1) % 40] for i in range(40)])
    data.point_data["curvature"] = np.full(40, 1.0 / radius)
    return data


def write_collection(directory: Path, name: str) -> None:
    """Writes a .pvd."""
    lines = [f'<DataSet timestep="{time}" file="{name}/{index:06}.vtu"/>' for index, time in enumerate(TIMES)]
    text = '<VTKFile type="Collection" version="1.0"><Collection>' + "".join(lines) + "</Collection></VTKFile>"
    (directory / f"{name}.pvd").write_text(text, encoding="utf-8")


def write_series(path: Path) -> None:
    """Writes a series in which the contact line appears at the second time."""
    rows = [",".join(results.SERIES_COLUMNS)]
    for index, time in enumerate(TIMES):
        angle = "NaN" if index == 0 else str(45.0 - 2.0 * index)
        rows.append(f"{time},{index},1e-6,0.3,1e-3,1e-3,60.0,{angle},0.0,0.0,0.001,11")
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")


def report() -> dict:
    """A report with the requested angle in rad, as the resolved case holds it."""
    wetting = {"young": {"contact_angle": np.radians(40.0)}}
    angle = {"value": 41.0, "unit": "deg", "uncertainty": 0.5, "method": "circle fit"}
    return {
        "version": "0.1.0",
        "status": "done",
        "case": {"model": {"sph": {"wetting_model": wetting}}},
        "measures": {"contact-angle-deg": angle},
    }
