"""Tables of the validation pages from stored results made here. `python -m unittest discover -s tests`."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

import gallery  # noqa: E402
import gallery_check  # noqa: E402
import gallery_results  # noqa: E402
import gallery_tables  # noqa: E402

STUDY = """# A drop.
title = "A drop"
case = "../cases/drop.toml"

[[axis]]
name = "angle"
values = [60.0, 90.0]

[[expect]]
measure = "contact-angle-deg"
"""

TABLE = """run,angle,spacing,status,contact-angle-deg,contact-angle-deg-uncertainty,height-ratio
a,60,8e-5,done,59.876543219,0.12,0.99
b,60,5e-5,done,60.04,,1.001
c,90,8e-5,done,,,-1e-5
d,90,5e-5,to do,,,
"""

LAYOUTS = """[angles]
studies = ["drop"]
rows = "angle"
cell = "{contact-angle-deg:.2f ±} ({height-ratio - 1:+.1%})"
columns = [
    { head = "angle", cell = "{angle}" },
    { head = "coarse", spacing = 8e-5 },
    { head = "fine", spacing = 5e-5 },
]
"""

PAGE = """# Drop

<!-- results: angles -->
<!-- end of results -->

The end.
"""


class Gallery(unittest.TestCase):
    """Every test has its own fresh folder."""

    def setUp(self):
        """Writes a study, its case, its folder with three complete runs, and a page."""
        self.temporary = tempfile.TemporaryDirectory()
        self.root = Path(self.temporary.name)
        self.out = self.root / "out"
        files = {
            "studies/drop.toml": STUDY,
            "cases/drop.toml": 'format = 1 # one\nfile = "disc.toml"\n',
            "cases/disc.toml": "shapes = []\n",
            gallery.LAYOUTS.as_posix(): LAYOUTS,
            "docs/drop.md": PAGE,
            "out/table.csv": TABLE,
        }
        for run in "abc":
            files[f"out/runs/{run}/report.json"] = json.dumps({"cpu-s": 2.0})
        for name, text in files.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text, encoding="utf-8")

    def tearDown(self):
        """Removes the folder."""
        self.temporary.cleanup()

    def stored(self, settings: dict | None = None) -> str:
        """The stored result after the study has been stored."""
        gallery.store(self.root, "drop", self.out, settings or {})
        return (self.root / gallery.RESULTS / "drop.csv").read_text(encoding="utf-8")

    def test_a_stored_result_tells_command_files_and_all_runs(self):
        """Seven digits of each measure are stored, and the processor time of each complete run."""
        lines = self.stored().splitlines()
        self.assertEqual(lines[0], "# meniscus study run studies/drop.toml")
        self.assertEqual(lines[1], "# 3 of 4 runs, 6.0 s")
        names = [line.split()[-1] for line in lines[2:5]]
        self.assertEqual(names, ["studies/drop.toml", "cases/drop.toml", "cases/disc.toml"])
        self.assertEqual(lines[7], "a,60,8e-5,done,59.87654,0.12,0.99,2")
        self.assertEqual(lines[10], "d,90,5e-5,to do,,,,")
        self.assertEqual(len(lines), 11)

    def test_a_function_of_the_layout_finds_further_columns(self):
        """They are stored beside the measures; what it does not find is empty."""
        settings = {"derived": "gallery_tables.same_run"}
        gallery_tables.same_run = lambda directory, row: {"twice": 2 * float(row["angle"]), "nothing": float("nan")}
        try:
            lines = self.stored(settings).splitlines()
        finally:
            del gallery_tables.same_run
        self.assertTrue(lines[6].endswith(",twice,nothing,cpu-s"))
        self.assertEqual(lines[7], "a,60,8e-5,done,59.87654,0.12,0.99,120,,2")

    def test_a_table_has_error_bars_signs_and_cells_without_a_measure(self):
        """A second write changes nothing, and a changed number is put right."""
        self.stored()
        self.assertEqual(len(gallery.write(self.root)), 1)
        page = self.root / "docs/drop.md"
        text = page.read_text(encoding="utf-8")
        self.assertIn("| 60 | 59.88 ± 0.12 (\u22121.0 %) | 60.04 (+0.1 %) |\n", text)
        self.assertIn("| 90 | none (\u2212100.0 %) |  |\n", text)
        self.assertIn("`meniscus study run studies/drop.toml` (3 of 4 runs, 6.0 s of processor time).", text)
        self.assertTrue(text.endswith("The end.\n"))
        self.assertEqual(gallery.write(self.root), [])
        page.write_text(text.replace("59.88", "60.00"), encoding="utf-8")
        self.assertEqual(gallery.write(self.root, check=True), [page])
        gallery.write(self.root)
        self.assertEqual(page.read_text(encoding="utf-8"), text)

    def test_what_a_study_misses_stands_below_its_table_with_the_reason(self):
        """Without a reason in the layout no page can be written."""
        judged = "run,measure,expected,found,verdict\na,height-ratio,1 ± 0.001,0.99,missed\nb,height-ratio,1 ± 0.001,1.001,met\n"
        (self.out / "expectations.csv").write_text(judged, encoding="utf-8")
        self.assertEqual(self.stored().splitlines()[2], "# missed height-ratio: a: 1 ± 0.001, found 0.99")
        with self.assertRaisesRegex(SystemExit, r"drop misses height-ratio: a: .*\n.*no missed.height-ratio"):
            gallery.write(self.root)
        layouts = self.root / gallery.LAYOUTS
        layouts.write_text(LAYOUTS + '[angles.missed]\nheight-ratio = "It is low."\n', encoding="utf-8")
        gallery.write(self.root)
        text = (self.root / "docs/drop.md").read_text(encoding="utf-8")
        self.assertIn("time).\n\n- **Missed**: `height-ratio` (a: 1 ± 0.001, found 0.99). It is low.\n\n<!-- end", text)
        gallery.stamp_again(self.root, "drop")
        self.assertEqual(gallery.stale(self.root), [])

    def test_a_measure_is_checked_within_its_bar_or_a_relative_difference(self):
        """The cheapest complete run counts; numbers without a unit may differ by rounding."""
        self.stored()
        rows = gallery_results.rows_of(self.root / gallery.RESULTS / "drop.csv")
        number, row = gallery_check.cheapest(rows)
        self.assertEqual((number, row["run"]), (1, "a"))
        units = {"contact-angle-deg": "deg", "height-ratio": ""}

        def differences(**found: str) -> list[str]:
            return gallery_check.differences(row, {name.replace("_", "-"): text for name, text in found.items()}, units, {})

        self.assertEqual(differences(contact_angle_deg="59.99", height_ratio="0.9909", unknown="1.0"), [])
        self.assertEqual(
            differences(contact_angle_deg="60.01", height_ratio="0.9911"),
            [
                "contact-angle-deg was 59.87654, is 60.01 (tolerance 0.12)",
                "height-ratio was 0.99, is 0.9911 (tolerance 0.00099)",
            ],
        )
        self.assertEqual(differences(height_ratio=""), ["height-ratio was 0.99, is none (tolerance the same)"])
        self.assertEqual(gallery_check.differences({"drift": "0"}, {"drift": "1e-10"}, {"drift": ""}, {}), [])
        self.assertEqual(len(gallery_check.differences({"drift": "0"}, {"drift": "1e-10"}, {"drift": "m"}, {})), 1)

    def test_a_stamp_takes_over_an_edit_of_the_case(self):
        """Comments, titles and expectations do not count anyway."""
        before = self.stored()
        study = self.root / "studies/drop.toml"
        study.write_text(STUDY.replace("contact-angle-deg", "height-ratio").replace("A drop", "Drops"), encoding="utf-8")
        self.assertEqual(self.stored(), before)
        (self.root / "cases/disc.toml").write_text("shapes = [1]\n", encoding="utf-8")
        gallery.stamp_again(self.root, "drop")
        after = (self.root / gallery.RESULTS / "drop.csv").read_text(encoding="utf-8").splitlines()
        changed = [new for old, new in zip(before.splitlines(), after, strict=True) if old != new]
        self.assertEqual([line.split()[-1] for line in changed], ["cases/disc.toml"])

    def test_every_layout_is_on_a_page_and_every_table_has_a_layout(self):
        """A check tells the one, and a table without layout ends the script."""
        self.stored()
        layouts = self.root / gallery.LAYOUTS
        layouts.write_text(LAYOUTS + "[more]\n", encoding="utf-8")
        self.assertEqual(gallery.stale(self.root), ["docs/validation/results/tables.toml: no page shows [more]"])
        layouts.write_text("[more]\n", encoding="utf-8")
        with self.assertRaisesRegex(SystemExit, r"tables.toml has no \[angles\]"):
            gallery.write(self.root)

    def test_the_index_lists_each_case_and_study_with_its_section(self):
        """A section of a validation page, the title of another page, or neither."""
        self.stored()
        files = {
            "docs/SUMMARY.md": "[Other](other.md)\n[Gallery](validation/gallery.md)\n[Drops](validation/drops.md)\n",
            "docs/other.md": "# Other\n\n`cases/rest.toml` and `cases/drop.toml`.\n",
            "docs/validation/drops.md": "# Drops\n\n## A drop's angle\n\n" + PAGE,
            "docs/validation/gallery.md": "<!-- generated: cases and studies -->\n<!-- end of generated -->\n",
            "cases/rest.toml": "format = 1\n",
        }
        for name, text in files.items():
            (self.root / name).write_text(text, encoding="utf-8")
        gallery.write(self.root)
        lines = (self.root / "docs/validation/gallery.md").read_text(encoding="utf-8").splitlines()
        expected = [
            "| [A drop's angle](drops.md#a-drops-angle) | `cases/drop.toml` | `studies/drop.toml` |",
            "| [Other](../other.md) | `cases/rest.toml` |  |",
            "| others | `cases/disc.toml` |  |",
        ]
        self.assertEqual(lines[4:7], expected)

    def test_two_runs_that_differ_do_not_fit_in_a_cell(self):
        """The message names the column."""
        self.stored()
        layouts = self.root / gallery.LAYOUTS
        layouts.write_text(LAYOUTS.replace(", spacing = 8e-5", ""), encoding="utf-8")
        with self.assertRaisesRegex(SystemExit, "drop: 2 runs for .*coarse"):
            gallery.write(self.root)


if __name__ == "__main__":
    unittest.main()
