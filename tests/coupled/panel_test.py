"""The paper's panel under the same rock, computed in different ways (its figures 4, 6, 8 and 9): what it says about them, as inequalities.

Arguments: the folder of the repository, the folder of the build."""
import sys
import unittest

import numpy as np

from scene_run import Run

SCENES = ("net_sliding_edges", "membrane_plain", "membrane_tension_field")
STIFF_SPRINGS = "time: {step: 18 us}\nstructure: {slides: {%s}}\n" % ", ".join(
    f"edge_{side}: {{penalty: {{stiffness: 2e7}}}}" for side in ("south", "east", "north", "west"))
OTHER_WAYS_TO_SLIDE = ("net_penalty_edges", "net_mpc_edges")
ROPES = ("south", "east", "north", "west")


class RockOnPanel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = {scene: Run(f"examples/{scene}") for scene in SCENES + OTHER_WAYS_TO_SLIDE}
        cls.stiff_springs = Run("examples/net_penalty_edges", STIFF_SPRINGS)

    def deflection(self, scene: str) -> float:
        return -min(self.runs[scene].column("middle.displacement_z_m"))

    def test_every_panel_throws_the_rock_back(self):
        for scene, run in self.runs.items():
            with self.subTest(scene=scene):
                self.assertEqual(run.summary["status"], "finished")
                self.assertGreater(max(run.column("boulder.velocity_z_m_per_s")), 0)  # it bounces

    def test_the_energy_balance_closes(self):
        # The contact's own error, see cable_net_test.py, is relative to the rock's energy.
        for scene, run in self.runs.items():
            with self.subTest(scene=scene):
                self.assertLess(run.energy_error(), 0.03)

    def test_edge_ropes_carry_the_net_and_their_meshes_slide_inwards(self):
        for scene, run in self.runs.items():
            with self.subTest(scene=scene):
                self.assertGreater(max(run.column("south.axial_force_max_N")), 1000)
                self.assertGreater(max(run.column("edge.displacement_y_m")), 0.01)

    def test_compression_makes_the_plain_membrane_stiffer_than_the_net_and_the_tension_field_does_not(self):
        net, plain, field = (self.deflection(scene) for scene in SCENES)
        self.assertLess(plain, field)
        self.assertLess(abs(field - net), abs(plain - net))

    def test_three_ways_of_sliding_give_one_deflection(self):
        # The polygon of the rope is another one: 5 %. Springs leave a gap on top of it.
        net = self.deflection("net_sliding_edges")
        for scene in OTHER_WAYS_TO_SLIDE:
            with self.subTest(scene=scene):
                gap = max(self.runs[scene].column("edge_south.gap_max_m"))
                self.assertAlmostEqual(self.deflection(scene), net, delta=0.05 * net + gap)

    def test_stiff_springs_and_constraints_give_the_same_deflection(self):
        # Springs of 2e7 N/m leave a gap of half a millimetre.
        springs = -min(self.stiff_springs.column("middle.displacement_z_m"))
        self.assertAlmostEqual(springs, self.deflection("net_mpc_edges"), delta=0.005 * springs)

    def test_springs_leave_the_gap_of_their_force_and_constraints_none(self):
        springs, constraints = (self.runs[scene] for scene in OTHER_WAYS_TO_SLIDE)
        for gap, force in zip(springs.column("edge_south.gap_max_m"), springs.column("edge_south.slide_force_max_N")):
            self.assertAlmostEqual(gap, force / 200e3, delta=1e-12)
        self.assertGreater(max(springs.column("edge_south.gap_max_m")), 0.01)
        self.assertLess(max(constraints.column("edge_south.gap_max_m")), 1e-3)

    def test_the_tension_field_wrinkles_and_the_plain_membrane_presses(self):
        self.assertGreater(max(self.runs["membrane_tension_field"].column("net.wrinkled_area_m2")), 1)
        self.assertEqual(max(self.runs["membrane_plain"].column("net.wrinkled_area_m2")), 0)

    def test_supports_hold_what_the_rock_and_the_panel_push(self):
        # Downwards on the panel is upwards on the supports, and the impulse of both agrees with the rock's change of momentum.
        run = self.runs["net_sliding_edges"]
        times = run.column("time_s")
        reaction = sum(run.column(f"{rope}.{end}.reaction_z_N") for rope in ROPES for end in ("start", "end"))
        impulse = np.trapz(reaction, times)
        mass = 4 / 3 * 3.141592653589793 * 0.2**3 * 2500
        velocity = run.column("boulder.velocity_z_m_per_s")
        expected = mass * (velocity[-1] - velocity[0] + 9.81 * times[-1])
        self.assertAlmostEqual(impulse, expected, delta=0.1 * abs(expected))  # the net's own momentum, and rows 0.5 ms apart


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
