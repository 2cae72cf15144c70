"""Structures that break, the particles that fall through, and the largest forces of a run.

Arguments: the folder of the repository, the folder of the build."""
import sys
import unittest

import numpy as np
from scene_run import Run

NET = "examples/perforated_net"
LOAD = 4000.0  # N


class Perforation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.through = Run(NET, "output: {fields_every: ~}\n")

    def test_the_boulder_falls_through_the_hole(self):
        self.assertLess(self.through.column("boulder.position_z_m")[-1], -0.7)
        self.assertLess(self.through.column("boulder.velocity_z_m_per_s")[-1], -19)
        behind = self.through.column("boulder.position_z_m") < -0.5
        self.assertEqual(np.abs(self.through.column("boulder.contact_force_z_N")[behind]).max(), 0)

    def test_a_net_that_bears_more_stops_it(self):
        held = Run(NET, "structure: {parts: {net: {cable: {breaks: {force: 100 kN}}}}}\noutput: {fields_every: ~}\n")
        self.assertEqual(held.column("net.broken_1")[-1], 0)
        self.assertGreater(held.column("boulder.velocity_z_m_per_s")[-1], self.through.column("boulder.velocity_z_m_per_s")[-1] + 5)

    def test_the_summary_says_which_wire_broke_first_when_and_at_what_force(self):
        first = self.through.summary["tables"]["ruptures"]["net"]
        self.assertEqual(first["broken"], self.through.column("net.broken_1")[-1])
        self.assertGreater(first["first_force_N"], LOAD)
        self.assertLess(first["first_force_N"], 1.1 * LOAD)
        # Beside the boulder, not at the rim.
        self.assertLess(np.hypot(first["first_x_m"] - 1.45, first["first_y_m"] - 1.55), 0.5)
        broken = self.through.column("net.broken_1")
        row = np.flatnonzero(broken)[0]
        self.assertLessEqual(first["first_time_s"], self.through.column("time_s")[row])
        self.assertGreaterEqual(first["first_time_s"], self.through.column("time_s")[row - 1] - 4e-5)

    def test_the_energy_of_what_broke_is_a_line_of_the_ledger_and_the_balance_holds(self):
        lost = self.through.energy("structure.dissipated_net_J")
        self.assertEqual(lost[0], 0)
        self.assertTrue((np.diff(lost) >= 0).all())
        # Each wire stores N^2 L/(2 E A) when it breaks: at least 4 kN, 0.15 m, 20 GPa x 12.566 mm^2.
        at_least = LOAD**2 * 0.15 / (2 * 20e9 * 12.566e-6)
        self.assertGreater(lost[-1], 0.99 * at_least * self.through.column("net.broken_1")[-1])
        self.assertLess(self.through.energy_error(), 2e-3)

    def test_every_scheme_and_method_breaks_it(self):
        for changes in ("coupling: {serial_explicit: ~, parallel_explicit: {}}\n",
                        "coupling: {serial_explicit: ~, serial_implicit: {}}\nparticles: {implicit_contact: ~}\n",
                        "structure: {implicit: {}}\nparticles: {implicit_contact: ~}\n",
                        "structure: {parts: {net: {cable: ~, elastic_plastic_cable: {area: 12.566 mm^2, density: 7850 kg/m^3, youngs_modulus: 20 GPa, "
                        "prestress: 5 MPa, yield_stress: 200 MPa, hardening: 1 GPa, breaks: {strain: 0.05}}}}}\n"):
            with self.subTest(changes):
                run = Run(NET, changes + "time: {end: 50 ms}\noutput: {fields_every: ~}\n")
                self.assertGreaterEqual(run.column("net.broken_1")[-1], 4)
                self.assertLess(run.column("boulder.position_z_m")[-1], -0.4)
                self.assertLess(run.energy_error(), 2e-2)

    def test_a_run_that_goes_on_from_a_checkpoint_ends_like_the_one_in_one_piece(self):
        half = Run(NET, "time: {end: 20 ms}\noutput: {fields_every: ~}\ncoupling: {checkpoint_every: 10 ms}\n")
        self.assertGreater(half.column("net.broken_1")[-1], 0)
        rest = Run(NET, "output: {fields_every: ~}\ncoupling: {checkpoint_every: 10 ms}\n", options=("--restart", str(half.result / "checkpoint.h5")))
        for column in ("boulder.velocity_z_m_per_s", "net.broken_1", "net.axial_force_max_N"):
            self.assertEqual(rest.column(column)[-1], self.through.column(column)[-1])
        self.assertEqual(rest.summary["tables"], self.through.summary["tables"])

    def test_a_block_of_many_balls_falls_through_too(self):
        block = ("particles: {spheres: {boulder: ~}, rocks: {boulder: {block: {edge: 0.4 m}, material: rock, at: [1.45, 1.55, 0.3], velocity: [0, 0, -20], "
                 "turned: [0.3, 0.2, 0.1]}}}\noutput: {fields_every: ~}\n")
        run = Run(NET, block)
        self.assertLess(run.column("boulder.position_z_m")[-1], -0.5)
        self.assertGreater(run.column("net.broken_1")[-1], 4)
        self.assertLess(run.energy_error(), 2e-2)

    def test_a_boundary_with_other_cells_is_refused(self):
        refused = Run(NET, "interface: {boundary: {same_as_structure: ~, square_net: {corner: [0 m, 0 m, 0 m], size: [3 m, 3 m], pitch: 0.3 m, "
                           "wire_diameter: 4 mm, material: wire}}}\n")
        self.assertEqual(refused.done.returncode, 2)
        self.assertIn("write `same_as_structure`", refused.done.stderr)

    def test_breaks_without_a_limit_is_refused(self):
        refused = Run("examples/hanging_net", "structure: {parts: {net: {cable: {breaks: {}}}}}\n", program="fem_solver")
        self.assertEqual(refused.done.returncode, 2)
        self.assertIn("needs one of `force`, `strain` and `work`", refused.done.stderr)


class LargestForces(unittest.TestCase):
    def test_they_are_those_of_all_steps_not_of_the_rows_that_are_written(self):
        each = Run("examples/cable_net_strong", "time: {end: 100 ms}\noutput: {every: 1e-9 s, fields_every: ~, largest_forces: {}, probes: {net: {part: net}}}\n")
        few = Run("examples/cable_net_strong", "time: {end: 100 ms}\noutput: {every: 20 ms, fields_every: ~, largest_forces: {}, probes: {net: {part: net}}}\n")
        largest = few.summary["tables"]["largest_forces"]["net"]
        self.assertEqual(largest, each.summary["tables"]["largest_forces"]["net"])
        column = each.column("net.axial_force_max_N")
        # Rows have the displacement, forces in the record belong to a step's beginning: the same moments but for the last.
        self.assertAlmostEqual(largest["tension_N"], column[:-1].max(), delta=1e-12 * column.max())
        self.assertGreater(largest["tension_N"], 1.001 * few.column("net.axial_force_max_N").max())

    def test_the_compression_of_posts_and_the_pull_of_anchors_are_there(self):
        run = Run("examples/stayed_posts", "output: {largest_forces: {}}\n", program="fem_solver")
        forces, anchors = run.summary["tables"]["largest_forces"], run.summary["tables"]["support_forces"]
        self.assertGreater(forces["west_post"]["compression_N"], 1e4)
        self.assertEqual(forces["rope"]["compression_N"], 0)
        # The rope's pull down and in, at the post's head, is borne by post and stays: the anchor feels its stay alone.
        stay, anchor = forces["north_west_stay"]["tension_N"], anchors["north_west_stay.start"]
        self.assertAlmostEqual(anchor["force_N"], stay, delta=0.01 * stay)
        # A reaction points away from where the stay pulls to: (1.5, -1, 2) from the anchor, lengthwise.
        pull = np.array([1.5, -1, 2]) / np.sqrt(1.5**2 + 1 + 4)
        self.assertAlmostEqual(np.dot(pull, [anchor["x_N"], anchor["y_N"], anchor["z_N"]]) / anchor["force_N"], -1, delta=1e-3)

    def test_a_force_over_the_breaking_load_is_the_utilisation(self):
        run = Run("examples/sliding_rope_static", "output: {largest_forces: {}}\nstructure: {parts: {rope: {sliding_cable: {breaking_load: 20 kN}}}}\n",
                  program="fem_solver")
        used = run.summary["tables"]["utilisation"]["rope"]
        self.assertEqual(used["breaking_load_N"], 20e3)
        self.assertAlmostEqual(used["utilisation"], run.summary["tables"]["largest_forces"]["rope"]["tension_N"] / 20e3, places=12)
        self.assertGreater(used["utilisation"], 0)

    def test_the_compression_of_a_post_is_compared_with_its_buckling_load(self):
        post = "structure: {parts: {west_post: {bar: {second_moment: 100 cm^4}}}}\n"
        run = Run("examples/stayed_posts", "output: {largest_forces: {}}\n" + post, program="fem_solver")
        row = run.summary["tables"]["buckling"]["west_post"]
        self.assertAlmostEqual(row["buckling_load_N"], np.pi**2 * 210e9 * 100e-8 / 2.0**2, delta=1)  # E I of a post of 2 m
        self.assertEqual(row["compression_N"], run.summary["tables"]["largest_forces"]["west_post"]["compression_N"])
        self.assertNotIn("east_post", run.summary["tables"]["buckling"])

    def test_nothing_is_recorded_where_nobody_asks(self):
        self.assertEqual(Run("examples/sliding_rope_static", program="fem_solver").summary["tables"], {})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
