"""Fails unless meshio, pyvista and VTK's own reader read the same bits from every VTK file below some folders.

Used as: same_arrays.py [--apart] FOLDER ...

Points, cells and the arrays on both are compared, between readers and, unless the folders are those of runs apart, with
the same file of the first folder. meshio passes over files in LZ4; on a file without cells it has to fail: up to
version 5.3 it reads none, its own neither.
"""

import argparse
from pathlib import Path

import meshio
import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

Arrays = dict[str, np.ndarray]
CELL_TYPES = {"vertex": 1, "line": 3, "polygon": 7, "quad": 9}


def cells(connectivity, sizes, types) -> Arrays:
    """Cells; each reader holds them in integers of its choice."""
    found = {"connectivity": connectivity, "sizes": sizes, "types": types}
    return {name: np.asarray(values, dtype=np.int64) for name, values in found.items()}


def by_pyvista(path: Path) -> Arrays:
    """What pyvista reads."""
    mesh = pv.read(path)
    assert isinstance(mesh, pv.UnstructuredGrid), f"{path} is no unstructured grid"
    arrays = {f"{name} on points": np.asarray(mesh.point_data[name]) for name in mesh.point_data}
    arrays |= {f"{name} on cells": np.asarray(mesh.cell_data[name]) for name in mesh.cell_data}
    arrays["points"] = np.asarray(mesh.points)
    return arrays | cells(mesh.cell_connectivity, np.diff(mesh.cell_offsets), mesh.celltypes)


def by_vtk(path: Path) -> Arrays:
    """What VTK reads."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    mesh = reader.GetOutput()
    arrays = {"points": vtk_to_numpy(mesh.GetPoints().GetData())}
    for place, data in (("points", mesh.GetPointData()), ("cells", mesh.GetCellData())):
        for i in range(data.GetNumberOfArrays()):
            arrays[f"{data.GetArrayName(i)} on {place}"] = vtk_to_numpy(data.GetArray(i))
    topology = mesh.GetCells()
    connectivity, offsets = (vtk_to_numpy(array) for array in (topology.GetConnectivityArray(), topology.GetOffsetsArray()))
    return arrays | cells(connectivity, np.diff(offsets), vtk_to_numpy(mesh.GetCellTypes()))


def by_meshio(path: Path) -> Arrays:
    """What meshio reads: cells in blocks, here one after the other."""
    mesh = meshio.read(path)
    arrays = {f"{name} on points": values for name, values in mesh.point_data.items()}
    arrays |= {f"{name} on cells": np.concatenate(blocks) for name, blocks in mesh.cell_data.items()}
    connectivity = np.concatenate([block.data.ravel() for block in mesh.cells])
    assert connectivity.dtype == np.int64, f"{path}: points of cells are {connectivity.dtype}"
    sizes = np.concatenate([np.full(len(block), block.data.shape[1]) for block in mesh.cells])
    types = np.concatenate([np.full(len(block), CELL_TYPES[block.type]) for block in mesh.cells])
    return arrays | {"points": mesh.points} | cells(connectivity, sizes, types)


def is_read_by_meshio(path: Path, arrays: Arrays) -> bool:
    """Whether meshio knows the compression and there are cells, without which it fails."""
    if b"vtkLZ4DataCompressor" in path.read_bytes()[:300]:
        return False
    if len(arrays["types"]) > 0:
        return True
    try:
        meshio.read(path)
    except IndexError:
        return False
    raise AssertionError(f"this meshio reads files without cells, such as {path}: compare them too")


def assert_same(found: Arrays, wanted: Arrays, what: str) -> None:
    """The same names, kinds of numbers, shapes and bits, those of NaN too."""
    assert sorted(found) == sorted(wanted), f"{what}: {sorted(found)}, expected {sorted(wanted)}"
    for name, values in wanted.items():
        pair = [(array.dtype, array.shape, array.tobytes()) for array in (found[name], values)]
        assert pair[0] == pair[1], f"{what}: {name} is {pair[0][:2]} {found[name]}, expected {pair[1][:2]} {values}"


def compare(folders: list[Path]) -> None:
    """Compares all files of one run, in one folder or in several, and prints how many there were."""
    names = sorted(path.relative_to(folders[0]) for path in folders[0].rglob("*.vtu"))
    assert names, f"no VTK file below {folders[0]}"
    others = [path for folder in folders for path in folder.rglob("*.vt?") if path.suffix != ".vtu"]
    assert not others, f"meshio reads no file such as {others}"
    for folder in folders:
        assert sorted(path.relative_to(folder) for path in folder.rglob("*.vtu")) == names, f"{folder} has other files"
        by_all = 0
        for name in names:
            wanted, path = by_pyvista(folders[0] / name), folder / name
            if folder != folders[0]:
                assert_same(by_pyvista(path), wanted, f"{path} by pyvista")
            assert_same(by_vtk(path), wanted, f"{path} by VTK")
            if is_read_by_meshio(path, wanted):
                assert_same(by_meshio(path), wanted, f"{path} by meshio")
                by_all += 1
        print(f"{folder.name}: {len(names)} files, {by_all} of them by meshio too")


def main() -> None:
    """Compares the files of one run, or of each folder apart."""
    parser = argparse.ArgumentParser(description="compare what three readers read of VTK files")
    parser.add_argument("--apart", action="store_true", help="each folder is that of another run")
    parser.add_argument("folder", type=Path, nargs="+", help="output folder of `meniscus run`")
    arguments = parser.parse_args()
    for folders in [[folder] for folder in arguments.folder] if arguments.apart else [arguments.folder]:
        try:
            compare(folders)
        except Exception as error:
            error.add_note(f"in {', '.join(map(str, folders))}")
            raise


if __name__ == "__main__":
    main()
