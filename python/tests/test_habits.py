"""Warnings, words, lists, notebooks and curves, as Python has them."""

import re
import subprocess
import sys
from importlib.resources import files
from itertools import pairwise
from typing import get_args

import numpy as np
import pytest
from conftest import DROP, DROP_SET, ROOT

import meniscus
import meniscus.typing as words

CHIP = ROOT / "geometries/chip.svg"
ENDS = {"inlet": "left", "outlet": "right", "tension": 0.0728, "threads": 1}


@pytest.mark.parametrize("call", [meniscus.run, meniscus.check])
def test_warnings_are_those_of_python_at_the_line_of_the_call(call):
    with pytest.warns(meniscus.MeniscusWarning) as told:
        found = call(DROP, set=DROP_SET, threads=1)
    assert [str(one.message) for one in told] == found.warnings and found.warnings
    assert {one.filename for one in told} == {__file__} and issubclass(meniscus.MeniscusWarning, UserWarning)


def test_a_network_warns_at_the_line_of_the_call():
    with pytest.warns(meniscus.MeniscusWarning, match="the tension is 72 N/m") as told:
        found = meniscus.network(CHIP, **ENDS | {"tension": 72})
    assert [str(one.message) for one in told] == found.warnings and {one.filename for one in told} == {__file__}


def test_a_study_warns_once_of_all_its_runs(study):
    study.write_text(study.read_text().replace("90.0]", "59.0]"))
    with pytest.warns(meniscus.MeniscusWarning, match=r"^angle=60: a drop .* \(and 1 more: see `warnings` of the study\)$") as told:
        found = meniscus.study(study)
    assert [one.filename for one in told] == [__file__]
    assert [text.split(":")[0] for text in found.warnings] == ["angle=60", "angle=59"]


def test_words_are_those_of_the_program(program):
    text = subprocess.run([program, "network", "--help"], capture_output=True, text=True, check=True).stdout
    options = dict(re.findall(r"^ +--([a-z-]+) (.*?)(?=^ +(?:-\w, )?--|\Z)", text, re.MULTILINE | re.DOTALL))
    of_values = {"inlet": words.Side, "outlet": words.Side, "process": words.Process, "films": words.Films, "region": words.Region}
    of_values |= {"results": words.Results, "periodic": words.Periodic}
    for option, kind in of_values.items():
        assert re.findall(r"^ +- (\w+):", options[option], re.MULTILINE) == list(get_args(kind)), option
    for option in ("frame", "nested"):
        assert re.match(r"<(.*?)>", options[option]).group(1).split("|") == list(get_args(words.Inside)), option
    units = re.search(r"Unit of the drawing: (.*)", options["unit"]).group(1)
    assert re.split(r", | or ", units) == list(get_args(words.Unit))
    assert (files("meniscus") / "py.typed").is_file()


def test_the_curve_alone_has_the_events_of_all_results():
    curve, all_results = (meniscus.network(CHIP, **ENDS, depth=5e-5, results=results) for results in ("curve", "all"))
    assert set(curve.tables) == {"events", "capillary_pressure"} < set(all_results.tables)
    for name in curve.tables:
        for head, column in curve.tables[name].items():
            np.testing.assert_array_equal(column, all_results.tables[name][head], err_msg=f"{name}: {head}")


def test_one_layer_may_stand_alone():
    alone, listed = (meniscus.network(CHIP, layers=layers, threads=1) for layers in ("grains", ("grains",)))
    assert alone.notes == listed.notes and len(alone.pores["x_m"]) == len(listed.pores["x_m"]) > 0
    with pytest.raises(meniscus.CaseError, match="found `posts`, which is not in the file"):
        meniscus.network(CHIP, layers="posts")


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        ({"window": [0, 0, 1]}, "window: expected four numbers in m, x0, y0, x1 and y1, found [0, 0, 1]"),
        ({"window": "0,0,1,1"}, "window: expected four numbers in m, x0, y0, x1 and y1, found '0,0,1,1'"),
        ({"periodic": "z"}, "periodic: expected one of x, y, xy, found 'z'"),
    ],
)
def test_bad_lists_and_axes_are_refused_by_name(parameters, text):
    with pytest.raises(meniscus.CaseError, match=re.escape(text)) as caught:
        meniscus.network(CHIP, **parameters)
    assert caught.value.key == next(iter(parameters))


def test_notebooks_show_picture_measures_and_warnings(tmp_path):
    drop = meniscus.run(DROP, set=DROP_SET, threads=1)
    page = drop._repr_html_()
    assert page.count("data:image/png;base64,") == 1 and drop.warnings[0] in page
    angle = drop.measures["contact-angle-deg"]
    assert f">{angle.told()}<" in page and "±" in angle.told() and f'title="{angle.method}"' in page
    assert "<td" in drop.measures._repr_html_() and "<img" not in drop.measures._repr_html_()
    chip = meniscus.network(CHIP, angle_deg=40, out=tmp_path / "chip", **ENDS)
    assert chip._repr_html_().count("data:image/svg+xml") == 1, "the curve that the program has drawn"
    hidden = "import sys; sys.modules['matplotlib'] = None\nimport meniscus\n"
    script = f"{hidden}page = meniscus.network({str(CHIP)!r}, threads=1)._repr_html_()\nassert '<td' in page and '<img' not in page"
    subprocess.run([sys.executable, "-c", script], check=True)


def test_notebooks_show_the_first_curve_and_the_runs_of_a_study(study):
    study.write_text(study.read_text() + '\n[[report.curve]]\ntitle = "Angles"\nx = "angle"\ny = "contact-angle-deg"\n')
    found = meniscus.study(study)
    page = found._repr_html_()
    assert page.count("data:image/svg+xml") == 1 and page.count("<tr>") == 3 and found[0].measures["contact-angle-deg"].told() in page


def test_a_library_that_is_missing_is_named_with_its_extra():
    script = f"""
import sys; sys.modules.update(pandas=None, xarray=None)
import meniscus
try:
    meniscus.network({str(CHIP)!r}, threads=1).measures.to_frame()
except ModuleNotFoundError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "pandas is not installed: pip install pandas, or install meniscus[pandas]\n"


def test_curves_on_the_same_axes_are_told_apart():
    from matplotlib.colors import to_rgb
    from matplotlib.figure import Figure

    drained = [meniscus.network(CHIP, angle_deg=angle, **ENDS) for angle in (0, 40)]
    ax = Figure().subplots()
    for result in drained:
        result.plot(ax=ax, label=f"{result.measures['pores']:.0f} pores")
    for _ in range(10):
        drained[0].plot(ax=ax)
    looks = [(to_rgb(line.get_color()), line.get_linestyle()) for line in ax.lines]
    assert len(looks) == len(set(looks)) == 12
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert len(names) == len(set(names)) and names[:4] == ["47 pores", "47 pores (2)", "drainage", "drainage (2)"]
    cycle = meniscus.network(CHIP, process="cycle", **ENDS)
    axes = cycle.plot(ax=Figure().subplots(), label="wet")
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["wet, primary drainage", "wet, imbibition"]


def test_ticks_of_small_pictures_do_not_overlap():
    from matplotlib.figure import Figure

    chip = meniscus.network(CHIP, threads=1)
    figure = Figure(figsize=(8, 2), layout="constrained")
    for ax in figure.subplots(1, 4):
        chip.plot("picture", ax=ax, label="chip")
        figure.canvas.draw()
        boxes = [label.get_window_extent() for label in ax.get_xticklabels() if label.get_text()]
        assert len(boxes) >= 2 and all(left.x1 < right.x0 for left, right in pairwise(boxes))
        assert ax.get_xlabel() == "x (mm)" and ax.get_title() == "chip"
        assert ax.get_xlim()[1] < 0.02, "the axes are in m"
