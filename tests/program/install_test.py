"""An installation, made into a folder that is not its prefix, serves users who know of it by PATH only, and projects that build against it.

install_test.py SOURCE BUILD"""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
EXAMPLES = SOURCE / "examples/participants"


def called(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def files_below(folder):
    return {path.relative_to(folder) for path in folder.rglob("*")}


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.place.name)
        called("cmake", "--install", BUILD, "--prefix", "/opt/talus", env=os.environ | {"DESTDIR": cls.place.name})
        cls.prefix = cls.root / "opt/talus"
        cls.libraries = next(cls.prefix.rglob("libtalus_c.so")).parent
        # What a login gives, and no more.
        cls.environment = {"PATH": f"{cls.prefix}/bin:/usr/bin:/bin", "LD_LIBRARY_PATH": str(cls.libraries), "HOME": str(cls.root),
                           "PYTHONDONTWRITEBYTECODE": "1"}
        cls.consumer = cls.root / "consumer"
        called("cmake", "-S", SOURCE / "tests/consumer", "-B", cls.consumer, f"-DCMAKE_PREFIX_PATH={cls.prefix}", f"-DEXAMPLES={EXAMPLES}")
        called("cmake", "--build", cls.consumer)

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def deflections(self, solver):
        """What the probe of the springs shows in a run of the installed programs (m)."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.root))
        scene = folder / "scene.yaml"
        scene.write_text(f"extends: {SOURCE}/tests/consumer/rock_on_springs.yaml\nstructure: {{solver: {solver}}}\n")
        called("talus", "run", scene, "--quiet", env=self.environment, cwd=folder)
        with open(folder / "results/scene/probes.csv", newline="") as file:
            return [float(row["middle.displacement_z_m"]) for row in csv.DictReader(file)]

    def test_solvers_built_against_it_run_with_it_and_move_alike(self):
        in_c, in_cpp = (self.deflections(self.consumer / name) for name in ("consumer_c", "consumer_cpp"))
        self.assertLess(min(in_c), -1e-3)
        self.assertEqual(in_c, in_cpp)

    def test_a_solver_in_python_finds_the_installed_package(self):
        self.assertLess(min(self.deflections(EXAMPLES / "springs.py")), -1e-3)
        said = called("/usr/bin/python3", "-c", "import talus_participant; print(talus_participant.__file__)",
                      env=self.environment | {"PYTHONPATH": f"{self.prefix}/lib/python3/dist-packages"})
        self.assertTrue(said.startswith(str(self.prefix)), said)

    def test_pkg_config_is_enough_to_build_a_solver(self):
        environment = os.environ | {"PKG_CONFIG_PATH": str(self.libraries / "pkgconfig")}
        for package, compiler, source in ("talus-c", "cc", "springs.c"), ("talus-participant", "c++", "springs.cpp"):
            flags = called("pkg-config", "--cflags", "--libs", package, env=environment).split()
            if compiler == "c++":
                flags.append("-std=c++20")
            called(compiler, EXAMPLES / source, *flags, "-o", self.root / package)

    def test_an_installed_scene_runs_and_nothing_is_written_beside_it(self):
        before = files_below(self.prefix)
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.root))
        scene = self.prefix / "share/talus/configs/examples/hanger_static.yaml"
        called("fem_solver", scene, "--quiet", env=self.environment, cwd=folder)
        called("talus", "explain", scene, env=self.environment, cwd=folder)
        self.assertTrue((folder / "results/hanger_static/summary.json").is_file())
        self.assertEqual(files_below(self.prefix), before)

    def test_what_others_build_with_names_no_folder_it_was_made_in(self):
        for path in [*self.prefix.rglob("*.cmake"), *self.prefix.rglob("*.pc")]:
            for folder in SOURCE, BUILD, self.root:
                self.assertNotIn(f"{folder}/", path.read_text(), path)


unittest.main(argv=sys.argv[:1])
