"""The page of the tutorial: its code runs."""

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
    told = re.search(r"print\(error\)  # (.*)", page).group(1)
    assert told in printed and "302.1 Pa" in printed and "[60. 90.]" in printed
