"""A barrier from its data sheet: the scene that is written runs, is the deck that was written by hand, and a wrong sheet gets a sentence.

Arguments: the folder of the repository, the folder of the build."""
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from scene_run import BUILD, ROOT, Run

SHEET = pathlib.Path(ROOT / "configs/sheets/d1000.yaml").read_text()
WORK = tempfile.TemporaryDirectory()


def barrier(sheet: str, *options: str) -> tuple[subprocess.CompletedProcess, pathlib.Path]:
    folder = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
    (folder / "sheet.yaml").write_text(sheet)
    done = subprocess.run([BUILD / "bin/talus", "barrier", folder / "sheet.yaml", "--out", folder / "scene.yaml", *options], capture_output=True, text=True)
    return done, folder / "scene.yaml"


def changed(*changes: tuple[str, str]) -> str:
    sheet = SHEET
    for old, new in changes:
        assert old in sheet, old
        sheet = sheet.replace(old, new, 1)
    return sheet


def without(key: str) -> str:
    return re.sub(rf"\n  {key}:[^\n]*(\n    [^\n]*)*", "", SHEET)


# What is wrong, and words of the one sentence that says so.
WRONG = [
    ("slope: 90 deg", "slope: 95 deg", "barrier.slope"),
    ("slope: 90 deg", "slope: 90 m", "barrier.slope"),
    ("slope: 90 deg", "slopes: 90 deg", "slopes"),
    ("count: 4", "count: 1", "barrier.posts.count"),
    ("length: 4.5 m", "length: -4.5 m", "barrier.posts.length"),
    ("length: 4.5 m, ", "", "length"),
    ("lean: 15 deg", "lean: 80 deg", "barrier.posts.lean"),
    ("HEA160", "HEA161", "HEA161"),
    ("rhombic_83x137_3", "rings", "there is no net `rings`"),
    ("rhombic_83x137_3", "ring_0_3_300", "there is no net `ring_0_3_300`"),
    ("rhombic_83x137_3}", "rhombic_83x137_3, gap: 3 m}", "leaves nothing of the net"),
    ("    diameter: 18 mm", "    diameter: 17 mm", "there is no rope of 17 mm; known: 8 mm"),
    ("number: 2", "number: 0", "barrier.support_ropes.number"),
    ("travel: 2.2 m", "travel: 50 mm", "barrier.support_ropes.brakes.travel"),
    ("travel: 2.2 m", "travel: 2.2 m, length: 6 m", "are longer than the way from their anchor"),
    ("upslope: 6.9 m", "upslope: 1 m", "pull the posts over"),
    ("mass: 3200 kg", "mass: 3200", None),  # a plain number is taken in kg
    ("mass: 3200 kg", "mass: 400 t", "is larger than the net is high"),
    ("mass: 3200 kg", "mass: 3200 kg, along: 31 m", "block.along is 31 m; the row goes from 0 to 30 m"),
    ("mass: 3200 kg", "mass: 3200 kg, height: 6 m", "block.height is 6 m"),
    ("mass: 3200 kg", "mass: 3200 kg, height: 0 m", "starts in the ground"),
    ("time: 0.7 s", "time: 0.7 s, start: hanging", "barrier.test.start"),
    ("speed: 25 m/s", "speed: 25 km", "barrier.block.speed"),
]

# What is unusual, and the warning.
UNUSUAL = [
    ("spacing: 10 m", "spacing: 14 m", "5 to 12 m"),
    ("count: 4", "count: 8", "after 60 m"),
    ("lean: 15 deg", "lean: 25 deg", "10 to 15 deg"),
    ("upslope: 6.9 m", "upslope: 4 m", "gives 65"),
    ("beside: 5 m", "beside: 12 m", "2 to 8 m"),
    ("force: 60 kN", "force: 20 kN", "40 to 70 % is usual"),
    ("force: 60 kN", "force: 150 kN", "70 % of the breaking load"),
    ("speed: 25 m/s", "speed: 20 m/s", "25 m/s at least"),
    ("time: 0.7 s", "time: 0.2 s", "0.3 to 0.5 s"),
]


class FromASheet(unittest.TestCase):
    def test_the_scene_is_the_deck_that_was_written_by_hand(self):
        done, scene = barrier(SHEET)
        self.assertEqual(done.returncode, 0, done.stderr)
        short = "time: {end: 40 ms}\noutput: {every: 1 ms, fields_every: ~}\n"
        written, by_hand = Run(scene, short), Run("barriers/d1000", short)
        self.assertLess(written.energy_error(), 1e-3)
        self.assertEqual([words for words in written.summary["warnings"] if "to and fro" in words], [])
        # Digits of coordinates and the filling of the block differ, so that waves in the net have other phases.
        for column, within in (("block.velocity_y_m_per_s", 2e-3), ("middle.displacement_y_m", 5e-2)):
            self.assertAlmostEqual(written.column(column)[-1] / by_hand.column(column)[-1], 1, delta=within, msg=column)

    def test_posts_anchors_and_block_stand_where_the_sheet_says(self):
        text = barrier(SHEET)[1].read_text()
        lean, length, edge = math.radians(15), 4.5, (24 * 3200 / (17 * 2700)) ** (1 / 3)
        head = (20, length * math.sin(lean), 0.5 + length * math.cos(lean))
        found = [float(x) for x in re.search(r"post_3: .*?, \[([\d.]+) m, ([\d.]+) m, ([\d.]+) m\]\]", text).groups()]
        for value, expected in zip(found, head):
            self.assertAlmostEqual(value, expected, places=5)
        self.assertIn("retaining_2e: {polyline: {points: [[15 m, 6.9 m, 0 m]", text)
        block = [float(x) for x in re.search(r"at: \[([\d.]+) m, ([\d.]+) m, ([\d.]+) m\]\n    *velocity", text).groups()]
        away = edge / 2 + 0.02
        for value, expected in zip(block, (15, length / 2 * math.sin(lean) + away * math.cos(lean), 0.5 + length / 2 * math.cos(lean) - away * math.sin(lean))):
            self.assertAlmostEqual(value, expected, places=5)

    def test_slopes_friction_sag_other_blocks_and_missing_brakes_all_run(self):
        short = "time: {end: 3 ms}\noutput: {every: 1 ms, fields_every: ~}\n"
        for changes in (
            [("slope: 90 deg", "slope: 60 deg"), ("mass: 3200 kg", "form: eota_221, mass: 3200 kg, along: 12 m, height: 3 m, spin: [5, 0, 0]")],
            [("number: 2", "number: 2\n    friction: 0.15")],
            [("    brakes: {force: 60 kN, travel: 2.2 m}\n", ""), ("count: 4", "count: 2")],
        ):
            with self.subTest(changes=changes):
                done, scene = barrier(changed(*changes))
                self.assertEqual(done.returncode, 0, done.stderr)
                run = Run(scene, short)
                self.assertEqual(run.summary["status"], "finished")
                self.assertLess(run.energy_error(), 1e-3)

    def test_the_decks_of_this_repository_are_what_their_sheets_write(self):
        for deck in ("d500", "d2000", "d3000"):
            with self.subTest(deck):
                written = (ROOT / f"configs/barriers/{deck}.yaml").read_text()
                done, scene = barrier((ROOT / f"configs/sheets/{deck}.yaml").read_text())
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(written.split("\n")[1:], scene.read_text().split("\n")[1:])  # the first line names the sheet

    def test_a_net_of_rings_has_whole_rings_and_their_weight(self):
        done, scene = barrier(changed(("rhombic_83x137_3", "ring_7_3_300")))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("default, verify: rings bend", done.stdout + done.stderr)
        # 4.5 m less 2 x 0.05 m hold 14 rings of 0.3 m, 100 are 30 m long: 4.2 m between 0.15 m at both ends of the posts.
        text = scene.read_text()
        self.assertIn("size: [30 m, 4.2 m]", text)
        corner = [float(x) for x in re.search(r"ring_net: {corner: \[([\d.]+) m, ([\d.]+) m, ([\d.]+) m\]", text).groups()]
        lean = math.radians(15)
        for value, expected in zip(corner, (0, 0.15 * math.sin(lean), 0.5 + 0.15 * math.cos(lean))):
            self.assertAlmostEqual(value, expected, places=6)
        run = Run(scene, "time: {end: 3 ms}\noutput: {every: 1 ms, fields_every: ~}\n")
        self.assertLess(run.energy_error(), 1e-3)

    def test_ground_and_breaking_loads_of_the_sheet_are_in_the_scene(self):
        done, scene = barrier(changed(("  test: {time: 0.7 s}", "  ground: {friction: 0.3}\n  test: {time: 0.7 s, breaks: at_breaking_load}")))
        self.assertEqual(done.returncode, 0, done.stderr)
        text = scene.read_text()
        self.assertIn("ground: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, nodes: [net, lower], distance: 0.009 m, friction: 0.3}", text)
        self.assertIn("planes: {ground: {material: soil", text)
        # Two ropes of 18 mm side by side, one of 18 mm beside every post.
        self.assertIn("breaks: {force: 380000 N}", text)
        self.assertIn("breaks: {force: 190000 N}", text)
        run = Run(scene, "time: {end: 3 ms}\noutput: {every: 1 ms, fields_every: ~}\n")
        self.assertEqual(run.summary["status"], "finished")
        self.assertLess(run.energy_error(), 1e-3)

    def test_a_row_that_is_no_whole_number_of_rings_is_refused_with_the_spacing_that_fits(self):
        done, _ = barrier(changed(("rhombic_83x137_3", "ring_7_3_300"), ("count: 4", "count: 2"), ("spacing: 10 m", "spacing: 4.95 m")))
        self.assertEqual(done.returncode, 2)
        self.assertIn("rings are whole: posts.spacing of", done.stderr)

    def test_a_wrong_sheet_gets_a_sentence_and_no_scene(self):
        for old, new, words in WRONG:
            with self.subTest(new=new):
                done, scene = barrier(changed((old, new)))
                if words is None:
                    self.assertEqual(done.returncode, 0, done.stderr)
                    continue
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(words, done.stderr)
                self.assertFalse(scene.exists())
        for key in ("posts", "net", "support_ropes", "block"):
            with self.subTest(missing=key):
                done, _ = barrier(without(key))
                self.assertEqual(done.returncode, 2)
                self.assertIn(f"barrier.{key}", done.stderr)

    def test_what_is_unusual_is_said_with_what_is_usual(self):
        self.assertNotIn("warning", barrier(SHEET)[0].stderr)
        for old, new, words in UNUSUAL:
            with self.subTest(new=new):
                done, scene = barrier(changed((old, new)))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(words, done.stderr)
                self.assertTrue(scene.exists())

    def test_a_title_with_quotes_stays_a_title(self):
        title = 'the "wet" one: \\ 5'
        done, scene = barrier(SHEET.replace("title: Barrier D1000, MEL", f"title: '{title}'"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(Run(scene, "time: {end: 1 ms}\noutput: {every: 1 ms, fields_every: ~}\n").summary["title"], title)

    def test_a_scene_that_is_there_is_kept(self):
        _, scene = barrier(SHEET)
        scene.write_text("mine")
        again = [BUILD / "bin/talus", "barrier", scene.parent / "sheet.yaml", "--out", scene]
        done = subprocess.run(again, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(scene.read_text(), "mine")
        self.assertEqual(subprocess.run([*again, "--overwrite"], capture_output=True).returncode, 0)
        self.assertIn("post_1", scene.read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
