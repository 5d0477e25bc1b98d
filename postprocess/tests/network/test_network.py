"""OpenPNM and PoreSpy on the network of the pack in crates/drawings/tests/drawings. Needs the packages of requirements-network.txt."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))
import synthetic_network

import network_to_openpnm
import snow2_compare


class OpenPnm(unittest.TestCase):
    """What OpenPNM finds on a network that was drained by a loop over all throats."""

    @classmethod
    def setUpClass(cls):
        """One folder for all."""
        cls.directory = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.directory.name)
        synthetic_network.make(cls.folder)
        cls.found = network_to_openpnm.measure(cls.folder)

    @classmethod
    def tearDownClass(cls):
        """Removes it."""
        cls.directory.cleanup()

    def test_the_same_pores_are_invaded_at_the_same_pressure_and_in_the_same_order(self):
        """Both programs follow one rule; pores at the inlet, all at pressure 0, come first in any order."""
        self.assertGreater(self.found["invaded"], 50)
        self.assertTrue(self.found["same_set"])
        self.assertEqual(self.found["same_pressure_share"], 1.0)
        self.assertGreater(self.found["order_correlation"], 0.999)

    def test_stokes_flow_gives_the_permeability_of_a_dense_solve(self):
        """Both solve one linear system; 1e-9 is above their rounding."""
        self.assertAlmostEqual(self.found["permeability"] / self.found["permeability_ours"], 1.0, delta=1e-9)

    def test_a_pore_that_is_invaded_too_late_is_seen(self):
        """The comparison is one of pores, not of curves."""
        ours = network_to_openpnm.table(self.folder / "pores.csv")
        ours["invasion_capillary_pressure_Pa"] = ours["invasion_capillary_pressure_Pa"].copy()
        pore = int(np.nanargmax(ours["sequence"])) // 2
        self.assertGreater(ours["invasion_capillary_pressure_Pa"][pore], 0.0)
        ours["invasion_capillary_pressure_Pa"][pore] *= 1.01
        openpnm, network = network_to_openpnm.load(self.folder)
        found = network_to_openpnm.compare(network_to_openpnm.drain_at(openpnm, network, ours), ours, len(ours["x_m"]))
        self.assertAlmostEqual(found["same_pressure_share"], 1.0 - 1.0 / len(ours["x_m"]))

    def test_labels_that_are_numbers_are_refused(self):
        """OpenPNM would read them as values and find no inlet."""
        with tempfile.TemporaryDirectory() as other:
            synthetic_network.make(Path(other))
            file = Path(other) / "openpnm.csv"
            text = file.read_text(encoding="utf-8").replace("True", "1").replace("False", "0")
            file.write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(ValueError, "pore.inlet is no label"):
                network_to_openpnm.load(Path(other))

    def test_a_network_of_more_pores_than_throats_loads(self):
        """Three pores in a row: the last row of the throats is empty."""
        with tempfile.TemporaryDirectory() as other:
            names = ["pore.coords[0]", "pore.coords[1]", "pore.coords[2]", "pore.boundary", "pore.inlet", "pore.outlet"]
            names += ["throat.conns[0]", "throat.conns[1]", "throat.boundary"]
            ends = [["False"] * 3, ["True", "True", "False"], ["True", "False", "True"]]
            links = [["0", "1", "True"], ["0", "2", "True"], ["", "", ""]]
            lines = [[str(k), "0", "0", *ends[k], *links[k]] for k in range(3)]
            text = "\n".join(",".join(line) for line in [names, *lines])
            (Path(other) / "openpnm.csv").write_text(text + "\n", encoding="utf-8")
            _, network = network_to_openpnm.load(Path(other))
            self.assertEqual(network["throat.conns"].tolist(), [[0, 1], [0, 2]])
            self.assertEqual(network.num_pores("inlet"), 1)

    def test_the_table_and_the_picture_are_made(self):
        """Every row has its three fields."""
        rows = network_to_openpnm.rows(self.found)
        self.assertTrue(all(len(row) == 3 for row in rows))
        picture = self.folder / "openpnm.png"
        network_to_openpnm.draw(self.found, picture)
        self.assertGreater(picture.stat().st_size, 2000)


class Snow2(unittest.TestCase):
    """What PoreSpy finds in an image of the pack."""

    @classmethod
    def setUpClass(cls):
        """One extraction for all."""
        cls.directory = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.directory.name)
        synthetic_network.make(cls.folder)
        # The pack of the image stands in a closed box.
        file = cls.folder / "network.json"
        about = json.loads(file.read_text(encoding="utf-8")) | {"inlet": None, "outlet": None}
        file.write_text(json.dumps(about), encoding="utf-8")
        cls.found = snow2_compare.measure(cls.folder, synthetic_network.DRAWINGS / "pack-grey.png")

    @classmethod
    def tearDownClass(cls):
        """Removes it."""
        cls.directory.cleanup()

    def test_the_image_is_the_pack(self):
        """Porosity within half a percent at these pixels; a turned or mirrored image would leave few pores matched."""
        self.assertAlmostEqual(self.found["image_porosity"], self.found["porosity"], delta=0.005)
        self.assertGreater(self.found["matched"], 0.6)

    def test_both_networks_are_of_one_size(self):
        """At 8 pixels a throat snow2 joins pores as a persistence ratio of 0.95 does: 82 of the 106 are left then."""
        joined = {row[0]: row[1] for row in synthetic_network.reference()["closed"]["merged"]}
        self.assertLess(abs(len(self.found["snow2"]["radius"]) / joined[0.95] - 1.0), 0.1)

    def test_exact_throats_are_never_wider_than_a_pore(self):
        """A saddle lies below both maxima."""
        self.assertEqual(self.found["ours"]["wider"], 0.0)

    def test_periodic_images_are_repeated_around_the_domain(self):
        """Around the domain stands half of it on each side; the pixels of the domain are found again in the middle."""
        about = {"periodic": [True, True], "inlet": None, "outlet": None}
        image, before = snow2_compare.extended(self.found["image"], about)
        self.assertEqual(image.shape, tuple(2 * n for n in self.found["image"].shape))
        inner = image[before[0] :, before[1] :][: self.found["image"].shape[0], : self.found["image"].shape[1]]
        self.assertTrue(np.array_equal(inner, self.found["image"]))

    def test_the_table_and_the_picture_are_made(self):
        """Every row has its three fields."""
        self.assertTrue(all(len(row) == 3 for row in snow2_compare.rows(self.found)))
        picture = self.folder / "snow2.png"
        snow2_compare.draw(self.found, picture)
        self.assertGreater(picture.stat().st_size, 2000)


if __name__ == "__main__":
    unittest.main()
