"""Studies by executors."""

import multiprocessing
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from conftest import DROP, STUDY, assert_same_bits

import meniscus


def table(folder):
    """The table that the study wrote."""
    return (folder / "table.csv").read_text()


def test_two_processes_do_the_runs_of_a_study(study, tmp_path, program):
    told = []
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as executor:
        found = meniscus.study(study, executor, out=tmp_path / "two", progress=lambda *one: told.append(one))
    assert [sample.status for sample in found] == ["done", "done"]
    assert np.array_equal(found.column("angle"), [60.0, 90.0])
    assert found.table()["contact-angle-deg"].shape == (2,) and told[-1][0] == 1.0
    assert found[0].measures["contact-angle-deg"].unit == "deg"
    assert (found[1].folder / "report.json").exists() and (found.folder / "report.html").exists()
    alone = meniscus.study(study, out=tmp_path / "alone")
    assert table(tmp_path / "alone") == table(tmp_path / "two")
    again = meniscus.study(study, ThreadPoolExecutor(2), out=tmp_path / "two")
    for sample, other in zip(again, alone, strict=True):
        assert repr(sample.measures) == repr(other.measures) and list(sample.measures) == list(other.measures)
        assert_same_bits(np.array([*sample.measures.values()]), np.array([*other.measures.values()]), sample.name)


def test_processes_that_are_copies_of_this_one_do_runs_after_it_did_some(study, tmp_path):
    if "fork" not in multiprocessing.get_all_start_methods():
        pytest.skip("processes are not copied here")
    meniscus.run(DROP, set={"sph.spacing": 1e-4, "time.end": 1e-4, "expect": []})
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("fork")) as executor:
        found = meniscus.study(study, executor, out=tmp_path / "out")
    assert [sample.status for sample in found] == ["done", "done"]


def test_a_bad_value_is_refused_before_anything_runs(study, tmp_path):
    study.write_text(STUDY.format(case=DROP.as_posix(), values="60.0, 900.0"))
    with pytest.raises(meniscus.CaseError, match="900") as caught:
        meniscus.study(study, out=tmp_path / "out")
    assert caught.value.file == str(study) and not (tmp_path / "out").exists()
