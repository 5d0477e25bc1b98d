"""Measures are floats, and tables."""

import copy
import json
import math
import pickle

import numpy as np
import pandas
import pytest
from conftest import DROP, DROP_SET, ROOT, columns

import meniscus

CHIP = ROOT / "geometries/chip.svg"


@pytest.fixture(scope="module")
def chip():
    """A chip drained from left to right."""
    return meniscus.network(CHIP, inlet="left", outlet="right", angle_deg=40, tension=0.0728, threads=1)


@pytest.fixture
def angle():
    """A measure with all that one may have."""
    return meniscus.Measure(90.6, "deg", 30.61, "by circles", 2307.0)


def test_a_measure_computes_compares_and_prints_as_a_float(angle):
    assert isinstance(angle, float) and (float(angle), angle.value) == (90.6, 90.6)
    assert type(angle.value) is float and type(2 * angle) is float
    assert (angle + 1, angle / 2, -angle, abs(angle), round(angle)) == (91.6, 45.3, -90.6, 90.6, 91)
    assert angle == 90.6 and hash(angle) == hash(90.6) and angle < 91 and angle > meniscus.Measure(3.0)
    assert (f"{angle:.3g}", f"{angle:6.2f}", str(angle), f"{angle}", json.dumps([angle])) == ("90.6", " 90.60", "90.6", "90.6", "[90.6]")
    assert np.isclose(angle, 90.6) and sum([angle, angle]) == 181.2 and math.cos(angle) == math.cos(90.6)
    assert sorted([angle, meniscus.Measure(3.0, "deg")])[0].unit == "deg"
    array = np.array([angle, 1])
    assert array.dtype == float and array[0] == 90.6 and (np.ones(2) * angle).dtype == float
    assert repr(angle) == "<Measure: 90.6 ± 30.61 deg, not at rest: 2307 deg/s>"


def test_a_measure_without_a_value_is_not_a_number_and_says_why(chip):
    missing = chip.measures["permeability-y-m2"]
    assert missing.value is None and math.isnan(missing) and missing != missing and missing.unit == "m2"
    assert repr(missing) == f"<Measure: not measured ({missing.method})>" and "sides along this axis" in missing.method
    assert "permeability-y-m2 = not measured" in repr(chip) and "breakthrough-pressure-Pa = 302.1 Pa" in repr(chip)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
@pytest.mark.parametrize("value", [90.6, None])
def test_copies_of_a_measure_are_equal_in_all(copied, value):
    one = meniscus.Measure(value, "deg", 30.61, "by circles", 2307.0)
    two = copied(one)
    assert type(two) is meniscus.Measure and (two.value, two.unit, two.uncertainty, two.method, two.rate) == (value, "deg", 30.61, "by circles", 2307.0)


def test_measures_are_a_dict_and_a_table(chip):
    assert isinstance(chip.measures, dict) and list(chip.measures) == list(chip.report["measures"])
    table = chip.measures.to_frame()
    assert list(table.columns) == ["value", "unit", "uncertainty", "rate", "method"] and list(table.index) == list(chip.measures)
    pressure = table.loc["breakthrough-pressure-Pa"]
    assert (pressure["value"], pressure["unit"]) == (chip.measures["breakthrough-pressure-Pa"].value, "Pa")
    assert table["value"].dtype == float and table["uncertainty"].isna().all() and np.isnan(table["value"]["permeability-y-m2"])
    assert list(meniscus.Measures().to_frame().columns) == list(table.columns)


def test_columns_become_data_frames_at_once(chip):
    for there in (chip.series, chip.pores, chip.throats, chip.events):
        frame = pandas.DataFrame(there)
        assert list(frame.columns) == list(there) and len(frame) == len(next(iter(there.values()))) > 0
    assert pandas.Series(chip.measures)["pores"] == len(chip.pores["x_m"])


def test_a_study_becomes_a_data_frame_with_the_columns_of_its_table(study):
    with pytest.warns(meniscus.MeniscusWarning, match="^angle=60: a drop of this area"):
        found = meniscus.study(study)
    table = columns(found.folder / "table.csv")
    frame = found.to_frame()
    assert frame.index.name == "run" and list(frame.index) == list(table["run"]) and list(frame["status"]) == ["done", "done"]
    assert list(frame.columns) == [name for name in table if name not in ("run",) and not name.endswith("-not-at-rest")]
    assert np.array_equal(frame["contact-angle-deg-uncertainty"], table["contact-angle-deg-uncertainty"].astype(float))
    assert frame.attrs["units"]["contact-angle-deg"] == "deg" and np.isnan(found.column("steady-at-s")).all()
    assert found[0].warnings == [text.removeprefix("angle=60: ") for text in found.warnings] and found[1].warnings == []


def test_grids_over_time_become_a_data_set(chip):
    drop = meniscus.run(DROP, set=DROP_SET, keep_frames=True, threads=1)
    found = drop.to_xarray()
    rows, count = drop.grid.counts[1], drop.grid.counts[0]
    assert dict(found.sizes) == {"time": 3, "y": rows, "x": count, "component": 2} and list(found.data_vars) == list(drop.grid)
    assert found["velocity"].dims == ("time", "y", "x", "component") and found["pressure"].attrs["units"] == "Pa"
    assert list(found["time"].values) == [frame.time for frame in drop.frames] and found["x"].attrs["units"] == "m"
    y, x = 3, 5
    place = found.isel(y=y, x=x)
    assert np.array_equal([place["x"], place["y"]], drop.grid.points[y * count + x])
    for time, frame in enumerate(drop.frames):
        assert np.array_equal(place["velocity"][time], frame.grid["velocity"][y * count + x])
        assert np.array_equal(found["pressure"][time].values.ravel(), frame.grid["pressure"])
    assert drop.grid.to_xarray().equals(found.isel(time=-1, drop=True))
    with pytest.raises(ValueError, match="only direct simulations"):
        chip.to_xarray()
    with pytest.raises(ValueError, match="expected fields on a grid, found points"):
        drop.particles.to_xarray()
