"""Figures of the documentation from a study folder made here. `python -m unittest discover -s tests`."""

import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

from matplotlib import pyplot as plt  # noqa: E402

import gallery_figures  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent))
import started  # noqa: E402

TABLE = """run,spacing,status,error,unknowns
spacing=2,2,done,0.1,100
spacing=1,1,done,0.1,400
spacing=0.5,0.5,failed,,1600
"""


class Gallery(unittest.TestCase):
    """Every test has its own fresh folder."""

    def setUp(self):
        """Writes a study folder of three runs, one of which failed."""
        self.temporary = tempfile.TemporaryDirectory()
        self.directory = Path(self.temporary.name) / "study-rise"
        self.directory.mkdir()
        (self.directory / "table.csv").write_text(TABLE, encoding="utf-8")
        (self.directory / "curve-1.svg").write_text("<svg/>", encoding="utf-8")
        for spacing in ("2", "1", "0.5"):
            run = self.directory / "runs" / f"spacing={spacing}"
            run.mkdir(parents=True)
            plt.imsave(run / "picture.png", [[0.0, 1.0], [1.0, 0.0], [0.0, 0.0]])

    def tearDown(self):
        """Removes the folder."""
        self.temporary.cleanup()

    def test_the_picture_is_that_of_the_finest_complete_run(self):
        """A run can be asked for by its name."""
        found = gallery_figures.measure(self.directory)
        self.assertEqual((found["name"], found["picture"].parent.name), ("rise", "spacing=1"))
        self.assertEqual(gallery_figures.measure(self.directory, "spacing=2")["picture"].parent.name, "spacing=2")

    def test_the_script_writes_curves_and_picture_or_says_that_nothing_is_complete(self):
        """As a user runs it."""
        figures = self.directory.parent / "figures"
        command = ["gallery_figures.py", self.directory, "--figures", figures]
        done = started.run(*command, "--width", "100")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((figures / "rise-1.svg").read_text(encoding="utf-8"), "<svg/>")
        self.assertEqual(plt.imread(figures / "rise-picture.webp").shape[:2], (150, 100))
        refused = started.run(*command, "--run", "spacing=0.5")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("no complete run spacing=0.5", refused.stderr)


if __name__ == "__main__":
    unittest.main()
