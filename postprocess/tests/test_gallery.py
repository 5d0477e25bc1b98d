"""Tables of the validation pages from stored results made here. `python -m unittest discover -s tests`."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SCRIPTS))

import gallery  # noqa: E402

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
            "src/lib.rs": "",
            "Cargo.lock": "",
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

    def stored(self) -> str:
        """The stored result after the study has been stored."""
        gallery.store(self.root, "drop", self.out, {})
        return (self.root / gallery.RESULTS / "drop.csv").read_text(encoding="utf-8")

    def test_a_stored_result_tells_command_program_files_and_complete_runs(self):
        """Seven digits of each measure are stored."""
        lines = self.stored().splitlines()
        self.assertEqual(lines[0], "# meniscus study run studies/drop.toml")
        self.assertEqual(lines[1], f"# program {gallery.program(self.root)}, 3 of 4 runs, 6.0 s")
        names = [line.split()[-1] for line in lines[2:5]]
        self.assertEqual(names, ["studies/drop.toml", "cases/drop.toml", "cases/disc.toml"])
        self.assertEqual(lines[7], "a,60,8e-5,done,59.87654,0.12,0.99")
        self.assertEqual(len(lines), 10)

    def test_a_table_has_error_bars_signs_and_cells_without_a_measure(self):
        """A second write changes nothing, and a changed number is put right."""
        self.stored()
        self.assertEqual(len(gallery.write(self.root)), 1)
        page = self.root / "docs/drop.md"
        text = page.read_text(encoding="utf-8")
        self.assertIn("| 60 | 59.88 ± 0.12 (\u22121.0 %) | 60.04 (+0.1 %) |\n", text)
        self.assertIn("| 90 | none (\u2212100.0 %) |  |\n", text)
        self.assertIn("`meniscus study run studies/drop.toml` (3 of 4 runs, 6.0 s of processor time).", text)
        self.assertIn(f"\nProgram {gallery.program(self.root)}: `meniscus", text)
        self.assertTrue(text.endswith("The end.\n"))
        self.assertEqual(gallery.write(self.root), [])
        page.write_text(text.replace("59.88", "60.00"), encoding="utf-8")
        self.assertEqual(gallery.write(self.root, check=True), [page])
        gallery.write(self.root)
        self.assertEqual(page.read_text(encoding="utf-8"), text)

    def test_a_stamp_takes_over_an_edit_of_the_case(self):
        """Comments, titles and expectations do not count anyway."""
        before = self.stored()
        study = self.root / "studies/drop.toml"
        study.write_text(
            STUDY.replace("contact-angle-deg", "height-ratio").replace("A drop", "Drops"), encoding="utf-8"
        )
        self.assertEqual(self.stored(), before)
        (self.root / "cases/disc.toml").write_text("shapes = [1]\n", encoding="utf-8")
        gallery.stamp_again(self.root, "drop")
        after = (self.root / gallery.RESULTS / "drop.csv").read_text(encoding="utf-8").splitlines()
        changed = [new for old, new in zip(before.splitlines(), after, strict=True) if old != new]
        self.assertEqual([line.split()[-1] for line in changed], ["cases/disc.toml"])

    def test_a_table_of_another_program_is_named(self):
        """A study folder remembers the programs that have worked on it."""
        self.stored()
        self.assertEqual(gallery.of_other_programs(self.root), [])
        gallery.note_program(self.root, self.out)
        first = gallery.program(self.root)
        (self.root / "src/lib.rs").write_text("// changed\n", encoding="utf-8")
        self.assertEqual(gallery.of_other_programs(self.root), ["angles"])
        self.assertEqual(gallery.stale(self.root), [])
        gallery.note_program(self.root, self.out)
        self.assertEqual(gallery.programs(self.root, self.out), [first, gallery.program(self.root)])

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
