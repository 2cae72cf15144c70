"""`talus explain RESULT` after runs that a user would make: shares of the time, of the energy, and what it proposes.

Arguments: the folder of the repository, the folder of the build."""
import re
import subprocess
import sys
import unittest

from scene_run import BUILD, Run


def explained(run: Run) -> str:
    assert run.summary
    return subprocess.run([BUILD / "bin/talus", "explain", run.result], capture_output=True, text=True, check=True).stdout


class AfterARun(unittest.TestCase):
    def test_each_stage_has_its_share_of_the_time_and_no_side_has_more_than_all(self):
        text = explained(Run("examples/cable_net", "time: {end: 50 ms}\noutput: {stage_times: {}}"))
        shares = re.findall(r"^ +([\d.]+) %  (structure|particles) +(.+)$", text, re.M)
        for side in ("structure", "particles"):
            total = sum(float(share) for share, owner, _ in shares if owner == side)
            self.assertGreater(total, 1)
            self.assertLessEqual(total, 100)
        stages = [stage for _, _, stage in shares]
        self.assertIn("elements of net", stages)
        self.assertIn("contacts with the boundary", stages)
        self.assertRegex(text, r"J +stored +particles\.kinetic_J")

    def test_times_are_told_only_where_the_scene_asks_and_change_no_bit_of_the_motion(self):
        timed, untimed = (Run("examples/cable_net", f"time: {{end: 5 ms}}\noutput: {{fields_every: ~{times}}}") for times in (", stage_times: {}", ""))
        self.assertFalse([name for name in untimed.columns if "_time." in name])
        self.assertTrue([name for name in timed.columns if "_time." in name])
        for name, values in untimed.columns.items():
            self.assertEqual(list(timed.column(name)), list(values), name)
        self.assertIn("time: not measured", explained(untimed))

    def test_an_implicit_structure_has_its_stages_too(self):
        run = Run("examples/hanging_net_implicit", "time: {end: 20 ms}\noutput: {fields_every: ~, stage_times: {}}", program="fem_solver")
        self.assertGreater(run.column("structure_time.everything_else_s")[-1], 0)
        self.assertLess(sum(values[-1] for name, values in run.columns.items() if "_time." in name), run.summary["wall_time_s"])

    def test_a_step_too_long_for_the_dashpots_and_a_sheet_without_wrinkles_are_told(self):
        self.assertIn("`particles.implicit_contact` keeps its accuracy", explained(Run("examples/cable_net", "time: {end: 5 ms}")))
        text = explained(Run("examples/membrane_plain", "time: {end: 60 ms}"))
        self.assertRegex(text, r"compression up to \S+ % of the tension in membrane `net`: no tension field")
        self.assertRegex(text, r"out +structure +tension field of net")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
