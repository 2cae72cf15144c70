"""Panels of rings under a boulder, and what particles feel of rings and of double twists.

Arguments: the folder of the repository, the folder of the build."""
import sys
import unittest

import numpy as np
from scene_run import Run

NET = "examples/ring_net"
TENSION = 0.5 * 62.745e3  # N, at which rings with 7 windings break: half of the force between the tests with 5 and 9
COARSE = "output: {fields_every: ~}\n"


class PanelOfRings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.held = Run(NET, COARSE)

    def test_rings_hold_the_boulder_and_bending_takes_most_of_its_energy(self):
        self.assertEqual(self.held.column("net.broken_1")[-1], 0)
        self.assertGreater(self.held.column("boulder.velocity_z_m_per_s").max(), 0)
        energy = 0.5 * 2500 * 4 / 3 * np.pi * 0.3**3 * 15**2  # J
        self.assertGreater(self.held.energy("structure.dissipated_net_J")[-1], 0.8 * energy)
        self.assertLess(self.held.energy_error(), 1e-4)

    def test_what_a_ring_bore_is_compared_with_what_it_may(self):
        used = self.held.summary["tables"]["utilisation"]["net"]
        self.assertAlmostEqual(used["breaking_load_N"], TENSION, delta=1e-3 * TENSION)
        self.assertAlmostEqual(used["force_N"], self.held.summary["tables"]["largest_forces"]["net"]["tension_N"])
        self.assertLess(used["utilisation"], 1)

    def test_a_faster_boulder_breaks_rings_and_falls_through_the_hole(self):
        through = Run(NET, "particles: {spheres: {boulder: {velocity: [0, 0, -40]}}}\n" + COARSE)
        self.assertLess(through.column("boulder.position_z_m")[-1], -2)
        self.assertEqual(np.abs(through.column("boulder.contact_force_z_N")[-20:]).max(), 0)
        first = through.summary["tables"]["ruptures"]["net"]
        self.assertEqual(first["broken"], through.column("net.broken_1")[-1])
        self.assertGreater(first["first_force_N"], TENSION)
        self.assertLess(first["first_force_N"], 1.1 * TENSION)
        self.assertLess(np.hypot(first["first_x_m"] - 1.45, first["first_y_m"] - 1.55), 0.8)
        self.assertLess(through.energy_error(), 1e-2)

    def test_round_rings_as_the_boundary_stop_it_where_their_polygons_do(self):
        deepest = lambda run: run.column("boulder.position_z_m").min()
        own = Run(NET, "structure: {parts: {net: {ring: {breaks: ~}}}}\n"
                  "interface: {boundary: {same_as_structure: ~, ring_net: {corner: [0 m, 0 m, 0 m], size: [3 m, 3 m], inner_diameter: 300 mm, "
                  "wire_diameter: 3 mm, windings: 7, material: wire}}, mapping: {nearest_feature: {tolerance: 50 mm}}}\n" + COARSE)
        self.assertLess(abs(deepest(own) - deepest(self.held)), 0.1 * abs(deepest(self.held)))


class Thickness(unittest.TestCase):
    def started(self, x: float, y: float, net: str, radius: str = "") -> Run:
        """A ball of 5 mm whose lower end is 2 mm above the plane of the net."""
        return Run(NET, f"structure: {{parts: {{net: {{{net}}}}}}}\n"
                   f"interface: {{boundary: {{same_as_structure: {{{radius}}}}}}}\n"
                   f"particles: {{spheres: {{boulder: {{radius: 5 mm, at: [{x}, {y}, 0.007], velocity: [0, 0, 0]}}}}}}\n"
                   "time: {end: 0.1 ms, step: 1 us}\noutput: {every: 0.1 ms, fields_every: ~}\n")

    def test_particles_feel_a_twist_as_two_wires_thick(self):
        net = "ring_net: ~, ring: ~, hexagonal_net: {corner: [0 m, 0 m, 0 m], size: [0.8 m, 0.7 m], mesh_size: [80 mm, 100 mm], twist_length: 40 mm, wire_diameter: 2.7 mm}, " \
              "cable: {area: 5.7 mm^2, density: 7850 kg/m^3, youngs_modulus: 100 GPa, prestress: 50 MPa}"
        # The twist at x = 40 mm is 2.7 mm thick around its axis, the wire that comes to it half of it.
        on_twist, on_wire = self.started(0.04, 0.09, net), self.started(0.02, 0.055, net)
        self.assertNotEqual(on_twist.done.returncode, 0)
        self.assertIn("boulder", on_twist.done.stderr)
        self.assertEqual(on_wire.done.returncode, 0, on_wire.done.stderr)
        # A radius that the scene gives is that of all lines.
        self.assertEqual(self.started(0.04, 0.09, net, "wire_radius: 1.35 mm").done.returncode, 0)

    def test_particles_feel_a_ring_as_thick_as_its_bundle(self):
        # Seven wires of 3 mm make a bundle of 8.3 mm: 4.17 mm around its axis, more than 2 mm. Rings touch at x = 0.3 m.
        on_ring, in_ring = self.started(0.3, 0.15, ""), self.started(0.15, 0.15, "")
        self.assertNotEqual(on_ring.done.returncode, 0)
        self.assertIn("boulder", on_ring.done.stderr)
        self.assertEqual(in_ring.done.returncode, 0, in_ring.done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
