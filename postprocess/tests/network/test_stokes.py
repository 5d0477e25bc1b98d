"""Direct Stokes flow between walls and grains whose permeability is known."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))
from stokes_mesh import Disc, Domain
from stokes_permeability import Plates, permeability

PERIODIC = ("periodic", "periodic")


def unit(grains: list, sides: tuple[str, str]) -> Domain:
    """A unit box."""
    return Domain(np.zeros(2), np.ones(2), grains, sides)


class Stokes(unittest.TestCase):
    """Elements of second order on coarse meshes."""

    def test_square_arrays_have_the_drag_of_sangani_and_acrivos(self):
        """Sangani and Acrivos (1982): drag over viscosity and mean velocity."""
        for solid, drag in [(0.6, 1763.6), (0.3, 102.881)]:
            domain = unit([Disc(np.full(2, 0.5), np.sqrt(solid / np.pi))], PERIODIC)
            found = permeability(domain, 4)
            for axis in (0, 1):
                self.assertAlmostEqual(found[axis][axis] * drag, 1, delta=5e-3)
                self.assertAlmostEqual(found[axis][1 - axis] * drag, 0, delta=5e-3)

    def test_a_slit_has_a_twelfth_of_its_width_squared(self):
        """A parabola is exact for elements of second order, whether sides are periodic or open."""
        for side in ("periodic", "open"):
            found = permeability(unit([], (side, "wall")), 4)
            self.assertEqual(list(found), [0])
            self.assertAlmostEqual(found[0][0] * 12, 1, delta=1e-9)

    def test_a_slit_between_floor_and_lid_has_a_profile_of_exponentials(self):
        """K = b2/12 (1 - tanh z/z) with z = sqrt(3/alpha)/b for a width of 1."""
        depth, factor = 0.5, 1.2
        z = np.sqrt(3 / factor) / depth
        found = permeability(unit([], ("periodic", "wall")), 16, Plates(12 / depth**2, factor))
        self.assertAlmostEqual(found[0][0] / (depth**2 / 12 * (1 - np.tanh(z) / z)), 1, delta=1e-5)

    def test_overlapping_grains_are_refused(self):
        """No mesh fits to walls that cross."""
        with self.assertRaisesRegex(ValueError, "mesh"):
            permeability(unit([Disc(np.array([x, 0.5]), 0.2) for x in (0.4, 0.7)], PERIODIC), 3)


if __name__ == "__main__":
    unittest.main()
