"""What the tests share: the program, whose files the arrays must equal, and the folder of the repository."""

import csv
import os
import subprocess
from itertools import pairwise
from pathlib import Path

import meshio
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
# A drop on a wall with few particles, which runs for some tens of steps.
DROP = ROOT / "cases/sessile-drop.toml"

# A study of angles of a small drop, by base case and angles.
STUDY = """
format = 1
title = "Angles of a small drop"
case = "{case}"
set = ["sph.spacing=1e-4", "time.end=2e-4", "expect=[]"]

[[axis]]
key = "sph.wetting.young.contact-angle-deg"
name = "angle"
values = [{values}]
"""

DROP_SET = {"sph.spacing": 1e-4, "time.end": 2e-4, "expect": [], "output.vtk.every-time": 1e-4}


def pytest_configure(config):
    """Warnings of coarse runs are of interest only where a test expects them."""
    config.addinivalue_line("filterwarnings", "ignore::meniscus.MeniscusWarning")


@pytest.fixture(scope="session")
def program():
    """The path of the program, built from the same source."""
    return os.environ["MENISCUS_PROGRAM"]


@pytest.fixture
def by_program(program, tmp_path):
    """Runs the program with arguments, and returns the folder that it wrote."""

    def run(*arguments: object, code: int = 0) -> Path:
        out = tmp_path / "by-program"
        done = subprocess.run([program, *map(str, arguments), "--out", out], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        return out

    return run


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A study of a small drop at two angles."""
    path = tmp_path / "angles.toml"
    path.write_text(STUDY.format(case=DROP.as_posix(), values="60.0, 90.0"))
    monkeypatch.chdir(tmp_path)
    return path


def set_options(changes: dict) -> list[str]:
    """Changes of keys as the command line takes them."""
    return [f"--set={key}={value!r}" for key, value in changes.items()]


def columns(path: Path) -> dict[str, np.ndarray]:
    """A CSV file as the package has it: numbers, whole numbers with -1 for none, yes or no, words."""
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    return {head: np.array([row[place] for row in rows[1:]]) for place, head in enumerate(rows[0])}


def as_in(array: np.ndarray, texts: np.ndarray) -> np.ndarray:
    """The texts of a CSV column as numbers of the kind of an array."""
    if array.dtype == bool:
        return texts == "True"
    if array.dtype.kind == "U":
        return texts
    missing = "-1" if array.dtype.kind == "i" else "nan"
    return np.where(texts == "", missing, texts).astype(array.dtype)


def assert_same_bits(found: np.ndarray, wanted: np.ndarray, what: str) -> None:
    """Fails unless both have the same shape and the same bits."""
    found, wanted = np.ascontiguousarray(found), np.ascontiguousarray(wanted)
    assert found.shape == wanted.shape and found.dtype == wanted.dtype, what
    assert found.tobytes() == wanted.tobytes(), f"{what} differs"


def assert_same_columns(found: dict[str, np.ndarray], path: Path) -> None:
    """Fails unless columns have the bits of those of a CSV file."""
    wanted = columns(path)
    assert list(found) == list(wanted), path.name
    for name, array in found.items():
        texts = wanted[name][: len(array)]
        assert all(text == "" for text in wanted[name][len(array) :]), name
        assert_same_bits(array, as_in(array, texts), f"{path.name}: {name}")


def last(folder: Path, name: str) -> Path:
    """The last file of a VTK time series."""
    return sorted((folder / name).glob("*.vtu"))[-1]


def assert_same_vtk(fields, path: Path) -> None:
    """Fails unless points, cells and fields have the bits of those of a VTK file, whose third components are zero."""
    mesh = meshio.read(path)
    assert_same_bits(fields.points, mesh.points[:, :2], f"{path.name}: points")
    on_cells = {name: np.concatenate(blocks) for name, blocks in mesh.cell_data.items()}
    there = mesh.point_data | on_cells
    assert sorted(fields) == sorted(there), path.name
    for name in fields:
        wanted = there[name] if there[name].ndim == 1 else there[name][:, :2]
        assert_same_bits(fields[name], wanted, f"{path.name}: {name}")
    if fields.kind in ("lines", "polygons"):
        wanted = [list(cell) for block in mesh.cells for cell in block.data]
        pairs = [list(pair) for cell in fields.cells for pair in pairwise(cell)]
        assert (pairs if fields.kind == "lines" else [list(cell) for cell in fields.cells]) == wanted
