"""What the NumPy solver reads from a scene, and how it refuses what it cannot compute."""
import pathlib
import tempfile
import unittest

import numpy as np
import talus_participant as talus

from cable_net.scene import read_model

SCENE = """
time: {end: 0.1 s, step: 0.2 ms}
structure:
  solver: cable_net_solver.py
  damping: {mass: 20 1/s}
  parts:
    net:
      square_net: {corner: [0 m, 10 cm, 0 m], size: [3 m, 2 m], pitch: 50 cm}
      cable: {area: 12 mm^2, density: 7850 kg/m^3, youngs_modulus: 1770 N/mm^2, prestress: 1e9}
  supports: [{nodes: net.rim, fix: xyz}]
output:
  probes:
    middle: {at: [1.4 m, 1.1 m, 0 m]}
    boulder: {rock: boulder}
"""


def model_of(text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "scene.yaml")
        path.write_text(text)
        return read_model(str(path))


class Scenes(unittest.TestCase):
    def refused(self, old, new):
        self.assertIn(old, SCENE)
        with self.assertRaises(talus.ConfigError) as caught:
            model_of(SCENE.replace(old, new))
        return str(caught.exception)

    def test_quantities_arrive_in_si_units(self):
        model = model_of(SCENE)
        cable = model.motion.net.properties
        self.assertEqual((cable.area, cable.density, cable.youngs_modulus, cable.prestress), (1.2e-5, 7850, 1.77e9, 1e9))
        self.assertEqual((model.step, model.motion.mass_damping), (2e-4, 20))
        self.assertEqual(len(model.net.positions), 7 * 5)

    def test_a_probe_is_the_nearest_node_and_rocks_are_left_to_the_particles(self):
        model = model_of(SCENE)
        self.assertEqual([probe.name for probe in model.probes], ["middle"])
        np.testing.assert_allclose(model.net.positions[model.probes[0].node], (1.5, 1.1, 0))

    def test_a_probe_far_from_every_node_is_refused_with_its_distance(self):
        self.assertIn("output.probes.middle.at: no node is near: the nearest, 34, is 1410.61 m away", self.refused("1.4 m, 1.1 m", "1000, 1000"))

    def test_an_unknown_key_is_named_with_its_path(self):
        self.assertIn("structure.parts.net.cable.colour: is a key this solver does not know",
                      self.refused("area:", "colour: red, area:"))

    def test_a_number_of_another_dimension_is_refused(self):
        self.assertIn("structure.parts.net.cable.area: expects", self.refused("12 mm^2", "12 mm"))

    def test_what_only_fem_solver_computes_is_refused(self):
        self.assertIn("structure.parts.net.cable: is missing", self.refused("cable:", "bar:"))
        self.assertIn("structure.damping.stiffness: is a key this solver does not know",
                      self.refused("mass: 20 1/s", "mass: 20 1/s, stiffness: 1e-6 s"))

    def test_a_missing_or_negative_value_is_refused(self):
        self.assertIn("structure.parts.net.cable.density: is missing", self.refused("density: 7850 kg/m^3, ", ""))
        self.assertIn("structure.damping.mass: must be at least 0 1/s, but is -1", self.refused("mass: 20 1/s", "mass: -1"))
        self.assertIn("structure.parts.net.square_net.pitch: must divide", self.refused("50 cm", "70 cm"))


if __name__ == "__main__":
    unittest.main()
