"""Files of geometry as they come from other programs (tests/field): each scene gives the result that theory, or the same geometry written in
another way, gives; or it is refused in one line.

Arguments: the folder of the repository, the folder of the build."""
import math
import sys
import unittest

from scene_run import ROOT, Run

FIELD = ROOT / "tests" / "field"


def run(scene: str, program: str) -> Run:
    return Run(FIELD / f"{scene}.yaml", program=program)


class Surfaces(unittest.TestCase):
    def test_a_sheet_in_two_solids_or_two_materials_is_as_stiff_as_one_in_one_object(self):
        plain = run("surfaces/a_plain_obj", "fem_solver").column("far.displacement_x_m")[-1]
        self.assertAlmostEqual(plain, 9.1668e-3, delta=1e-7)
        for scene in ("a_usemtl_obj", "a_stl_two_solids_stl"):
            with self.subTest(scene):
                # The corners' order differs, and with it the order of sums.
                self.assertAlmostEqual(run(f"surfaces/{scene}", "fem_solver").column("far.displacement_x_m")[-1], plain, delta=1e-9 * plain)

    def test_a_cube_of_two_materials_is_a_rock_of_one_cubic_metre(self):
        energy = run("surfaces/b_cube_two_materials", "dem_solver").column("rock.kinetic_energy_J")[0]
        self.assertAlmostEqual(energy, 0.5 * 1000 * 1.0 * 1.0**2, places=9)

    def test_a_ball_is_held_by_edges_beside_a_face(self):
        # It touches the wire 0.1095 m above its axis after 0.09 s, gives way by some 5 mm and bounces; free, it would be at 0.04 m by now.
        held = run("surfaces/c_edges_ball", "dem_solver")
        self.assertGreater(held.column("ball.position_z_m")[held.column("time_s") <= 0.15].min(), 0.1)
        self.assertGreater(held.peak("ball.contact_force_z_N"), 100)


class MapCoordinates(unittest.TestCase):
    def test_a_ball_rolls_the_same_on_terrain_of_a_surface_file_and_of_a_grid(self):
        slope = math.hypot(1, 0.2)  # the terrain rises by 0.2
        rolled = {}
        for scene in ("map_obj", "map_asc"):
            x = run(f"map_coordinates/{scene}", "dem_solver").column("ball.position_x_m")
            rolled[scene] = (x[0] - x[-1]) * slope
        # 5/7 g sin(a), less what the contact gives way.
        self.assertAlmostEqual(rolled["map_obj"], 2 * 1.3713, delta=2e-3)
        self.assertAlmostEqual(rolled["map_obj"], rolled["map_asc"], delta=1e-6)


class Gmsh(unittest.TestCase):
    def test_a_rope_whose_group_is_signed_second_or_partitioned_is_the_whole_rope(self):
        plain = run("gmsh/plain_rope", "fem_solver").column("far.displacement_x_m")[-1]
        for scene in ("signed_rope", "order97_rope", "partitioned"):
            with self.subTest(scene):
                self.assertEqual(run(f"gmsh/{scene}", "fem_solver").column("far.displacement_x_m")[-1], plain)

    def test_a_sheet_of_which_a_half_is_listed_with_a_negative_number_is_whole(self):
        # F = E t s (1 + s) (1 + s / 2) at a stretch of 1 + s: 1000 N over 1 m by 1 mm, St. Venant and Kirchhoff's law.
        stretch = run("gmsh/tri_turned_tag", "fem_solver").column("far.displacement_x_m")[-1]
        self.assertAlmostEqual(1e8 * 1e-3 * stretch * (1 + stretch) * (1 + stretch / 2), 1000, delta=1e-3)

    def test_a_group_name_with_a_comma_is_refused_in_one_line_that_names_the_file_and_the_line(self):
        refused = run("gmsh/col_comma", "fem_solver").done
        self.assertEqual(refused.returncode, 2)
        self.assertEqual(len(refused.stderr.strip().splitlines()), 1)
        self.assertIn("col_comma.msh:6", refused.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
