"""`talus explain RESULT` after runs that a user would make: shares of the time, of the energy, and what it proposes.

Arguments: the folder of the repository, the folder of the build."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
WORK = tempfile.TemporaryDirectory()
tearDownModule = WORK.cleanup


def talus(*arguments) -> str:
    done = subprocess.run([BUILD / "bin/talus", *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return done.stdout


def run(example: str, changes: str) -> pathlib.Path:
    folder = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
    (folder / "scene.yaml").write_text(f"extends: {ROOT}/configs/examples/{example}.yaml\n{changes}")
    talus("run", folder / "scene.yaml", "--out", folder / "result", "--quiet")
    return folder / "result"


class AfterARun(unittest.TestCase):
    def test_each_stage_has_its_share_of_the_time_and_no_side_has_more_than_all(self):
        result = run("cable_net", "time: {end: 50 ms}\noutput: {stage_times: {}}")
        text = talus("explain", result)
        shares = re.findall(r"^ +([\d.]+) %  (structure|particles) +(.+)$", text, re.M)
        for side in ("structure", "particles"):
            total = sum(float(share) for share, owner, _ in shares if owner == side)
            self.assertGreater(total, 1)
            self.assertLessEqual(total, 100)
        stages = [stage for _, _, stage in shares]
        self.assertIn("elements of net", stages)
        self.assertIn("contacts with the boundary", stages)
        self.assertRegex(text, r"particles\.kinetic_J")

    def test_times_are_told_only_where_the_scene_asks_and_change_no_bit_of_the_motion(self):
        with_times, without = (run("cable_net", f"time: {{end: 5 ms}}\noutput: {{fields_every: ~{times}}}") for times in (", stage_times: {}", ""))
        columns = json.loads((without / "summary.json").read_text())["last"]
        self.assertFalse([name for name in columns if "_time." in name])
        timed = json.loads((with_times / "summary.json").read_text())["last"]
        self.assertEqual({name: timed[name] for name in columns}, columns)
        self.assertIn("time: not measured", talus("explain", without))

    def test_a_step_too_long_for_the_dashpots_and_a_sheet_without_wrinkles_are_told(self):
        self.assertIn("`particles.implicit_contact` keeps its accuracy", talus("explain", run("cable_net", "time: {end: 5 ms}")))
        text = talus("explain", run("membrane_plain", "time: {end: 60 ms}"))
        self.assertRegex(text, r"compression up to \S+ % of the tension in membrane `net`: no tension field")
        self.assertRegex(text, r"out +structure +tension field of net")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
