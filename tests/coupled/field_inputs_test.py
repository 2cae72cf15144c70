"""Inputs as people write them (tests/field), run by the programs: read as they are meant, or refused before time 0 with the reason. Each folder is a
kind of fault; unit tests of the same kinds have more members.

Arguments: the folder of the repository, the folder of the build."""
import math
import pathlib
import unittest

from scene_run import ROOT, Run

FIELD = pathlib.Path(ROOT, "tests/field").resolve()


def run(scene: str, program: str) -> Run:
    return Run(FIELD / f"{scene}.yaml", program=program)


class Inputs(unittest.TestCase):
    def refused(self, scene: str, program: str, *words: str) -> None:
        with self.subTest(scene=scene):
            tried = run(scene, program)
            self.assertEqual(tried.done.returncode, 2, tried.done.stderr)
            for word in words:
                self.assertIn(word, tried.done.stderr)
            self.assertFalse((tried.result / "energy.csv").exists(), "something was computed")


class Units(Inputs):
    def test_angles_frequencies_and_lost_prefixes_are_refused_with_what_to_write(self):
        self.refused("units/a_30deg", "dem_solver", "friction.coefficient", "expects a plain number, got '30 deg'", "0.57735")
        self.refused("units/b_3Hz", "dem_solver", "rocks.block.spin[2]", "a frequency", "'3 turn/s'")
        self.refused("units/c_mPa", "fem_solver", "youngs_modulus", "'1770 mPa' is 1.77 Pa", "MPa")
        self.refused("units/f_deg", "dem_solver", "poissons_ratio", "got '14 deg', which is an angle")

    def test_turns_a_minute_are_an_angular_velocity(self):
        self.assertAlmostEqual(run("units/b_rpm", "dem_solver").column("block.spin_z_rad_per_s")[0], 3 * 2 * math.pi / 60, places=12)


class Grids(Inputs):
    def test_dialects_are_read(self):
        ends = {}
        for grid in ("a_nan", "b_dx_dy", "d_nodata_float", "j_bom"):
            with self.subTest(grid=grid):
                ends[grid] = run(f"grids/{grid}", "dem_solver").column("ball.position_x_m")[-1]
        self.assertEqual(ends["b_dx_dy"], ends["j_bom"])

    def test_voids_degrees_and_decimal_commas_are_refused_with_line_and_reason(self):
        self.refused("grids/e_void_small_step", "dem_solver", "e_void_small_step.asc:6:", "-32768 in row 1, column 1, at (1, 7)", "NODATA_value")
        self.refused("grids/f_degrees", "dem_solver", "f_degrees.asc:6:", "degrees of longitude and latitude")
        self.refused("grids/h_comma", "dem_solver", "h_comma.asc:6:", "'101,5'", "decimals need a point")


class Ropes(Inputs):
    def test_friction_on_a_closed_rope_is_refused(self):
        self.refused("closed_rope/ring_closure_0.2_1", "fem_solver", "structure.parts.ring", "closes on itself")

    def test_a_support_rope_of_a_barrier_with_friction_runs_to_its_end(self):
        result = run("barrier/repro_rope_friction_nan", "fem_solver")
        self.assertEqual(result.done.returncode, 0, result.done.stderr)
        self.assertEqual(result.summary["status"], "finished")


class Newton(Inputs):
    def test_forces_that_vanish_are_an_equilibrium(self):
        result = run("newton/membrane_relax_x_6_0", "fem_solver")
        self.assertEqual(result.done.returncode, 0, result.done.stderr)
        self.assertTrue(any(abs(values[-1] + 0.18581489429548) < 1e-9 for values in result.columns.values()))
        # the bar's end goes along x alone, to where it has the length L sqrt(1 - 2 S/E)
        length, prestrain = math.hypot(1.3, 0.7), 3e9 / 210e9
        x = math.sqrt(length**2 * (1 - 2 * prestrain) - 0.7**2)
        for scene in ("released_bar_1", "released_bar_implicit_1"):
            result = run(f"newton/{scene}", "fem_solver")
            self.assertEqual(result.done.returncode, 0, result.done.stderr)
            self.assertAlmostEqual(result.column("e.displacement_x_m")[-1], x - 1.3, places=10)

    def test_a_string_swings_through_straight(self):
        result = run("newton/slack_mass_fail", "fem_solver")
        self.assertEqual(result.done.returncode, 0, result.done.stderr)


class Energy(Inputs):
    def test_a_slider_at_rest_dissipates_nothing(self):
        for column, values in {name: run("slider_damping/constraint_damping_100_0.001", "fem_solver").energy(name)
                               for name in ("structure.bulk_damping_J", "error_J")}.items():
            self.assertLess(max(abs(v) for v in values), 1e-9, column)  # of 57.7 J that the unprojected velocities would take

    def test_a_sheared_film_gets_the_work_of_its_edge_and_no_more(self):
        result = run("wrinkles_implicit/implicit_panel_tf_rho0", "fem_solver")  # radius 1: unit/fem_solver/implicit_test.cpp
        self.assertEqual(result.done.returncode, 0, result.done.stderr)
        self.assertAlmostEqual(result.energy("structure.elastic_m_J")[-1], 0.0956549, delta=1e-6)


class Probes(Inputs):
    def test_a_probe_far_from_every_node_is_refused_with_its_distance(self):
        self.refused("probes/metres_for_mm", "talus", "output.probes.net_centre.at", "2117 m from")

    def test_the_summary_says_which_node_a_probe_between_two_watches(self):
        watches = run("probes/between", "talus").summary["probes"]["net_centre"]
        self.assertRegex(watches, r"node \d+ of net at \(1\.(5|65), 1\.5, 0\) m, 75 mm from the point asked for")


class Orthotropic(Inputs):
    def test_what_differs_by_direction_needs_its_axis(self):
        for scene, what in (("iso_pre_A", "prestress"), ("iso_pre_B", "prestress"), ("ortho_none_A", "stiffness"), ("ortho_none_B", "stiffness"),
                            ("outline_0_none", "stiffness"), ("outline_1_none", "stiffness")):
            self.refused(f"orthotropic/{scene}", "fem_solver", "needs `material_axis`", f"the {what} differs by direction")

    def test_with_an_axis_the_sheet_is_pulled_by_force_over_stiffness(self):
        # 1000 N on 1 m x 1 mm: S = 1 MPa x 1/(1 + e) on E = 1e8 Pa, E_green = e + e^2/2.
        stretch = run("orthotropic/ortho_x_A", "fem_solver").column("a.displacement_x_m")[-1]
        self.assertAlmostEqual((1 + stretch) * (stretch + stretch**2 / 2) * 1e8, 1e6, delta=1)


class StartsInside(Inputs):
    def test_every_body_is_named_with_its_partner_and_depth_before_time_0(self):
        for scene, words in (("a_inside_plane", ("spheres.ball", "plane `floor`", "200 mm")),
                             ("a_inside_triangles", ("spheres.ball", "face of `floor`", "200 mm")),
                             ("c_below_triangles", ("spheres.ball", "below a face of `floor`", "800 mm")),
                             ("d_centre_on_wire", ("spheres.ball", "wire of `w`", "505 mm")),
                             ("e_stream_in_floor", ("streams.a", "of its spheres", "plane `floor`")),
                             ("f_rock_in_plane", ("rocks.ball", "plane `floor`", "300 mm"))):
            self.refused(f"starts_inside/{scene}", "dem_solver", *words)

    def test_a_boulder_in_the_net_of_a_coupled_run_is_named_too(self):
        self.refused("starts_inside/g_coupled_overlaps_net", "talus", "particles.spheres.boulder: starts inside of a wire of `net`, by 43.49 mm")


class BarrierTraps(Inputs):
    """Mistakes of who writes a barrier by hand: the run goes on, as each could be meant."""

    def warned(self, scene: str, *words: str) -> None:
        tried = Run(FIELD / f"barrier/{scene}.yaml", "time: {end: 0.1 ms}\noutput: {fields_every: ~, every: 0.1 ms}\n")
        self.assertEqual(tried.done.returncode, 0, tried.done.stderr)
        for word in words:
            self.assertIn(word, tried.done.stderr)

    def test_an_end_that_misses_its_post_is_named_with_its_distance(self):
        self.warned("trap_loose_rope_end", "structure: node", "of retaining_2w", "and is not joined with it: weld.tolerance is 1 mm")

    def test_posts_swapped_in_a_rope_are_named_where_it_turns_back(self):
        self.warned("trap_rope_order", "structure.parts.upper: the rope turns back at")


if __name__ == "__main__":
    unittest.main(argv=["field_inputs_test"])
