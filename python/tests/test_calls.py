"""Interrupts, progress, threads, and errors."""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import pytest
from conftest import DROP, DROP_SET, ROOT, assert_same_bits

import meniscus

# Steps for minutes.
LONG = {"sph.spacing": 5e-5, "expect": [], "time.end": 1.0, "output.series.every-time": 0.1, "output.vtk.every-time": 0.1}
INTERRUPTED = """
import sys, time, meniscus
def tell(share, text):
    if "step" in text:
        print("stepping", flush=True)
try:
    meniscus.run(sys.argv[1], set={changes!r}, out=sys.argv[2] or None, progress=tell)
except KeyboardInterrupt:
    print("stopped", flush=True)
"""


def heed_interrupts():
    """A process that was started in the background ignores them, and so do those that it starts."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize("writes", [False, True])
@pytest.mark.skipif(os.name == "nt", reason="a process cannot be interrupted alone")
def test_an_interrupt_stops_a_run_after_its_step(tmp_path, writes):
    out = str(tmp_path / "out") if writes else ""
    script = INTERRUPTED.replace("{changes!r}", repr(LONG))
    command = [sys.executable, "-c", script, str(DROP), out]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, preexec_fn=heed_interrupts) as process:
        assert process.stdout.readline() == "stepping\n"
        process.send_signal(signal.SIGINT)
        begun = time.monotonic()
        rest = process.stdout.read()
        assert process.wait() == 0 and rest.endswith("stopped\n")
    # Much more than a step takes.
    assert time.monotonic() - begun < 20
    if writes:
        assert (tmp_path / "out/restart/state.bin").exists()
        with pytest.raises(meniscus.FolderError, match="not empty"):
            meniscus.run(DROP, set=LONG, out=out)
        with pytest.raises(RuntimeError, match="enough"):
            meniscus.run(DROP, set=LONG, out=out, resume=True, progress=enough)


def enough(share: float, text: str) -> None:
    """Stops a run by an error."""
    raise RuntimeError("enough")


def test_what_the_progress_function_raises_stops_the_run():
    with pytest.raises(RuntimeError, match="enough"):
        meniscus.run(DROP, set=LONG, progress=enough)


def test_progress_ends_at_one_and_other_threads_go_on():
    told, counted = [], []
    is_done = threading.Event()

    def count():
        while not is_done.is_set():
            counted.append(None)
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    meniscus.run(DROP, set=DROP_SET | {"time.end": 1e-3}, progress=lambda share, text: told.append((share, text)))
    is_done.set()
    counter.join()
    shares = [share for share, _ in told]
    assert shares == sorted(shares) and told[-1] == (1.0, "done")
    assert len(counted) > 10

    class Bar:
        total, n = 50, 0

        def update(self, by):
            self.n += by

        def set_postfix_str(self, text, refresh):
            self.text = text

    bar = Bar()
    meniscus.run(DROP, set=DROP_SET, progress=bar)
    assert abs(bar.n - 50) < 1e-9 and bar.text == "done"


def test_two_runs_at_once_are_those_of_one():
    angles = (60.0, 110.0)
    found = {}

    def run(angle):
        found[angle] = meniscus.run(DROP, set=DROP_SET | {"sph.wetting.young.contact-angle-deg": angle})

    threads = [threading.Thread(target=run, args=(angle,)) for angle in angles]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for angle in angles:
        alone = meniscus.run(DROP, set=DROP_SET | {"sph.wetting.young.contact-angle-deg": angle})
        for name, column in alone.series.items():
            assert_same_bits(found[angle].series[name], column, name)
    assert found[60.0].series["contact_angle_deg"][-1] != found[110.0].series["contact_angle_deg"][-1]


def test_a_bad_file_is_refused_with_all_mistakes_and_places(tmp_path):
    text = DROP.read_text().replace("contact-angle-deg = 60.0", "contact-angle-deg = 600.0")
    path = tmp_path / "bad.toml"
    path.write_text(text + "\n[surplus]\nkey = 1\n")
    with pytest.raises(meniscus.CaseError) as caught:
        meniscus.run(path)
    error = caught.value
    assert len(error.mistakes) >= 2 and isinstance(error, ValueError)
    angle = error.mistakes[0]
    assert angle.file == str(path) and "600" in angle.message
    assert text.splitlines()[angle.line - 1].startswith("contact-angle-deg")
    assert f"{path}:{angle.line}:{angle.column}: {angle.message}" in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.mistakes == error.mistakes
    with pytest.raises(meniscus.CaseError, match="there is no file"):
        meniscus.run(tmp_path / "absent.toml")


def test_a_bad_dict_and_bad_changes_are_refused_by_key():
    with pytest.raises(meniscus.CaseError) as caught:
        meniscus.run({"format": 1, "title": "t", "geometry": {"min": [0, 0], "max": [1e-3, -1e-3]}, "network": {}})
    assert {mistake.key for mistake in caught.value.mistakes} >= {"geometry.max"}, str(caught.value)
    shapes = [{"disc": {"center": [0, y], "radius": radius}} for y, radius in ((0, 1e-3), (1, -1.0))]
    with pytest.raises(meniscus.CaseError, match="above 0") as caught:
        meniscus.network({"format": 1, "min": [-1, -1], "max": [1, 2], "solid": "inside", "shapes": shapes})
    assert [mistake.key for mistake in caught.value.mistakes] == ["shapes[1].disc.radius"], str(caught.value)
    with pytest.raises(meniscus.CaseError, match=r"sph.spacing: expected .* above 0") as caught:
        meniscus.run(DROP, set={"sph.spacing": -1})
    assert (caught.value.key, caught.value.file) == ("sph.spacing", None)
    with pytest.raises(meniscus.CaseError, match="expected a finite number") as caught:
        meniscus.run(DROP, set={"sph.spacing": float("nan")})
    assert caught.value.key == "sph.spacing"
    with pytest.raises(meniscus.CaseError, match="found None"):
        meniscus.run({"format": 1, "title": None})


def test_bad_parameters_of_a_network_are_refused_by_name():
    chip = ROOT / "geometries/chip.svg"
    with pytest.raises(meniscus.CaseError) as caught:
        meniscus.network(chip, inlet="left", outlet="right", angle_deg=400)
    assert caught.value.key == "angle_deg" and "400" in caught.value.message
    with pytest.raises(meniscus.CaseError, match=r"^inlet: unknown variant `west`, expected one of `left`"):
        meniscus.network(chip, inlet="west")
    with pytest.raises(meniscus.CaseError, match="unit"):
        meniscus.network(chip, unit="parsec")


def test_a_check_tells_what_a_run_takes():
    found = meniscus.check(DROP, set=DROP_SET)
    assert found.unknowns > 100 and found.steps >= 1 and found.time_step_s > 0
    assert isinstance(found.warnings, list)
    with pytest.raises(meniscus.CaseError):
        meniscus.check(DROP, set={"time.end": -1})


def test_a_missed_expectation_is_a_result():
    expect = [{"measure": "contact-angle-deg", "value": 0.0, "tolerance": 1.0}]
    result = meniscus.run(DROP, set=DROP_SET | {"expect": expect})
    assert result.status == "expectation-failed" and result.report["expectations"][0]["pass"] is False
