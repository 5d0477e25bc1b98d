"""Runs each script on a small folder made here, whole and spoiled. `python -m unittest discover -s tests`."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

import numpy as np  # noqa: E402
import pyvista as pv  # noqa: E402

import angle_and_saturation  # noqa: E402
import check_output  # noqa: E402
import compare_picture  # noqa: E402
import field_picture  # noqa: E402
import movie  # noqa: E402
import results  # noqa: E402
import scene  # noqa: E402
import small_pieces  # noqa: E402
import spreading  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent))
import started  # noqa: E402
import synthetic  # noqa: E402


class Scripts(unittest.TestCase):
    """Every test has its own fresh folder."""

    def setUp(self):
        """Writes the folder."""
        self.temporary = tempfile.TemporaryDirectory()
        self.directory = Path(self.temporary.name) / "out"
        synthetic.write(self.directory)

    def tearDown(self):
        """Removes the folder."""
        self.temporary.cleanup()

    def problems(self) -> str:
        """What the check says, in one text."""
        return "\n".join(check_output.measure(self.directory)["problems"])

    def test_a_row_of_the_series_that_is_cut_short_does_not_count(self):
        """A run that is killed while it writes leaves the beginning of a row."""
        path = self.directory / "series.csv"
        whole = results.series(path)
        with path.open("a", encoding="utf-8") as file:
            file.write("0.12")
        cut = results.series(path)
        self.assertTrue(all(np.array_equal(cut[name], whole[name], equal_nan=True) for name in whole))

    def run_script(self, script: str, *arguments: str) -> subprocess.CompletedProcess:
        """Runs a script as a user does."""
        return started.run(script, self.directory, *arguments)

    def test_a_whole_folder_passes(self):
        """No problem, and the times are those that were written."""
        found = check_output.measure(self.directory)
        self.assertEqual(found["problems"], [])
        self.assertEqual(found["times"], synthetic.TIMES)
        command = [sys.executable, str(SCRIPTS / "check_output.py"), str(self.directory)]
        self.assertEqual(subprocess.run(command, capture_output=True, check=False).returncode, 0)

    def test_of_several_folders_the_wrong_one_is_named(self):
        """One start of the script reads them all."""
        with tempfile.TemporaryDirectory() as other:
            synthetic.write(Path(other))
            (Path(other) / "solid.vtu").unlink()
            found = self.run_script("check_output.py", other)
            self.assertEqual(found.returncode, 1)
            self.assertIn(f"{self.directory}: 3 times", found.stdout)
            self.assertIn(f"{other}: solid.vtu is missing", found.stdout)

    def test_a_lost_file_is_found(self):
        """A listed file that is missing."""
        (self.directory / "grid" / "000001.vtu").unlink()
        self.assertIn("000001.vtu is listed in grid.pvd but missing", self.problems())
        self.assertEqual(self.run_script("check_output.py").returncode, 1)

    def test_a_file_that_no_collection_lists_is_found(self):
        """As after a restart that forgot a time."""
        source = self.directory / "particles" / "000001.vtu"
        (self.directory / "particles" / "000009.vtu").write_bytes(source.read_bytes())
        self.assertIn("000009.vtu is not listed", self.problems())

    def test_a_doubled_time_is_found(self):
        """As after a restart that wrote a time twice."""
        collection = self.directory / "interface.pvd"
        collection.write_text(collection.read_text().replace('timestep="0.001"', 'timestep="0.0"'))
        self.assertIn("the times do not ascend", self.problems())

    def test_missing_arrays_and_values_that_are_not_finite_are_found(self):
        """Both in one file of particles."""
        path = self.directory / "particles" / "000002.vtu"
        data = pv.read(path)
        data.point_data["pressure"][3] = float("nan")
        del data.point_data["line-force"]
        data.save(path)
        self.assertIn("pressure is not finite at 1 of 400 points", self.problems())
        self.assertIn("the array line-force is missing", self.problems())

    def test_angles_are_measured_and_drawn_beside_the_requested_one(self):
        """The requested angle comes from the report."""
        found = angle_and_saturation.measure(self.directory)
        self.assertAlmostEqual(found["requested-angle"], 40.0)
        self.assertAlmostEqual(found["last-angle"], 41.0)
        self.draws("angle_and_saturation.py", "--picture", "figure.png")

    def test_the_requested_angle_is_found_in_the_text_of_a_case(self):
        """The report may hold the resolved case as text; a case without an angle has none."""
        text = "[sph.wetting.young]\ncontact-angle-deg = 72.5 # through the oil\n"
        self.assertEqual(results.requested_angle(text), 72.5)
        self.assertIsNone(results.requested_angle({"title": "Flow between plates", "end": 1.0}))

    def test_a_field_is_drawn(self):
        """The pressure of the last time, and the speed of another."""
        found = field_picture.measure(self.directory)
        self.assertAlmostEqual(found["max"], 0.03 / (6.0 * synthetic.SPACING))
        self.draws("field_picture.py", "--picture", "figure.png")
        self.draws("field_picture.py", "--picture", "speed.png", "--field", "velocity", "--time", "0.001")

    def test_points_are_linked_to_pieces(self):
        """A row of three, one apart, and one whose neighbor is just too far."""
        points = np.array([[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [1.5, 0.0, 0.0], [3.0, 0.0, 0.0], [6.7, 0.0, 0.0]])
        piece = small_pieces.pieces(points, 1.6)
        self.assertEqual([int(np.sum(piece == number)) for number in piece], [3, 1, 3, 3, 1])

    def test_caps_are_continued_to_the_wall(self):
        """A circle and a parabola of known base and angle, seen from a fifth of their height on."""
        angles = np.linspace(0.2, 0.4, 30) * np.pi
        circle = np.column_stack([np.cos(angles), np.sin(angles) - 0.5])
        base, angle = spreading.cap(circle, is_film=False)
        self.assertAlmostEqual(base, 2.0 * np.cos(np.pi / 6.0))
        self.assertAlmostEqual(angle, 60.0)
        x = np.linspace(-0.8, 0.7, 30)
        base, angle = spreading.cap(np.column_stack([x, 0.5 * (1.0 - x**2)]), is_film=True)
        self.assertAlmostEqual(base, 2.0)
        self.assertAlmostEqual(angle, 45.0)
        self.draws("spreading.py", "--picture", "spreading.png", "--above", "0.0")

    def test_levels_are_passed_between_records(self):
        """A base that grows, an angle that falls, and a level that is never met."""
        times = np.array([0.0, 1.0, 3.0])
        self.assertAlmostEqual(spreading.passing(times, np.array([1.0, 2.0, 4.0]), 3.0), 2.0)
        self.assertAlmostEqual(spreading.passing(times, np.array([4.0, 2.0, 3.0]), 3.0), 0.5)
        self.assertTrue(np.isnan(spreading.passing(times, np.array([1.0, 2.0, 2.5]), 3.0)))
        asked = ["--through-base", "1.0", "--through-angle", "30", "--at", "0.001"]
        self.draws("spreading.py", "--picture", "spreading.png", "--above", "0.0", *asked)

    def test_pictures_are_taken_out_of_the_page_of_a_comparison(self):
        """Those in figures, not the diagram before them."""
        page = "<svg>diagram</svg><figure><svg>one</svg></figure>\n<figure><svg>two\n</svg></figure>"
        (self.directory / "compare.html").write_text(page)
        self.assertEqual(compare_picture.measure(self.directory)["pictures"], ["<svg>one</svg>", "<svg>two\n</svg>"])
        (self.directory / "compare.html").write_text("<svg>diagram</svg>")
        with self.assertRaises(ValueError):
            compare_picture.measure(self.directory)

    def test_movies_are_made(self):
        """One range for all frames, all formats."""
        found = movie.measure(self.directory)
        self.assertEqual(len(found["frames"]), 3)
        self.assertAlmostEqual(found["max"], 0.03 / (4.0 * synthetic.SPACING))
        self.draws("movie.py", "--movie", "movie.gif", "--size", "320")
        self.draws("movie.py", "--movie", "movie.mp4")
        self.draws("movie.py", "--movie", "movie.webp", "--size", "320")

    def test_later_frames_show_the_same_section(self):
        """The domain stays beside the color bar."""
        frame = results.frames(self.directory / "grid.pvd")[0]
        plotter = scene.plotter(self.directory, frame, 640)
        shots = []
        for _ in range(2):
            scene.draw(plotter, self.directory, frame, "pressure", (0.0, 1.0))
            shots.append(plotter.screenshot(return_img=True).astype(int))
        plotter.close()
        changed = np.abs(shots[1] - shots[0]).max(axis=2) > 20
        self.assertLess(changed.mean(), 0.01)

    def draws(self, script: str, option: str, name: str, *more: str):
        """The script ends well and leaves a file of more than a few bytes."""
        target = self.directory / name
        done = self.run_script(script, option, str(target), *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(target.stat().st_size, 2000)


if __name__ == "__main__":
    unittest.main()
