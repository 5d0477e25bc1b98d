"""The page of the tutorial: its code runs and prints what the page tells."""

import re

import pytest
from conftest import ROOT, STUDY


def test_the_code_of_the_tutorial_runs(tmp_path, monkeypatch, capsys):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    for folder in ("cases", "geometries"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    (tmp_path / "angles.toml").write_text(STUDY.format(case="cases/sessile-drop.toml", values="60.0, 90.0"))
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs/tutorials/python.md").read_text()
    code = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    names = {"__name__": "__main__"}
    for block in code:
        exec(block, names)
    assert (tmp_path / "curve.png").stat().st_size > 2000 and (tmp_path / "picture.png").stat().st_size > 2000
    printed = capsys.readouterr().out
    # What stands behind a print is printed, up to three points.
    told = [text.split("...")[0].strip() for text in re.findall(r"print\(.*\)  # (.*)", page)]
    assert len(told) >= 6 and "302.1 Pa" in told
    assert [text for text in told if text not in printed] == [], printed
