"""A structural solver with an element of its own, alone and in a coupled run.

Arguments: the folder of the repository, the folder of the build."""
import sys
import unittest

from scene_run import BUILD, ROOT, Run

CORD = ROOT / "examples" / "elements" / "rubber_cord.yaml"


class RubberCord(unittest.TestCase):
    def test_a_weight_falls_as_deep_as_its_energy_says(self):
        run = Run(CORD, program="rubber_solver")
        # Four cords of k, h in a row, each stretched by d/4: 20 kg x g x d = 4 (k (d/4)^2/2 + h (d/4)^4/4); the cords' own 0.2 kg beside.
        def left(d: float) -> float:
            return 4 * (4000 * (d / 4) ** 2 / 2 + 2e5 * (d / 4) ** 4 / 4) - 20.05 * 9.81 * d

        low, high = 0.05, 2.0
        for _ in range(60):
            low, high = ((low + high) / 2, high) if left((low + high) / 2) < 0 else (low, (low + high) / 2)
        self.assertAlmostEqual(run.peak("weight.displacement_z_m"), low, delta=0.01 * low)
        self.assertLess(run.energy_error(), 1e-3)

    def test_the_solver_without_the_element_says_so(self):
        refused = Run(CORD, program="fem_solver")
        self.assertEqual(refused.done.returncode, 2)
        self.assertIn("has no element 'rubber_cord'", refused.done.stderr)

    def test_it_plays_the_structure_of_a_coupled_scene(self):
        net = ("structure: {solver: '%s', parts: {net: {cable: ~, user_element: {name: rubber_cord, parameters: [2e4, 0, 0.1]}}}}\n"
               "time: {end: 60 ms}\noutput: {fields_every: ~}\n" % (BUILD / "bin" / "rubber_solver"))
        run = Run("examples/cable_net_converged", net)
        self.assertGreater(run.peak("net_centre.displacement_m"), 0.05)
        self.assertLess(run.energy_error(), 0.05)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
