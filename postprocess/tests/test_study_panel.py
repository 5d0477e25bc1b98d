"""The panel of a study, on a small folder made here. `python -m unittest discover -s tests`."""

import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

from matplotlib import pyplot as plt  # noqa: E402

import study_panel  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent))
import started  # noqa: E402

TABLE = """run,angle,spacing,status,contact-angle-deg
angle=40_spacing=1e-5,40,1e-5,done,41.5
angle=60_spacing=1e-5,60,1e-5,failed,
angle=80_spacing=1e-5,80,1e-5,done,80.25
"""


class Panel(unittest.TestCase):
    """Every test has its own fresh folder."""

    def setUp(self):
        """Writes a study folder of three runs, one of which failed."""
        self.temporary = tempfile.TemporaryDirectory()
        self.directory = Path(self.temporary.name)
        (self.directory / "table.csv").write_text(TABLE, encoding="utf-8")
        for angle in (40, 60, 80):
            run = self.directory / "runs" / f"angle={angle}_spacing=1e-5"
            run.mkdir(parents=True)
            plt.imsave(run / "picture.png", [[0.0, 1.0], [1.0, 0.0]])

    def tearDown(self):
        """Removes the folder."""
        self.temporary.cleanup()

    def test_complete_runs_stand_in_their_order_with_their_parameters(self):
        """The failed run is left out."""
        found = study_panel.measure(self.directory)
        self.assertEqual(
            [run["parameters"] for run in found["runs"]],
            [
                {"angle": "40", "spacing": "1e-5"},
                {"angle": "80", "spacing": "1e-5"},
            ],
        )
        self.assertEqual(found["all"], 3)

    def test_the_script_writes_a_figure_or_says_that_nothing_is_complete(self):
        """As a user runs it."""
        picture = self.directory / "panel.png"
        command = ["study_panel.py", self.directory, "--picture", picture]
        done = started.run(*command)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.strip(), str(picture))
        self.assertEqual(plt.imread(picture).ndim, 3)
        (self.directory / "table.csv").write_text(TABLE.replace("done", "to do"), encoding="utf-8")
        refused = started.run(*command)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("is complete yet", refused.stderr)


if __name__ == "__main__":
    unittest.main()
