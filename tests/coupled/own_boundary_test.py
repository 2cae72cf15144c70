"""Particles that touch the structure's own triangles, or triangles and lines at once.

Arguments: the folder of the repository, the folder of the build."""
import math
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from scene_run import Run

FOLDER = tempfile.TemporaryDirectory()

SHEET = """
title: a ball on a membrane
time: {end: 30 ms, step: 20 us}
structure:
  parts:
    panel:
      sheet: {corner: [0, 0, 0], size: [2 m, 2 m], element_size: 0.25 m}
      membrane: {thickness: 1 mm, density: 1000 kg/m^3, isotropic: {youngs_modulus: 100 MPa, poissons_ratio: 0.3}}
    wires:
      polyline: {points: [[0 m, 0 m, 0 m], [2 m, 0 m, 0 m]], divisions: 8}
      cable: {area: 10 mm^2, density: 7850 kg/m^3, youngs_modulus: 100 GPa}
  weld: {tolerance: 1 mm}
  supports: [{nodes: panel.rim, fix: xyz}]
particles:
  gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]
  materials: {rock: {density: 2500 kg/m^3, youngs_modulus: 1 MPa, poissons_ratio: 0.2}, net: {youngs_modulus: 1e20 Pa, poissons_ratio: 0.25}}
  contacts: [{between: [rock, net], hertz: {restitution: 1}}]
  spheres: {ball: {material: rock, radius: 0.2 m, at: [1.02 m, 0.9 m, 0.25 m], velocity: [0 m/s, 0 m/s, -5 m/s]}}
interface: {structure: [panel, wires], boundary: {same_as_structure: {material: net, wire_radius: 2 mm}}}
coupling: {serial_explicit: {}}
output: {every: 2 ms, fields_every: 10 ms, probes: {ball: {rock: ball}}}
"""


class OwnBoundary(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scene = pathlib.Path(FOLDER.name, "sheet.yaml")
        scene.write_text(SHEET)
        cls.run_ = Run(scene)

    def test_the_membrane_takes_what_the_ball_loses(self):
        falling = 0.5 * 2500 * 4 / 3 * math.pi * 0.2**3 * (5 + 9.81 * 0.03)**2  # J, without the sheet
        self.assertLess(self.run_.column("ball.kinetic_energy_J")[-1], falling - 20)
        self.assertGreater(self.run_.energy("structure.kinetic_J")[-1], 5)
        self.assertLess(self.run_.energy_error(), 1e-2)

    def test_the_fields_hold_the_forces_that_the_probes_sum(self):
        with h5py.File(self.run_.result / "fields.h5") as file:
            frames = [np.asarray(file["interface_faces/force"][name])[:, 2].sum() for name in sorted(file["interface_faces/force"])[:4]]
        rows = [self.run_.at("interface.force_z_N", time) for time in (0, 0.01, 0.02, 0.03)]
        self.assertGreater(max(map(abs, rows)), 1000)
        for frame, row in zip(frames, rows, strict=True):
            self.assertAlmostEqual(frame, row, delta=1e-9 * max(map(abs, rows)))


if __name__ == "__main__":
    unittest.main(argv=[__file__, "-v"])
