"""Windows of changing length in whole runs: those that grow in free flight, and those that are halved.

Arguments: the folder of the repository, the folder of the build."""
import math
import sys
import unittest

import numpy as np

from scene_run import Run


class FreeFlight(unittest.TestCase):
    SPAN = "time: {end: 50 ms}\noutput: {fields_every: ~}\n"  # to the middle of the first impact

    @classmethod
    def setUpClass(cls):
        cls.grown = Run("examples/cable_net_free_flight", cls.SPAN)
        cls.regular = Run("examples/cable_net_converged", cls.SPAN)

    def test_the_run_is_that_of_regular_windows(self):
        # The net rests until the touch, so the steps are the same; only a window's length over its number of steps
        # may be off in the last digit, which the 15 ms of contact amplify.
        for name, regular in self.regular.columns.items():
            off = np.abs(self.grown.column(name) - regular) / np.maximum(1, np.abs(regular))
            self.assertLess(off.max(), 1e-9, name)

    def test_it_takes_far_fewer_windows_and_says_how_many(self):
        flight = self.grown.summary["free_flight"]
        regular = round(0.050 / 6.25e-6)
        gap, speed, gravity = 0.4168695 - 0.21036, 5.74029, 6.378103  # m, m/s, m/s^2: the boulder's, across the net
        touch = (math.sqrt(speed**2 + 2 * gravity * gap) - speed) / gravity  # s: gap = v t + g t^2/2
        self.assertGreater(flight["regular_windows_spared"], 0.9 * touch / 6.25e-6)
        self.assertLess(flight["windows"] + flight["windows_taken_back"], 0.05 * regular)
        self.assertAlmostEqual(flight["longest_window_s"], 0.5e-3)

    def test_the_energy_balance_closes_as_with_regular_windows(self):
        self.assertAlmostEqual(self.grown.energy_error(), self.regular.energy_error(), delta=1e-6)

    def test_implicit_contact_begins_with_the_velocity_of_a_regular_step(self):
        span = "time: {end: 45 ms}\noutput: {fields_every: ~}\n"
        grown = Run("examples/cable_net_implicit", span + "coupling: {longest_window: 1 ms}\n")
        regular = Run("examples/cable_net_implicit", span)
        self.assertGreater(grown.summary["free_flight"]["regular_windows_spared"], 500)
        off = grown.column("net_centre.displacement_z_m") - regular.column("net_centre.displacement_z_m")
        self.assertLess(np.abs(off).max(), 1e-9)

    def test_particles_whose_step_fills_the_longest_window_fly_as_far(self):
        # Free fall is the same in any steps, so the boulder is where it was with short ones when it touches.
        span = "time: {end: 36 ms}\noutput: {fields_every: ~}\n"
        short = Run("examples/cable_net_free_flight", span)
        for step in ("0.5 ms", "2 ms"):
            with self.subTest(step):
                long = Run("examples/cable_net_free_flight", span + f"particles: {{step: {step}}}\n")
                self.assertGreater(long.summary["free_flight"]["regular_windows_spared"], 5000)
                off = long.column("boulder.position_z_m") - short.column("boulder.position_z_m")
                self.assertLess(np.abs(off).max(), 1e-9)

    def test_windows_grow_only_where_both_sides_have_steps_of_their_own(self):
        run = Run("examples/cable_net", "time: {step: ~}\nstructure: {step: 50 us}\ncoupling: {window: 50 us, longest_window: 1 ms}\n")
        self.assertEqual(run.done.returncode, 2)
        self.assertIn("windows grow only where both sides have steps of their own", run.done.stderr)


class HalvedWindows(unittest.TestCase):
    """Plain iteration diverges above 2 sqrt(m/k) and 2 m/c; the dashpot of the boulder on a node of 0.03 kg allows some 50 us."""

    SPAN = "time: {end: 42 ms, step: 6.25 us}\noutput: {fields_every: ~, every: 0.4 ms}\n"
    STRONG = ("coupling:\n  serial_explicit: ~\n  window: 0.4 ms\n  serial_implicit: {iterations: 15, %s, "
              "tolerance: {relative: 1e-4, displacement: 1e-9 m, velocity: 1e-5 m/s, force: 1e-3 N}}\n")

    def test_windows_that_diverge_are_rescued_by_halving(self):
        halved = Run("examples/cable_net", self.SPAN + self.STRONG % "shortest_window: 6.25 us")
        fine = Run("examples/cable_net", self.SPAN)
        iterations = halved.summary["iterations"]
        self.assertGreater(iterations["windows_halved"], 0)
        self.assertEqual(iterations["windows_not_converged"], 0)
        self.assertLess(iterations["shortest_window_s"], 0.1e-3)
        # The weak run at 6.25 us is within 1e-4 of its own limit (docs/step_limits.md); so are windows converged to 1e-4.
        for name in ("net_centre.displacement_z_m", "boulder.velocity_z_m_per_s"):
            off = np.abs(halved.column(name) - fine.column(name)).max()
            self.assertLess(off, 1e-3 * np.abs(fine.column(name)).max(), name)
        self.assertLess(halved.energy_error(), 1e-4)

    def test_without_halving_the_same_run_ends_with_the_window_and_the_field_that_did_not_converge(self):
        run = Run("examples/cable_net", self.SPAN + self.STRONG % "not_converged: error")
        self.assertEqual(run.done.returncode, 4)
        self.assertIn("has not converged after 15 iterations of window", run.done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
