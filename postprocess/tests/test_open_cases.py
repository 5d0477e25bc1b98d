"""What the pages say beside other programs, on shapes with known answers. `python -m unittest discover -s tests`."""

import math
import sys
import unittest
from pathlib import Path

import numpy as np

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

import benchmark  # noqa: E402
import kinetic_angles  # noqa: E402
import lattice_passes  # noqa: E402
import open_cases  # noqa: E402
import radial_patterns  # noqa: E402


class OpenCases(unittest.TestCase):
    """Closed forms of drops, menisci, waves and patterns."""

    def test_the_angle_of_a_drop_follows_from_radius_and_area(self):
        """A cap of 60 degrees, and a circle through three of its points."""
        angle, radius = math.radians(60.0), 2.0
        area = radius**2 * (angle - math.sin(angle) * math.cos(angle))
        self.assertAlmostEqual(open_cases.angle_of(radius, area), 60.0, places=6)
        points = radius * np.array([[math.cos(turn), math.sin(turn)] for turn in (0.3, 1.0, 1.9)]) + [1.0, -3.0]
        self.assertAlmostEqual(open_cases.radius_of(points), radius, places=9)

    def test_a_slow_plate_has_the_meniscus_of_rest(self):
        """Its height is the square root of 2 (1 - sin 60 degrees), in capillary lengths."""
        height = open_cases.resting_height(1e-6, 0.1)
        self.assertAlmostEqual(height, math.sqrt(2.0 * (1.0 - math.sin(math.radians(60.0)))), delta=0.01)

    def test_neighboring_menisci_meet_below_59_degrees(self):
        """At the transition both events need the same curvature."""
        transition = math.degrees(math.atan(0.5 / lattice_passes.RADIUS))
        (below, overlap), (above, burst) = (lattice_passes.closed_form(transition + shift) for shift in (-1e-6, 1e-6))
        self.assertEqual((below, above), ("overlap", "burst"))
        self.assertAlmostEqual(overlap, burst, places=6)

    def test_a_wave_without_viscosity_has_the_frequency_of_lamb(self):
        """After half a period it is upside down."""
        wavenumber, density, tension = 2.0 * math.pi / 2.6e-3, 1000.0, 0.07
        frequency = math.sqrt(tension * wavenumber**3 / (2.0 * density))
        fluids = [(density, 1e-7), (density, 1e-7)]
        self.assertAlmostEqual(benchmark.amplitude(math.pi / frequency, wavenumber, math.inf, fluids, tension), -1.0, delta=0.01)

    def test_points_on_a_line_have_the_box_dimension_one_and_those_of_a_square_two(self):
        """Within a tenth: boxes of 3 to 30 mm do not fit 180 mm exactly."""
        along = np.linspace(0.0, 0.18, 2000)
        line = np.column_stack([along, 0.5 * along])
        square = np.array([[x, y] for x in along[::10] for y in along[::10]])
        for points, dimension in ((line, 1.0), (square, 2.0)):
            self.assertAlmostEqual(radial_patterns.box_dimension(points), dimension, delta=0.1)

    def test_a_law_is_found_again_from_its_own_angles(self):
        """Static angle, jump length and frequency."""
        law = kinetic_angles.Law(80.0, 0.8e-9, 1e6)
        speeds = [1e-4 * 2.0**k for k in range(9)]
        tension = kinetic_angles.TENSION["water"]
        rows = [{"speed_measured_mm_s": str(1e3 * u), "angle_image_deg": str(law.angle(u, tension)), "fluid": "water"} for u in speeds]
        self.assertLess(kinetic_angles.spread(kinetic_angles.fitted(rows), rows), 0.05)


if __name__ == "__main__":
    unittest.main()
