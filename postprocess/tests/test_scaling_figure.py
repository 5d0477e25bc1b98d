"""The figure of the scaling benchmark, from a table made here."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import scaling_figure

TABLE = """particles,threads,steps,step_us,neighbors_us,forces_us,pressure_us,move_us,bytes_per_particle
100489,1,10,9.5,1.0,2.0,5.0,1.0,900
10000,1,100,9.0,1.0,2.0,4.5,1.0,900
10000,2,100,5.0,0.6,1.1,2.5,0.6,900
"""


class ScalingFigure(unittest.TestCase):
    """A table of two sizes and two numbers of threads."""

    def setUp(self) -> None:
        """Writes the table."""
        self.folder = tempfile.TemporaryDirectory()
        self.table = Path(self.folder.name) / "scaling.csv"
        self.table.write_text(TABLE, encoding="utf-8")

    def tearDown(self) -> None:
        """Removes it."""
        self.folder.cleanup()

    def test_rows_are_told_apart_by_threads_and_ordered_by_size(self) -> None:
        """One thread has both sizes, the smaller one first."""
        found = scaling_figure.measure(self.table)
        self.assertEqual([row["particles"] for row in found[1]], [10000.0, 100489.0])
        self.assertEqual([row["step_us"] for row in found[2]], [5.0])

    def test_the_figure_is_drawn(self) -> None:
        """As a file with something in it."""
        picture = Path(self.folder.name) / "scaling.svg"
        scaling_figure.draw(scaling_figure.measure(self.table), picture)
        self.assertGreater(picture.stat().st_size, 2000)


if __name__ == "__main__":
    unittest.main()
