"""Error bars and tuned settings of short scenes, against what is known of them without Talus.

Arguments: the folder of the repository, the folder of the build."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from scene_run import BUILD, ROOT, Run, WORK

# Its end swings to twice the static 0.1 mm and back.
BAR = ROOT / "tests/program/swinging_bar.yaml"
COLUMN, PEAK = "end.displacement_x_m", 2e-4  # m


def bars_of(run: Run) -> dict:
    return run.summary["error_bars"]


class ErrorBars(unittest.TestCase):
    def test_the_peak_of_a_swinging_bar_is_within_its_bars_which_know_the_rows_between_which_it_lies(self):
        run = Run(BAR, "time: {step: 0.1 ms}\noutput: {every: 0.5 ms}", options=("--error-bars",))
        peak = bars_of(run)["peaks"][COLUMN]
        self.assertLessEqual(peak["low"], PEAK)
        self.assertGreaterEqual(peak["high"], PEAK)
        self.assertLess(peak["causes"]["step"]["above"], 0.01 * PEAK)
        self.assertGreater(peak["causes"]["rows"]["above"], PEAK - peak["value"])
        self.assertIn(f"peak {COLUMN}", run.done.stderr + (run.result / "log.txt").read_text())

    def test_bars_of_a_rock_on_a_net_hold_the_converged_deflection_and_its_cost_is_told(self):
        short = "time: {end: 50 ms, step: STEP}\noutput: {fields_every: ~}\n"
        run = Run("examples/cable_net", short.replace("STEP", "12.5 us"), options=("--error-bars",))
        converged = Run("examples/cable_net_implicit", short.replace("STEP", "3.125 us"))  # other contacts
        bars = bars_of(run)
        for column in ("net_centre.displacement_z_m", "boulder.position_z_m", "boulder.velocity_z_m_per_s"):
            truth = converged.summary["peaks"][column]["value"]
            self.assertLessEqual(bars["peaks"][column]["low"], truth, column)
            self.assertGreaterEqual(bars["peaks"][column]["high"], truth, column)
        self.assertGreater(bars["companions_seconds"], 0)
        self.assertEqual({companion["cause"] for companion in bars["companions"]}, {"steps and window"})
        self.assertIn('"companions_seconds":', self.report_of(run))

    def report_of(self, run: Run) -> str:
        subprocess.run([BUILD / "bin/talus", "report", run.result], capture_output=True, check=True)
        return (run.result / "report.html").read_text()

    def test_a_restarted_run_has_no_error_bars(self):
        done = subprocess.run([BUILD / "bin/talus", "run", "scene.yaml", "--error-bars", "--restart", "checkpoint.h5"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--error-bars", done.stderr)


class Tune(unittest.TestCase):
    def tuned(self, *goals: str) -> tuple[subprocess.CompletedProcess, pathlib.Path]:
        out = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
        options = [word for goal in goals for word in ("--within", goal)]
        return subprocess.run([BUILD / "bin/talus", "tune", BAR, *options, "--budget", "5", "--out", out], capture_output=True, text=True), out

    def test_a_tuned_bar_has_a_longer_step_and_still_the_peak_that_theory_says(self):
        done, out = self.tuned(f"1 % of peak {COLUMN}")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads((out / "tune.json").read_text())
        self.assertAlmostEqual(found["goals"][0]["truth"], PEAK, delta=1e-3 * PEAK)
        again = Run(out / "swinging_bar_tuned.yaml")
        self.assertLessEqual(abs(again.summary["peaks"][COLUMN]["value"] - PEAK), 0.01 * PEAK)
        self.assertGreater(again.summary["window_s"], 2 * 0.02e-3)
        self.assertIn("faster than the scene as given", (out / "index.html").read_text())

    def test_a_goal_for_a_probe_that_is_not_there_lists_those_that_are(self):
        done, _ = self.tuned("1 % of peak end.displacement_w_m")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the scene has no peak 'end.displacement_w_m'", done.stderr)
        self.assertIn(COLUMN, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
