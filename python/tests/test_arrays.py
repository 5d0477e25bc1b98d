"""Arrays have the bits of the files that the command line writes."""

import json

import numpy as np
import pytest
from conftest import DROP, DROP_SET, ROOT, assert_same_bits, assert_same_columns, assert_same_vtk, last, set_options

import meniscus

CHIP = ROOT / "geometries/chip.svg"
FILM = ROOT / "cases/thin-film/partial-wetting.toml"
FILM_SET = {"time.end": 0.1, "expect": []}
# What differs from run to run.
OF_THE_RUN = ("machine", "wall-time-s", "cpu-s", "solver")


def assert_same_run(result, folder):
    """Fails unless series and report are those of the files."""
    assert_same_columns(result.series, folder / "series.csv")
    report = json.loads((folder / "report.json").read_text())
    same = [name for name in report if name not in OF_THE_RUN]
    assert {name: result.report[name] for name in same} == {name: report[name] for name in same}
    assert list(result.measures) == list(report["measures"])
    assert_same_vtk(result.solid, folder / "solid.vtu")


def test_a_direct_simulation_has_the_bits_of_the_files(by_program, tmp_path):
    folder = by_program("run", DROP, *set_options(DROP_SET))
    result = meniscus.run(DROP, set=DROP_SET, keep_frames=True, threads=1)
    assert_same_run(result, folder)
    for name, fields in (("particles", result.particles), ("grid", result.grid), ("interface", result.interface)):
        assert_same_vtk(fields, last(folder, name))
    assert [len(result.frames), result.frames[0].time, result.frames[-1].time] == [3, 0.0, 2e-4]
    for frame, file in zip(result.frames, sorted((folder / "particles").glob("*.vtu")), strict=True):
        assert_same_vtk(frame.particles, file)
    assert result.particles.units["velocity"] == "m/s" and result.folder is None
    rows, columns = result.grid.counts[1], result.grid.counts[0]
    assert result.grid["pressure"].reshape(rows, columns).shape == (rows, columns)
    written = meniscus.run(DROP, set=DROP_SET, out=tmp_path / "out")
    assert_same_run(written, folder)
    assert (tmp_path / "out/series.csv").read_bytes() == (folder / "series.csv").read_bytes()
    assert last(tmp_path / "out", "particles").read_bytes() == last(folder, "particles").read_bytes()


def test_a_thin_film_has_the_bits_of_the_files(by_program):
    folder = by_program("run", FILM, *set_options(FILM_SET))
    result = meniscus.run(FILM, set=FILM_SET)
    assert_same_run(result, folder)
    assert_same_vtk(result.particles, last(folder, "particles"))
    assert_same_vtk(result.interface, last(folder, "interface"))
    assert result.grid is None


@pytest.mark.parametrize("process", ["drainage", "cycle"])
def test_a_network_has_the_bits_of_the_files(by_program, process):
    options = ("--inlet", "left", "--outlet", "right", "--angle-deg", 40, "--tension", 0.0728, "--process", process)
    folder = by_program("network", CHIP, *options)
    result = meniscus.network(CHIP, inlet="left", outlet="right", angle_deg=40, tension=0.0728, process=process)
    assert_same_run(result, folder)
    assert sorted(f"{name}.csv" for name in result.tables) == sorted(file.name for file in folder.glob("*.csv") if file.name != "series.csv")
    for name, table in result.tables.items():
        assert_same_columns(table, folder / f"{name}.csv")
    for name in ("pores", "throats"):
        assert_same_vtk(result.frame.layers[name], folder / f"{name}.vtu")
    assert_same_vtk(result.frame.layers["regions"], last(folder, "regions"))
    for name, text in result.documents.items():
        assert text == (folder / name).read_text()
    assert len(result.pores["x_m"]) == len(result.frame.layers["pores"].points)


def test_a_case_of_a_network_and_one_in_time_have_the_bits_of_the_files(by_program, tmp_path):
    case, changes = ROOT / "cases/network/dynamic.toml", {"time.end": 0.002, "expect": []}
    folder = by_program("run", case, *set_options(changes))
    result = meniscus.run(case, set=changes)
    assert_same_run(result, folder)
    for name, table in result.tables.items():
        assert_same_columns(table, folder / f"{name}.csv")


def test_a_dict_is_the_case_of_the_file():
    case = {
        "format": 1,
        "title": "Two posts",
        "geometry": {
            "min": [-2e-3, -1e-3],
            "max": np.array([2e-3, 1e-3]),
            "solid": "inside",
            "shapes": [{"disc": {"center": [0.0, y], "radius": np.float64(0.9e-3)}} for y in (-1e-3, 1e-3)],
        },
        "network": {
            "inlet": "left",
            "outlet": "right",
            "interface": {"tension": 0.03},
            "wetting": {"young": {"contact-angle-deg": 20}},
        },
    }
    by_case = meniscus.run(case)
    shapes = {"format": 1, **case["geometry"]}
    by_parameters = meniscus.network(shapes, inlet="left", outlet="right", tension=0.03, angle_deg=20)
    assert list(by_case.tables) == list(by_parameters.tables)
    for name, column in by_case.throats.items():
        assert_same_bits(column, by_parameters.throats[name], name)
    assert abs(by_case.throats["width_m"][0] - 0.2e-3) < 1e-15
    assert meniscus.run(case, set={"network.interface.tension": 0.06}).throats["entry_pressure_Pa"][0] == (2 * by_case.throats["entry_pressure_Pa"][0])
    assert meniscus.network(shapes).notes == [] and "events" not in meniscus.network(shapes).tables
    assert "1 N/m" in meniscus.network(shapes, inlet="left").notes[0]


def test_pictures_are_drawn():
    import matplotlib

    matplotlib.use("Agg")
    network = meniscus.network(CHIP, inlet="left", outlet="right", angle_deg=40, tension=0.0728)
    axes = network.plot()
    assert "Pa" in axes.get_ylabel() and axes.lines
    assert network.plot("picture", field="sequence").collections
    with pytest.raises(ValueError, match="there is picture, capillary-pressure"):
        network.plot("no-such-diagram")
    drop = meniscus.run(DROP, set=DROP_SET)
    axes = drop.plot(field="velocity")
    assert axes.get_xlabel() == "x (mm)" and len(axes.collections) == 3
