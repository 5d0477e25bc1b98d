"""Saturation functions from small folders of a network. `python -m unittest discover -s tests`."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

import reservoir_tables  # noqa: E402

EVENTS = """half_cycle,process,sequence,event,throat,capillary_pressure_Pa,saturation,film_saturation
1,drainage,0,beginning,,,0.9,0.1
1,drainage,1,burst,0,2000,0.05,0.05
2,imbibition,0,beginning,,,0.12,0.02
2,imbibition,1,burst,0,1500,0.33,0.03
2,imbibition,2,snap-off,1,1400,0.35,0.05
2,imbibition,3,burst,2,1400,0.62,0.02
2,imbibition,4,overlap,3,-300,0.81,0.01
"""

# The second state is that of the beginning, without a pressure; the fourth and the fifth are one.
RELATIVE = """saturation,relative_permeability_wetting,relative_permeability_non_wetting
0,0,1
0.1,0,0.8
0.3,0.1,0.5
0.6,0.09999999,0.50000001
0.6,0.09999999,0.50000001
0.8,0.25,0.125
"""


def write(folder: Path, outlet: str | None = "right") -> None:
    """What the script reads of a run."""
    half_cycles = [{"saturation_before": 1.0}, {"saturation_before": 0.05}]
    about = {"inlet": "left", "outlet": outlet, "half_cycles": half_cycles}
    (folder / "network.json").write_text(json.dumps(about), encoding="utf-8")
    (folder / "events.csv").write_text(EVENTS, encoding="utf-8")
    (folder / "relative_permeability.csv").write_text(RELATIVE, encoding="utf-8")


def rows(path: Path, keyword: str) -> list[list[float]]:
    """The numbers of a keyword: no comments, from its name to the slash."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("--")]
    start, end = lines.index(keyword) + 1, lines.index("/")
    return [[float(number) for number in line.split()] for line in lines[start:end]]


class ReservoirTables(unittest.TestCase):
    """Every test has its own fresh folder."""

    def setUp(self):
        """Writes the folder."""
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        write(self.folder)

    def tearDown(self):
        """Removes the folder."""
        self.temporary.cleanup()

    def run_script(self, *options: str) -> subprocess.CompletedProcess:
        """Runs the script as a user does."""
        command = [sys.executable, str(SCRIPTS / "reservoir_tables.py"), str(self.folder), *options]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_the_tables_are_monotone_with_the_pressures_of_their_events(self):
        """The last half cycle in bar, with films in the saturation, by rising saturation of water and of gas."""
        swof, sgof = self.folder / "swof.inc", self.folder / "sgof.inc"
        done = self.run_script("--swof", str(swof), "--sgof", str(sgof))
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = [
            [0.05, 0.0, 1.0, 0.015],
            [0.35, 0.1, 0.5, 0.014],
            [0.62, 0.1, 0.5, 0.014],
            [0.81, 0.25, 0.125, -0.003],
        ]
        self.assertEqual(rows(swof, "SWOF"), expected)
        for (gas, krg, krog, pressure), row in zip(rows(sgof, "SGOF"), reversed(expected), strict=True):
            self.assertAlmostEqual(gas, 1.0 - row[0])
            self.assertEqual([krog, krg, pressure], row[1:])
        text = swof.read_text(encoding="utf-8")
        self.assertIn("METRIC units: Pcow = p_o - p_w in bar", text)
        self.assertIn("along imbibition 1 of", text)
        self.assertIn("krow is not 0 at the last saturation", text)
        self.assertNotIn("krw is not 0", text)

    def test_without_files_both_are_printed(self):
        """Both keywords."""
        printed = self.run_script().stdout
        self.assertTrue("\nSWOF\n" in printed and "\nSGOF\n" in printed, printed)

    def test_runs_without_an_outlet_or_in_time_are_refused(self):
        """With what they lack."""
        write(self.folder, outlet=None)
        self.assertIn("need an outlet", self.run_script().stderr)
        write(self.folder)
        (self.folder / "relative_permeability.csv").unlink()
        self.assertIn("quasi-static", self.run_script().stderr)
        self.assertRaises(SystemExit, reservoir_tables.measure, self.folder)


if __name__ == "__main__":
    unittest.main()
