"""The arrows of forces and the figure of hysteresis, on small folders. `python -m unittest discover -s tests`."""

import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

import numpy as np  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

import force_arrows  # noqa: E402
import hysteresis  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent))
import started  # noqa: E402
import synthetic  # noqa: E402

TABLE = """run,liquid,tension,advancing,receding,status,advancing-angle-deg,receding-angle-deg
a,n-hexane,0.018,50,40,done,51,39
b,n-octane,0.022,60,50,done,59.5,50.5
c,n-nonane,0.024,65,55,failed,,
"""


class Forces(unittest.TestCase):
    """Arrows of forces."""

    def test_the_sums_are_those_of_the_fluid_and_the_picture_is_drawn(self):
        """Volumes times forces, solids left out."""
        with tempfile.TemporaryDirectory() as temporary:
            directory = Path(temporary) / "out"
            synthetic.write(directory)
            found = force_arrows.measure(directory)
            data = force_arrows.results.read(force_arrows.results.frame_at(directory / "particles.pvd", None).file).point_data
            fluid = np.asarray(data["phase"]) < 2
            volume = np.asarray(data["volume"])[fluid]
            for name, total in found["sums"].items():
                expected = (volume[:, None] * np.asarray(data[name])[fluid][:, :2]).sum(axis=0)
                np.testing.assert_allclose(total, expected, atol=1e-12)
            picture = Path(temporary) / "forces.png"
            done = started.run("force_arrows.py", directory, "--picture", picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(plt.imread(picture).ndim, 3)

    def test_arrows_are_a_share_of_the_particles_that_feel_a_force(self):
        """The same ones each time, and none where there is no force."""
        force = np.zeros((1000, 2))
        force[100:600, 0] = 5.0
        force[600:, 1] = 0.01
        chosen = force_arrows.felt(force, 0.5)
        self.assertTrue(((chosen >= 100) & (chosen < 600)).all())
        # Half of 500, with a scatter of eleven.
        self.assertLess(abs(len(chosen) - 250), 45)
        np.testing.assert_array_equal(chosen, force_arrows.felt(force, 0.5))
        self.assertEqual(len(force_arrows.felt(np.zeros((10, 2)), 1.0)), 0)


class Hysteresis(unittest.TestCase):
    """Angles of experiment and simulation."""

    def test_complete_runs_are_read_and_drawn(self):
        """The failed run is left out; two points have the slope of the line through them."""
        with tempfile.TemporaryDirectory() as temporary:
            directory = Path(temporary)
            (directory / "table.csv").write_text(TABLE, encoding="utf-8")
            found = hysteresis.measure(directory)
            np.testing.assert_allclose(found["tension"], [0.018, 0.022])
            np.testing.assert_allclose(found["advancing-angle-deg"], [51, 59.5])
            self.assertAlmostEqual(found["slopes"]["receding"], 2500.0)
            picture = directory / "hysteresis.png"
            done = started.run("hysteresis.py", directory, "--picture", picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(plt.imread(picture).ndim, 3)
            (directory / "table.csv").write_text(TABLE.replace("done", "to do"), encoding="utf-8")
            self.assertNotEqual(started.run("hysteresis.py", directory).returncode, 0)


if __name__ == "__main__":
    unittest.main()
