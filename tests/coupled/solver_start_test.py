"""How a scene has its solvers started: `solver: {program, arguments, environment, working_folder, launcher, timeout, join_timeout}`."""
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

from scene_run import BUILD, ROOT, Run

SCENE = ROOT / "tests/consumer/rock_on_springs.yaml"
TOLD = ROOT / "tests/coupled/participants/told.py"


def run_with(structure="", particles="", **options):
    sides = [f"{side}: {{solver: {solver}}}\n" for side, solver in (("structure", structure), ("particles", particles)) if solver]
    return Run(SCENE, "".join(sides), **options)


class SolverStart(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = pathlib.Path(self.place.name).resolve()
        self.told = self.folder / "told.json"

    def test_a_solver_gets_arguments_variables_folder_and_launcher_of_the_scene(self):
        run = run_with(f"{{program: {TOLD}, arguments: [--mesh, fine], environment: [TOLD={self.told}, LEVEL=a=b],"
                       f" working_folder: {self.folder}, launcher: [env, BY_LAUNCHER=yes]}}")
        self.assertEqual(run.done.returncode, 0, run.done.stderr)
        told = json.loads(self.told.read_text())
        self.assertEqual(told["arguments"][:2], ["--mesh", "fine"])
        self.assertEqual(told["arguments"][3], "--join")
        self.assertTrue(pathlib.Path(told["arguments"][2]).is_absolute())
        self.assertEqual(told["folder"], str(self.folder))
        self.assertEqual((told["environment"]["LEVEL"], told["environment"]["BY_LAUNCHER"]), ("a=b", "yes"))

    def test_a_launcher_without_a_program_starts_the_solver_of_talus(self):
        run = run_with(str(ROOT / "examples/participants/springs.py"), f"{{launcher: [sh, -c, 'echo \"$0\" > {self.told}; exec \"$0\" \"$@\"']}}")
        self.assertEqual(run.done.returncode, 0, run.done.stderr)
        self.assertEqual(self.told.read_text().strip(), str(BUILD / "bin/dem_solver"))

    def test_what_a_scene_names_and_is_not_there_is_told_with_its_key_and_not_started(self):
        for solver, key, why in (("{program: nobody}", "program", "is not there"),
                                 (f"{{program: {TOLD}, launcher: [no_such_launcher, -n, 2]}}", "launcher", "is not on PATH"),
                                 (f"{{program: {TOLD}, working_folder: no/such/folder}}", "working_folder", "no folder"),
                                 (f"{{program: {TOLD}, environment: [2ND=x]}}", "environment", "expects NAME=value, got '2ND=x'"),
                                 (f"{{program: {TOLD}, timeout: 0 s}}", "timeout", "must be greater than 0 s"),
                                 (f"{{program: {TOLD}, timeout: 3 m}}", "timeout", "3 m"),
                                 (f"{{programme: {TOLD}}}", "programme", "did you mean 'program'?")):
            run = run_with(solver)
            self.assertEqual(run.done.returncode, 2, run.done.stderr)
            self.assertIn(f"structure.solver.{key}", run.done.stderr)
            self.assertIn(why, run.done.stderr)

    def test_each_side_has_its_own_time_outs(self):
        for how, limit in ("slow", "timeout: 0.6 s"), ("late", "join_timeout: 0.6 s"):
            begin = time.monotonic()
            run = run_with(f"{{program: {TOLD}, arguments: [{how}], environment: [TOLD={self.told}], {limit}}}")
            self.assertEqual(run.done.returncode, 3, run.done.stderr)
            self.assertIn("structure", run.done.stderr)
            self.assertIn("gave no answer for 0.6 s", run.done.stderr)
            self.assertLess(time.monotonic() - begin, 50)

    def test_check_starts_no_launcher_that_the_scene_names(self):
        scene = self.folder / "scene.yaml"
        scene.write_text(f"extends: {SCENE}\nparticles: {{solver: {{launcher: [touch, {self.told}]}}}}\n"
                         f"structure: {{solver: {TOLD}}}\n")
        done = subprocess.run([BUILD / "bin/talus", "check", scene], capture_output=True, text=True)
        self.assertFalse(self.told.exists())
        self.assertEqual(done.stdout.count("was not asked"), 2, done.stdout + done.stderr)

    def test_a_scene_adds_to_the_program_that_its_base_names_by_a_word(self):
        base = self.folder / "base.yaml"
        base.write_text(f"extends: {SCENE}\nstructure: {{solver: {TOLD}}}\n")
        run = Run(base, f"structure: {{solver: {{arguments: [more], environment: [TOLD={self.told}]}}}}")
        self.assertEqual(run.done.returncode, 0, run.done.stderr)
        self.assertEqual(json.loads(self.told.read_text())["arguments"][0], "more")


unittest.main(argv=sys.argv[:1])
