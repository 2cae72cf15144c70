"""The hard cases of configs/hard/: each file says why it is hard and what must hold, and this is held here.

Arguments: the folder of the repository, the folder of the build."""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
GRAVITY = 9.81
WORK = tempfile.TemporaryDirectory()
tearDownModule = WORK.cleanup


class Run:
    """A hard case, with changes, by `talus` or, where it has no particles, `fem_solver`."""

    def __init__(self, case: str, changes: str = "", program: str = "talus"):
        folder = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
        scene, self.result = folder / "scene.yaml", folder / "result"
        scene.write_text(f"extends: {ROOT / 'configs/hard' / case}.yaml\n{changes}")
        command = [BUILD / "bin" / program] + (["run"] if program == "talus" else [])
        self.done = subprocess.run([*command, scene, "--out", self.result, "--quiet"], capture_output=True, text=True)

    def summary(self) -> dict:
        if self.done.returncode != 0:
            raise AssertionError(self.done.stderr)
        return json.loads((self.result / "summary.json").read_text())

    def energy_error(self) -> float:
        return abs(self.summary()["energy"]["largest_error_relative"])

    def column(self, name: str) -> list[float]:
        self.summary()
        with open(self.result / "probes.csv", newline="") as file:
            return [float(row[name]) for row in csv.DictReader(file)]

    def at(self, name: str, time: float) -> float:
        times = self.column("time_s")
        return self.column(name)[min(range(len(times)), key=lambda i: abs(times[i] - time))]


class HeavyRockOnLightNodes(unittest.TestCase):
    def test_rocks_of_one_energy_and_any_mass_come_down_as_far_and_the_balance_closes(self):
        depths = {}
        for ratio in (1e3, 1e4, 1e5, 1e6):
            share = ratio / 1e6
            run = Run("heavy_rock_on_light_nodes", f"""
time: {{end: {3 * math.sqrt(share)}}}
output: {{every: {0.005 * math.sqrt(share)}}}
particles:
  materials: {{rock: {{density: {1.178e6 * share}}}}}
  spheres: {{rock: {{velocity: [0, 0, {-0.1581 / math.sqrt(share)}]}}}}
""")
            with self.subTest(ratio=ratio):
                self.assertLess(run.energy_error(), 0.02)
                self.assertGreater(run.column("rock.velocity_z_m_per_s")[-1], 0)
            depths[ratio] = -min(run.column("rock.position_z_m"))
        # A net of the mass of 121 nodes takes up to a tenth of the lightest rock's energy on the way.
        for ratio, allowed in ((1e3, 0.03), (1e4, 0.005), (1e5, 0.001)):
            with self.subTest(ratio=ratio):
                self.assertLess(abs(depths[ratio] - depths[1e6]), allowed * abs(depths[1e6] - 0.202))


class StringWithoutStiffness(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = Run("string_without_stiffness", program="fem_solver")
        cls.speed = math.sqrt(100e6 / 7850)  # sqrt(S/density)

    def test_the_limit_of_the_step_is_that_of_waves_across(self):
        self.assertAlmostEqual(self.run_.summary()["limits"][0]["seconds"] * self.speed / 0.1, 1, delta=0.005)  # 40 divisions

    def test_the_middle_swings_by_v_l_over_2c_and_loses_nothing_in_50_periods(self):
        swing, amplitude = self.run_.column("middle.displacement_z_m"), 4 / (2 * self.speed)
        period = round(2 * 4 / self.speed / 840e-6)
        self.assertAlmostEqual(max(swing[:period]), amplitude, delta=0.025 * amplitude)  # half an element at each end starts at rest
        self.assertGreater(max(swing[-period:]), 0.9 * amplitude)  # the corners of its shape disperse
        self.assertLess(self.run_.energy_error(), 1e-6)


class NetWithoutPrestress(unittest.TestCase):
    def test_the_load_sinks_as_the_closed_form_says(self):
        stiffness = 110e9 * 12.566e-6
        found = Run("net_without_prestress", program="fem_solver").column("middle.displacement_z_m")
        for step, depth in enumerate(found):
            self.assertAlmostEqual(depth, -(200 * step / (2 * stiffness)) ** (1 / 3), delta=1e-8)


class ReversingMembrane(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = Run("reversing_membrane", program="fem_solver")

    def test_it_resists_both_ways_alike_every_time(self):
        forces = [self.run_.at("sheet.edge_north.reaction_x_N", time) for time in (0.1, 0.3, 0.5, 0.7)]
        self.assertGreater(forces[0], 100)
        for k, force in enumerate(forces):
            self.assertAlmostEqual(force, (-1) ** k * forces[0], delta=0.01 * forces[0])

    def test_it_hardly_resists_halfway_and_wrinkles_at_the_ends(self):
        for time in (0.2, 0.4, 0.6):
            self.assertLess(abs(self.run_.at("sheet.edge_north.reaction_x_N", time)), 0.01 * self.run_.at("sheet.edge_north.reaction_x_N", 0.1))
        self.assertGreater(self.run_.at("sheet.wrinkled_area_m2", 0.3), 0.4)

    def test_no_reversal_makes_energy(self):
        self.assertLess(self.run_.energy_error(), 0.005)


class BlockOnTheCorner(unittest.TestCase):
    def test_the_corner_stays_the_balance_closes_and_the_block_leaves_upwards(self):
        run = Run("block_on_the_corner")
        self.assertLess(run.energy_error(), 0.005)
        self.assertEqual(max(map(abs, run.column("corner.displacement_z_m"))), 0)
        self.assertLess(min(run.column("block.velocity_z_m_per_s")), -3.9)  # it did come down
        self.assertGreater(run.column("block.velocity_z_m_per_s")[-1], 0)


class RockRestingOnNet(unittest.TestCase):
    def test_it_comes_to_rest_and_stays(self):
        run = Run("rock_resting_on_net")
        times = run.column("time_s")
        late = [i for i, time in enumerate(times) if time >= 8]
        weight = 4 / 3 * math.pi * 0.15**3 * 2500 * GRAVITY
        for axis in "xyz":
            place = [run.column(f"rock.position_{axis}_m")[i] for i in late]
            self.assertLess(max(place) - min(place), 1e-4)  # of a rock of 0.3 m, in 2 s
        energy = run.column("rock.kinetic_energy_J")
        self.assertLess(max(energy[i] for i in late), 1e-6 * max(energy))
        for i in late:
            self.assertAlmostEqual(run.column("rock.contact_force_z_N")[i], weight, delta=1e-3 * weight)
        self.assertLess(run.energy_error(), 0.01)


class StepAtTheLimit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.limit = Run("step_at_the_limit", program="fem_solver").summary()["limits"][0]["seconds"]

    def scene(self, share: float, more: str = "") -> str:
        return f"time: {{step: {share * self.limit!r}, end: {20000 * share * self.limit!r}}}\n{more}"

    def test_slightly_below_it_runs_without_growth(self):
        run = Run("step_at_the_limit", self.scene(0.99), "fem_solver")
        self.assertLess(run.energy_error(), 0.05)  # next to the limit energies of the highest mode swing, but do not grow
        motion = [abs(x) for x in run.column("struck.displacement_z_m")]
        self.assertLess(max(motion[len(motion) // 2:]), 1.2 * max(motion[:len(motion) // 2]))

    def test_slightly_above_it_is_refused_before_anything_runs(self):
        done = Run("step_at_the_limit", self.scene(1.01), "fem_solver").done
        self.assertEqual(done.returncode, 2)
        self.assertIn("above the limit of stability", done.stderr)

    def test_slightly_above_it_ends_with_an_error_where_the_scene_insists(self):
        done = Run("step_at_the_limit", self.scene(1.01, "structure: {unstable_step: allowed}"), "fem_solver").done
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"step \d+.*node \d+")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
