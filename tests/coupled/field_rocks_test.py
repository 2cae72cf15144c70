"""Rocks and balls with several contacts (tests/field): closed forms of Hertz' and linear springs.

Arguments: the folder of the repository, the folder of the build."""
import math
import unittest

from scene_run import ROOT, Run

FIELD = ROOT / "tests/field"
G = 9.81


def run(scene: str) -> Run:
    return Run(FIELD / f"{scene}.yaml", program="dem_solver")


class Wires(unittest.TestCase):
    """A ball of 0.5 m on parallel rigid wires of 5 mm, springs of 1 MN/m."""

    def sunk(self, pitch: float) -> float:
        """Where the springs of all wires that it touches carry the ball (m below its place on the middle wire)."""
        weight, reach = 2650 * 4 / 3 * math.pi * 0.5**3 * G, 0.505

        def carried(depth: float) -> float:
            height, force = reach - depth, 0.0
            for k in range(-30, 31):
                distance = math.hypot(k * pitch, height)
                force += 1e6 * max(0.0, reach - distance) * height / distance
            return force

        low, high = 0.0, 0.02
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if carried(middle) < weight else (low, middle)
        return low

    def test_a_ball_sinks_until_all_wires_that_it_touches_carry_it(self):
        for pitch, told in ((10, 2.1759e-3), (20, 3.5224e-3)):
            with self.subTest(pitch=pitch):
                expected = self.sunk(pitch * 1e-3)
                self.assertAlmostEqual(expected, told, delta=1e-7)  # as tests/field/README.md has it
                self.assertAlmostEqual(run(f"wires/row_{pitch}mm").column("ball.position_z_m")[-1], 0.505 - expected, delta=1e-8)

    def test_two_wires_carry_it_between_them(self):
        self.assertAlmostEqual(run("wires/two_wires").column("ball.position_z_m")[-1], 0.497558, delta=1e-6)

    def test_it_slides_along_frictionless_wires_without_losing_speed(self):
        slide = run("wires/slide_10mm")
        on_the_row = slide.column("ball.position_x_m") < 0.25
        speed = slide.column("ball.velocity_x_m_per_s")[on_the_row]
        self.assertLess(abs(speed - 1).max(), 0.01)


class Plates(unittest.TestCase):
    """Rocks of n balls that land flat on a plane, without weight."""

    def test_restitution_is_what_was_asked_for_whatever_the_number_of_balls(self):
        for scene, asked in (("hertz_e0.5_1", 0.5), ("hertz_e0.5_4", 0.5), ("hertz_e0.5_16", 0.5), ("linear_e0.2_4", 0.2)):
            with self.subTest(scene):
                energy = run(f"plates/{scene}").column("rock.kinetic_energy_J")
                self.assertAlmostEqual(math.sqrt(energy[-1] / energy[0]), asked, delta=0.01 * asked)


class Tips(unittest.TestCase):
    def test_a_ball_on_a_tip_of_200_facets_sinks_as_on_one_spring(self):
        weight = 2650 * 4 / 3 * math.pi * 0.1**3 * G
        self.assertAlmostEqual(run("funnels/rest_200_tip").column("ball.position_z_m")[-1], 0.1 - weight / 1e6, delta=1e-8)

    def test_a_step_too_long_for_all_facets_of_a_funnel_does_not_end_as_finished(self):
        self.assertEqual(run("funnels/funnel_50_step3300us").done.returncode, 4)


if __name__ == "__main__":
    unittest.main(argv=["field_rocks_test"])
