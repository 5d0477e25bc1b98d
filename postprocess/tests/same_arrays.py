"""Fails unless meshio, pyvista and VTK's own reader read the same arrays of each frame in all the folders of one run.

meshio does not read LZ4, nor anything but .vtu; it may pass over a folder only where its files say that they are in LZ4.
Used as: same_arrays.py FOLDER ...
"""

import sys
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

Arrays = dict[str, np.ndarray]


def by_pyvista(path: Path) -> Arrays:
    mesh = pv.read(path)
    arrays = {name: np.asarray(mesh.point_data[name]) for name in mesh.point_data}
    assert mesh.n_cells == mesh.n_points
    return arrays | {"points": np.asarray(mesh.points), "time": np.asarray(mesh.field_data["TimeValue"])}


def by_vtk(path: Path) -> Arrays:
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    mesh = reader.GetOutput()
    data = mesh.GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    time = vtk_to_numpy(mesh.GetFieldData().GetArray("TimeValue"))
    return arrays | {"points": vtk_to_numpy(mesh.GetPoints().GetData()), "time": time}


def by_meshio(path: Path) -> Arrays:
    mesh = meshio.read(path)
    assert [block.type for block in mesh.cells] == ["vertex"]
    return mesh.point_data | {"points": mesh.points, "time": mesh.field_data["TimeValue"]}


def assert_same(found: Arrays, wanted: Arrays, what: str) -> None:
    assert sorted(found) == sorted(wanted), f"{what}: {sorted(found)}, expected {sorted(wanted)}"
    for name, values in wanted.items():
        same = found[name].dtype == values.dtype and np.array_equal(found[name], values, equal_nan=True)
        assert same, f"{what}: {name} is {found[name].shape} {found[name]}, expected {values.shape} {values}"


def files_of_collection(collection: Path) -> list[Path]:
    return [collection.parent / entry.attrib["file"] for entry in ElementTree.parse(collection).iter("DataSet")]


def main(folders: list[Path]) -> None:
    frames = [path.relative_to(folders[0]) for path in files_of_collection(folders[0] / "particles.pvd")]
    assert len(frames) == 2 and pv.get_reader(folders[0] / "particles.pvd").number_time_points == 2
    wanted = {frame: by_pyvista(folders[0] / frame) for frame in frames}
    assert all(len(arrays["id"]) * 8 > 32768 for arrays in wanted.values()), "arrays of one block"
    for folder in folders:
        is_lz4 = b"vtkLZ4DataCompressor" in (folder / frames[0]).read_bytes()[:300]
        readers = [by_pyvista, by_vtk] + ([] if is_lz4 else [by_meshio])
        for frame in frames:
            for reader in readers:
                assert_same(reader(folder / frame), wanted[frame], f"{folder / frame} {reader.__name__}")
        for path in ["grid/grid-000001.vti", "interface/interface-000001.vtp", "solid.vtp"]:
            mesh, first = pv.read(folder / path), pv.read(folders[0] / path)
            assert mesh == first and mesh.n_points > 0, f"{folder / path} differs"
        print(f"{folder.name}: {'no meshio' if is_lz4 else 'meshio read'} {len(frames)} frames")


if __name__ == "__main__":
    main([Path(argument) for argument in sys.argv[1:]])
