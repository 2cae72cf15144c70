"""A type test from a data sheet: stages follow each other without repair, and every number of the report is that of the results it rests on.

Arguments: the folder of the repository, the folder of the build."""
import csv
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

from scene_run import BUILD, ROOT

# D1000 with a coarse net, and impacts that end soon after the touch.
SHEET = (ROOT / "configs/sheets/d1000.yaml").read_text().replace("time: 0.7 s", "time: 0.1 s").replace(
    "rhombic_83x137_3}", "rhombic_83x137_3, cell_along: 1 m, cell_across: 1.1 m}")
WORK = tempfile.TemporaryDirectory()


def talus(*words) -> subprocess.CompletedProcess:
    return subprocess.run([BUILD / "bin/talus", "barrier", *map(str, words)], capture_output=True, text=True)


def type_test(sheet: str, *options) -> tuple[subprocess.CompletedProcess, pathlib.Path]:
    folder = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
    (folder / "sheet.yaml").write_text(sheet)
    return talus(folder / "sheet.yaml", "--test", folder / "test", *options), folder / "test"


def columns(path: pathlib.Path) -> dict[str, numpy.ndarray]:
    with path.open() as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], numpy.array(rows[1:], float).T))


class OfASheet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.done, cls.folder = type_test(SHEET)
        cls.report = json.loads((cls.folder / "report.json").read_text())
        cls.tests = {test["name"]: test for test in cls.report["tests"]}

    def test_all_impacts_ran_and_their_lines_are_printed(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual(list(self.tests), ["sel_1", "sel_2", "mel"])
        for test in self.tests.values():
            self.assertTrue(test["finished"])
            self.assertIn(test["title"], self.done.stdout)

    def test_the_barrier_hangs_at_rest_until_the_block_touches_it_with_its_speed(self):
        for name, test in self.tests.items():
            with self.subTest(name):
                energy = columns(self.folder / name / "energy.csv")
                before = energy["time_s"] < test["first_contact_s"] - 1e-9
                self.assertGreater(before.sum(), 1)
                self.assertLess(energy["structure.kinetic_J"][before].max(), 1e-5 * energy["particles.kinetic_J"][0])
                self.assertGreaterEqual(test["speed_m_per_s"], 25)
                self.assertLess(test["speed_m_per_s"], 25.6)

    def test_the_second_impact_meets_what_the_first_has_left(self):
        first, second = (columns(self.folder / name / "probes.csv") for name in ("sel_1", "sel_2"))
        for brake in ("brake_uw", "brake_le"):
            travel = first[f"{brake}.travel_max_m"][-1]
            self.assertGreater(travel, 1e-3)
            # as the block is out and the barrier comes to rest a brake may run on, never back
            self.assertGreaterEqual(second[f"{brake}.travel_max_m"][0], travel * (1 - 1e-9))

    def test_lengths_times_and_forces_are_those_of_the_probes(self):
        for name, test in self.tests.items():
            with self.subTest(name):
                probes = columns(self.folder / name / "probes.csv")
                net = -probes["middle.displacement_y_m"]
                self.assertAlmostEqual(test["largest_elongation_m"], net.max(), places=9)
                self.assertAlmostEqual(test["largest_elongation_s"], probes["time_s"][net.argmax()], places=9)
                force = numpy.stack([probes[f"block.contact_force_{axis}_N"] for axis in "xyz"])
                touched = numpy.linalg.norm(force, axis=0) > 0
                contact = touched.argmax()
                self.assertAlmostEqual(test["first_contact_s"], probes["time_s"][contact], places=9)
                self.assertAlmostEqual(test["braking_time_s"], test["largest_elongation_s"] - test["first_contact_s"], places=9)
                mass = 3200 if name == "mel" else 3200 / 3
                self.assertAlmostEqual(test["peak_acceleration_raw"] / (numpy.linalg.norm(force, axis=0).max() / mass), 1, places=9)
                speed = numpy.sqrt(sum(probes[f"block.velocity_{axis}_m_per_s"][contact - 1] ** 2 for axis in "xyz"))
                self.assertAlmostEqual(test["energy_kJ"], 0.5e-3 * mass * speed ** 2, places=6)
                path = probes["block.position_y_m"]
                way = path[contact] - path.min()
                self.assertAlmostEqual(test["mean_braking_force_N"] / (mass * (speed ** 2 / 2 + 9.81 * way) / way), 1, places=6)
                for brake in test["brakes"]:
                    self.assertAlmostEqual(brake["travel_m"], probes[brake["part"] + ".travel_max_m"].max(), places=9)
                for row in test["forces"]:
                    at_rows = probes.get(row["part"] + ".axial_force_max_N")
                    if at_rows is not None and row["compression_N"] is None:
                        self.assertGreaterEqual(row["force_N"], at_rows[:-1].max() * (1 - 1e-9))  # the last row is a step behind the last look

    def test_heights_are_those_of_the_fields(self):
        for name, test in self.tests.items():
            with self.subTest(name), h5py.File(self.folder / name / "fields.h5") as file:
                frames = json.loads((self.folder / name / "summary.json").read_text())["frames"]

                def positions(part, frame):
                    return numpy.array(file[f"{part}/position/{frame % frames:06d}"])
                start = positions("upper", 0)[:, 0]
                span = (start > 10.2) & (start < 19.8)
                height = [(positions("upper", frame)[span, 2] - positions("lower", frame)[span, 2]).min() for frame in (0, -1)]
                self.assertAlmostEqual(test["nominal_height_m"], height[0], places=5)
                self.assertAlmostEqual(test["residual_height_m"], height[1], places=5)
                self.assertAlmostEqual(test["residual_share"], height[1] / height[0], places=5)

    def test_the_energy_of_the_block_is_found_again(self):
        for name, test in self.tests.items():
            with self.subTest(name):
                for k in (0, 1):
                    found = sum(row["J"][k] for row in test["energy"]["rows"])
                    self.assertAlmostEqual(found / test["energy"]["input_J"][k], 1, delta=2e-3)

    def test_anchors_pull_as_the_supports_of_the_summary_hold(self):
        summary = json.loads((self.folder / "mel/summary.json").read_text())["tables"]["support_forces"]
        for anchor in self.tests["mel"]["anchors"]:
            row = summary[anchor["name"]]
            for pulled, held in zip(anchor["force_N"], (row["x_N"], row["y_N"], row["z_N"])):
                self.assertEqual(pulled, -held)
        feet = [anchor for anchor in self.tests["mel"]["anchors"] if anchor["name"].startswith("post_2")]
        self.assertLess(feet[0]["force_N"][2], 0)  # a post presses on its foot

    def test_the_envelope_has_the_largest_force_of_every_part(self):
        for row in self.report["envelope"]:
            forces = {name: {f["part"]: f["force_N"] for f in test["forces"]} for name, test in self.tests.items()}
            self.assertEqual(row["force_N"], max(f[row["part"]] for f in forces.values()))
            self.assertEqual(row["force_N"], forces[row["test"]][row["part"]])

    def test_the_page_holds_the_report_and_a_replay_of_every_impact(self):
        page = (self.folder / "report.html").read_text()
        self.assertLess(len(page), 5e6)
        for words in (self.report["title"], '"replays"', *self.tests):
            self.assertIn(words, page)
        self.assertNotIn('"lacks"', page)

    def test_a_folder_that_holds_a_test_is_kept(self):
        again = talus(self.folder.parent / "sheet.yaml", "--test", self.folder)
        self.assertEqual(again.returncode, 2)
        self.assertIn("holds a test already", again.stderr)
        self.assertEqual(talus(self.folder.parent / "sheet.yaml", "--test", self.folder, "--impacts", "mle").returncode, 2)
        self.assertEqual(talus(self.folder.parent / "sheet.yaml", "--impacts", "mel").returncode, 2)


class Others(unittest.TestCase):
    def test_other_barriers_hits_and_slopes_are_measured_too(self):
        coarse = SHEET.replace("time: 0.1 s", "time: 0.05 s")
        for name, changes in {
            "no brakes, two posts": [("    brakes: {force: 60 kN, travel: 2.2 m}\n", ""), ("count: 4", "count: 2")],
            "flat block beside the middle on a slope": [("slope: 90 deg", "slope: 60 deg"), ("mass: 3200 kg", "form: eota_221, mass: 3200 kg, along: 12 m, spin: [5, 0, 0]")],
            "friction": [("number: 2", "number: 2\n    friction: 0.15")],
        }.items():
            with self.subTest(name):
                sheet = coarse
                for old, new in changes:
                    self.assertIn(old, sheet)
                    sheet = sheet.replace(old, new)
                done, folder = type_test(sheet, "--impacts", "mel")
                self.assertEqual(done.returncode, 0, done.stderr)
                report = json.loads((folder / "report.json").read_text())
                test = report["tests"][0]
                self.assertTrue(test["finished"], test["why_not"])
                self.assertEqual(len(test["brakes"]), 0 if "no brakes" in name else 4)
                self.assertEqual([a["name"] for a in test["anchors"] if a["at"] is None], [])
                self.assertLess(abs(test["energy_error"]), 2e-3)
                spans = [rule for rule in report["rules"] if "spans" in rule["what"]][0]
                self.assertEqual(spans["passes"], "two posts" not in name)
                found = sum(row["J"][1] for row in test["energy"]["rows"]) / test["energy"]["input_J"][1]
                self.assertAlmostEqual(found, 1, delta=3e-3)


class Stopped(unittest.TestCase):
    def test_a_test_that_is_stopped_ends_its_stage_and_says_so(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
        (folder / "sheet.yaml").write_text(SHEET)
        running = subprocess.Popen([BUILD / "bin/talus", "barrier", folder / "sheet.yaml", "--test", folder / "test"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while "settle" not in running.stderr.readline():
            self.assertIsNone(running.poll())
        running.send_signal(signal.SIGTERM)
        _, said = running.communicate(timeout=30)
        self.assertEqual(running.returncode, 5)
        self.assertIn("stages that finished stay", said)
        self.assertFalse((folder / "test/report.json").exists())
        self.assertEqual(subprocess.run(["pgrep", "-f", str(folder)], capture_output=True, text=True).stdout, "")


class OfAWeakBarrier(unittest.TestCase):
    def test_ropes_that_bear_too_little_fail_their_rule(self):
        done, folder = type_test(re.sub(r"lateral_ropes: {diameter: 16 mm", "lateral_ropes: {diameter: 8 mm", SHEET), "--impacts", "mel")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads((folder / "report.json").read_text())
        failed = [rule for rule in report["rules"] if rule["passes"] is False]
        used = {row["part"]: row["utilisation"] for row in report["tests"][0]["forces"]}
        self.assertEqual(any("breaking load" in rule["what"] for rule in failed), max(u for u in used.values() if u is not None) > 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
