"""Inputs from the field about coupling: tests/field/README.md says what is right for each."""
import unittest

from scene_run import ROOT, Run

FIELD = ROOT / "tests" / "field"


def field(path: str, program: str = "talus") -> Run:
    return Run(FIELD / f"{path}.yaml", program=program)


class Ends(unittest.TestCase):
    def test_a_run_ends_at_its_end_in_equal_steps_alone_and_coupled(self):
        # 1 s in steps of at most 0.3 s: four of 0.25 s, of which nobody has another idea.
        for path, program in [("alone_dem_0.3s", "dem_solver"), ("alone_fem_0.3s", "fem_solver"), ("not_dividing_end", "talus")]:
            with self.subTest(path):
                run = field(f"ends/{path}", program)
                self.assertAlmostEqual(run.column("time_s")[-1], 1, delta=1e-12)
                self.assertIn("cut into 4 equal ones of 250 ms", run.done.stderr)


class HeldNodes(unittest.TestCase):
    def test_a_node_is_held_by_one_entry_as_by_two(self):
        one, two = field("held_nodes/parallel_iqn_held"), field("held_nodes/parallel_iqn_split")
        self.assertEqual(one.summary["iterations"]["windows_not_converged"], 0)
        self.assertEqual(one.peak("c.displacement_z_m"), two.peak("c.displacement_z_m"))

    def test_columns_of_old_windows_do_not_mislead(self):
        remembers, forgets = field("held_nodes/stale_columns_default"), field("held_nodes/stale_columns_windows0")
        for run in (remembers, forgets):
            self.assertEqual(run.summary["iterations"]["windows_not_converged"], 0)
        # -0.113 m; converged to 1e-6 in each of 500 windows.
        self.assertAlmostEqual(remembers.peak("c.displacement_z_m"), forgets.peak("c.displacement_z_m"), delta=1e-4 * 0.113)
        self.assertLess(remembers.summary["iterations"]["mean"], forgets.summary["iterations"]["mean"])


class Static(unittest.TestCase):
    def test_a_static_structure_beside_particles_is_refused(self):
        for path in ("c_static", "d_static_0.2ms_5"):
            done = field(f"static_in_coupled/{path}").done
            self.assertEqual(done.returncode, 2)
            self.assertIn("structure.static: a static structure has no time to go through together with `particles`", done.stderr)


class UnequalSteps(unittest.TestCase):
    PEAK, ENERGY = 0.250946, 3200  # m, J; of the undivided system

    def test_windows_of_a_millisecond_keep_the_peak_and_the_energy(self):
        # 1 ms is a ninth of the contact's period on the post. One step a window on a side is coarse for that side itself, whatever the other does.
        for path, peak, energy in [("implicit_structure_1_16_1000us", 1e-3, 0.002), ("serial_implicit_1000.0us_16", 1e-3, 0.002),
                                   ("one_side_serial_implicit_1_16_1000us", 0.02, 0.05), ("one_side_serial_implicit_16_1_1000us", 0.01, 0.15)]:
            with self.subTest(path):
                run = field(f"unequal_steps/{path}")
                self.assertAlmostEqual(run.peak("b.displacement_z_m"), self.PEAK, delta=peak * self.PEAK)
                self.assertLess(abs(run.summary["energy"]["error_J"]), energy * self.ENERGY)


if __name__ == "__main__":
    unittest.main(argv=["field_coupling"])
