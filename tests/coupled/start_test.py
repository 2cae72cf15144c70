"""A structure that starts at rest under its weight, before particles reach it.

Arguments: the folder of the repository, the folder of the build."""
import sys
import unittest

import numpy as np
from scene_run import Run

SCENE = "examples/hung_net"
SAG = 0.0196  # m; of the middle: q a^2/(13.57 T) of a square membrane = 12.9 Pa x 9 m^2/(13.57 x 419 N/m) = 0.0204 m, less for the net's stretch
FROM_THE_SHAPE = "structure: {start: ~}\n"


def first_touch(run: Run) -> float:
    """s; the first row in which the net gives way, less the half millisecond between rows."""
    moved = np.abs(run.column("middle.displacement_z_m") - run.column("middle.displacement_z_m")[0]) > 1e-4
    return run.column("time_s")[np.flatnonzero(moved)[0]] - 0.25e-3


class HungNet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hung = Run(SCENE)

    def test_nothing_of_the_net_moves_before_the_touch(self):
        before = self.hung.column("time_s") < first_touch(self.hung) - 1e-3
        self.assertGreater(before.sum(), 20)
        rock = self.hung.energy("particles.kinetic_J")[0]
        self.assertLess(np.abs(self.hung.energy("structure.kinetic_J")[before]).max(), 1e-6 * rock)
        flat = Run(SCENE, FROM_THE_SHAPE + "time: {end: 10 ms}\n")
        self.assertGreater(flat.energy("structure.kinetic_J").max(), 1e-5 * rock)
        self.assertAlmostEqual(self.hung.column("middle.displacement_z_m")[0], -SAG, delta=1e-3)

    def test_the_supports_bear_its_weight_from_the_first_step_on(self):
        # 21 wires each way of 3 m, less the mass that hangs on held nodes and is carried there all the same.
        weight = 2 * 21 * 3 * 12.566e-6 * 7850 * 9.81
        self.assertAlmostEqual(self.hung.column("net.rim.reaction_z_N")[1], weight, delta=0.01 * weight)

    def test_the_rock_meets_it_where_it_hangs(self):
        def fall(way: float) -> float:
            return (np.sqrt(25 + 2 * 9.81 * way) - 5) / 9.81

        gap = 0.26 - np.sqrt(0.202**2 - 0.05**2)  # of the middle of the rock over the nearest wires, 50 mm beside it
        self.assertAlmostEqual(first_touch(self.hung), fall(gap + SAG), delta=7e-4)

    def test_energy_is_kept(self):
        self.assertLess(self.hung.energy_error(), 1e-3)


class StartOfParticles(unittest.TestCase):
    def test_a_rock_may_start_in_the_sag_but_not_inside_of_the_flat_net(self):
        low = "particles: {spheres: {boulder: {at: [1.45, 1.55, 0.174]}}}\ntime: {end: 1 ms}\n"
        self.assertEqual(Run(SCENE, low).summary["status"], "finished")
        refused = Run(SCENE, low + FROM_THE_SHAPE)
        self.assertEqual(refused.done.returncode, 2)
        self.assertIn("starts inside of a wire", refused.done.stderr)

    def test_a_rock_below_the_sag_is_refused(self):
        refused = Run(SCENE, "particles: {spheres: {boulder: {at: [1.45, 1.55, 0.15]}}}\ntime: {end: 1 ms}\n")
        self.assertEqual(refused.done.returncode, 2)
        self.assertIn("starts inside of a wire", refused.done.stderr)


class RopesWithFriction(unittest.TestCase):
    def test_a_net_hangs_on_ropes_with_friction_before_a_rock_comes(self):
        rub = "{sliding_cable: {friction: 0.2}}"
        scene = ("time: {end: 60 ms}\nstructure: {gravity: [0, 0, -9.81], start: {relaxation: {}}, parts: {south: %s, east: %s, north: %s, west: %s}}\n"
                 "particles: {spheres: {boulder: {at: [1.45, 1.55, 0.25]}}}\noutput: {fields_every: ~}\n" % (rub, rub, rub, rub))
        run = Run("examples/net_sliding_edges", scene)
        rock = run.energy("particles.kinetic_J")[0]
        before = run.column("time_s") < 5e-3
        self.assertLess(np.abs(run.energy("structure.kinetic_J")[before]).max(), 1e-6 * rock)
        self.assertGreater(run.peak("boulder.contact_force_z_N"), 100)
        self.assertLess(run.energy_error(), 1e-2)


class OtherWays(unittest.TestCase):
    def test_every_scheme_and_method_starts_from_the_sag(self):
        for changes in ("coupling: {serial_explicit: ~, parallel_explicit: {}}\n", "coupling: {serial_explicit: ~, serial_implicit: {}}\n",
                        "coupling: {serial_explicit: ~, parallel_implicit: {}}\n", "structure: {implicit: {}}\n",
                        "structure: {start: {equilibrium: ~, relaxation: {tolerance: 1e-8}}}\n"):
            with self.subTest(changes):
                run = Run(SCENE, changes + "time: {end: 20 ms}\noutput: {fields_every: ~}\n")
                self.assertAlmostEqual(first_touch(run), first_touch(HungNet.hung), delta=6e-4)
                self.assertAlmostEqual(run.column("middle.displacement_z_m")[0], -SAG, delta=1e-3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
