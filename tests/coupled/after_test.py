"""The next impact without repair: a structure that goes on from where another run has left it.

Arguments: the folder of the repository, the folder of the build."""
import sys
import unittest

import numpy as np
from scene_run import Run

BRAKED, NET = "examples/braked_rope", "examples/perforated_net"
KEEP = "output: {final_state: {}, fields_every: ~}\n"


def after(first: Run, more: str = "", instead_of: str = "", also: str = "") -> str:
    return f"structure: {{{also}start: {{{instead_of}after: {{state: '{first.result}/structure_state.h5'{more}}}}}}}\n"


class Alone(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.first = Run(BRAKED, KEEP, program="fem_solver")

    def test_what_has_run_out_yielded_and_slipped_stays_so(self):
        second = Run(BRAKED, after(self.first) + "time: {end: 1 ms}\noutput: {fields_every: ~}\n", program="fem_solver")
        for column in ("brake.travel_max_m", "stay.plastic_strain_max_1"):
            self.assertGreater(self.first.column(column)[-1], 0)
            # It comes to rest from where it was, which may let a brake run a little further, never back.
            self.assertGreaterEqual(second.column(column)[0], self.first.column(column)[-1])
            self.assertLess(second.column(column)[0], 1.2 * self.first.column(column)[-1])

    def test_it_comes_to_rest_first(self):
        second = Run(BRAKED, after(self.first, also="initial_velocities: [], ") + "time: {end: 20 ms}\noutput: {fields_every: ~}\n", program="fem_solver")
        self.assertLess(second.energy("structure.kinetic_J").max(), 1e-6 * self.first.energy("structure.kinetic_J").max())

    def test_a_run_that_goes_on_is_the_run_in_one_piece(self):
        half = Run(BRAKED, KEEP + "time: {end: 0.25 s}\n", program="fem_solver")
        rest = Run(BRAKED, after(half, ", motion: goes_on", also="initial_velocities: [], ") + "time: {end: 0.25 s}\noutput: {fields_every: ~}\n", program="fem_solver")
        whole = self.first
        # The start of a leapfrog takes the velocity as that of its time, half a step off: of first order in the step of 20 us.
        a, b = rest.at("weight.displacement_z_m", 0.2), whole.at("weight.displacement_z_m", 0.45)
        self.assertAlmostEqual(a, b, delta=2e-3 * abs(b))

    def test_velocities_of_both_the_scene_and_the_other_run_are_refused(self):
        refused = Run(BRAKED, after(self.first, ", motion: goes_on"), program="fem_solver")
        self.assertEqual(refused.done.returncode, 2)
        self.assertIn("which has velocities of its own", refused.done.stderr)

    def test_another_structure_and_a_result_without_a_state_are_refused(self):
        other = Run("examples/hanging_net", after(self.first), program="fem_solver")
        self.assertEqual(other.done.returncode, 2)
        self.assertRegex(other.done.stderr, "belongs to another scene|nodes at other places")
        without = Run(BRAKED, "time: {end: 1 ms}\n", program="fem_solver")
        refused = Run(BRAKED, after(without), program="fem_solver")
        self.assertEqual(refused.done.returncode, 2)
        self.assertRegex(refused.done.stderr, "structure.start.after.state: no such file: .*structure_state.h5")


class Coupled(unittest.TestCase):
    def test_a_second_boulder_falls_through_the_hole_of_the_first(self):
        first = Run(NET, KEEP)
        second = Run(NET, after(first, ", tolerance: 1e-3", "equilibrium: ~, ") + "time: {end: 40 ms}\noutput: {fields_every: ~}\n")
        self.assertGreaterEqual(second.column("net.broken_1")[0], first.column("net.broken_1")[-1])
        fresh = Run(NET, "time: {end: 40 ms}\noutput: {fields_every: ~}\n")
        loss = {name: 20 + run.column("boulder.velocity_z_m_per_s").max() for name, run in (("second", second), ("fresh", fresh))}
        self.assertLess(np.abs(second.column("boulder.contact_force_z_N")).max(), 0.5 * np.abs(fresh.column("boulder.contact_force_z_N")).max())
        self.assertLess(loss["second"], 0.5 * loss["fresh"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
