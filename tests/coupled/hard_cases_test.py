"""The hard cases of configs/hard/: each file says why it is hard and what must hold, and this is held here.

Arguments: the folder of the repository, the folder of the build."""
import math
import sys
import unittest

import numpy as np

from scene_run import Run

GRAVITY = 9.81


class HeavyRockOnLightNodes(unittest.TestCase):
    def test_rocks_of_one_energy_and_any_mass_come_down_as_far_and_the_balance_closes(self):
        depths = {}
        for ratio in (1e3, 1e4, 1e5, 1e6):
            share = ratio / 1e6
            run = Run("hard/heavy_rock_on_light_nodes", f"""
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
        cls.run_ = Run("hard/string_without_stiffness", program="fem_solver")
        cls.speed = math.sqrt(100e6 / 7850)  # sqrt(S/density)

    def test_the_limit_of_the_step_is_that_of_waves_across(self):
        self.assertAlmostEqual(self.run_.summary["limits"][0]["seconds"] * self.speed / 0.1, 1, delta=0.005)  # 40 divisions

    def test_the_middle_swings_by_v_l_over_2c_and_loses_nothing_in_50_periods(self):
        swing, amplitude = self.run_.column("middle.displacement_z_m"), 4 / (2 * self.speed)
        period = round(2 * 4 / self.speed / 840e-6)
        self.assertAlmostEqual(max(swing[:period]), amplitude, delta=0.025 * amplitude)  # half an element at each end starts at rest
        self.assertGreater(max(swing[-period:]), 0.9 * amplitude)  # the corners of its shape disperse
        self.assertLess(self.run_.energy_error(), 1e-6)


class NetWithoutPrestress(unittest.TestCase):
    def test_the_load_sinks_as_the_closed_form_says(self):
        stiffness = 110e9 * 12.566e-6
        found = Run("hard/net_without_prestress", program="fem_solver").column("middle.displacement_z_m")
        for step, depth in enumerate(found):
            self.assertAlmostEqual(depth, -(200 * step / (2 * stiffness)) ** (1 / 3), delta=1e-8)


class ReversingMembrane(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = Run("hard/reversing_membrane", program="fem_solver")

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
        run = Run("hard/block_on_the_corner")
        self.assertLess(run.energy_error(), 0.005)
        self.assertEqual(max(map(abs, run.column("corner.displacement_z_m"))), 0)
        self.assertLess(min(run.column("block.velocity_z_m_per_s")), -3.9)  # it did come down
        self.assertGreater(run.column("block.velocity_z_m_per_s")[-1], 0)


class RockRestingOnNet(unittest.TestCase):
    radius, density = 0.15, 2500

    @classmethod
    def setUpClass(cls):
        cls.run_ = Run("hard/rock_resting_on_net")
        cls.rests = cls.run_.column("time_s") >= 8
        cls.mass = 4 / 3 * math.pi * cls.radius**3 * cls.density

    def late(self, name: str):
        return self.run_.column(name)[self.rests]

    def test_it_stays_where_it_is(self):
        for axis in "xyz":
            self.assertLess(np.ptp(self.late(f"rock.position_{axis}_m")), 1e-4)  # of a rock of 0.3 m, in 2 s

    def test_it_neither_moves_nor_turns(self):
        # All of its energy, were it a spin: a surface that would creep by 0.1 mm/s.
        as_spin = 0.5 * (0.4 * self.mass * self.radius**2) * (1e-4 / self.radius) ** 2
        self.assertLess(self.late("rock.kinetic_energy_J").max(), as_spin)

    def test_the_net_carries_its_weight(self):
        weight = self.mass * GRAVITY
        self.assertLess(np.abs(self.late("rock.contact_force_z_N") - weight).max(), 1e-3 * weight)

    def test_it_gains_no_energy(self):
        self.assertLess(self.run_.energy_error(), 0.01)


class StepAtTheLimit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.limit = Run("hard/step_at_the_limit", program="fem_solver").summary["limits"][0]["seconds"]

    def scene(self, share: float, more: str = "") -> str:
        return f"time: {{step: {share * self.limit!r}, end: {20000 * share * self.limit!r}}}\n{more}"

    def test_slightly_below_it_runs_without_growth(self):
        run = Run("hard/step_at_the_limit", self.scene(0.99), program="fem_solver")
        self.assertLess(run.energy_error(), 0.05)  # next to the limit energies of the highest mode swing, but do not grow
        motion = [abs(x) for x in run.column("struck.displacement_z_m")]
        self.assertLess(max(motion[len(motion) // 2:]), 1.2 * max(motion[:len(motion) // 2]))

    def test_slightly_above_it_is_refused_before_anything_runs(self):
        done = Run("hard/step_at_the_limit", self.scene(1.01), program="fem_solver").done
        self.assertEqual(done.returncode, 2)
        self.assertIn("above the limit of stability", done.stderr)

    def test_slightly_above_it_ends_with_an_error_where_the_scene_insists(self):
        done = Run("hard/step_at_the_limit", self.scene(1.01, "structure: {unstable_step: allowed}"), program="fem_solver").done
        self.assertEqual(done.returncode, 4)  # a numerical error, not a crash or a bug
        self.assertRegex(done.stderr, r"step \d+.*node \d+")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
