"""Particles that touch the structure's own triangles, or triangles and lines at once.

Arguments: the folder of the repository, the folder of the build."""
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

    def test_the_membrane_catches_the_ball_and_the_energy_stays(self):
        # It would be at 0.25 - 5 x 0.03 - g/2 x 0.03^2 = 0.096 m, half its radius below the sheet.
        self.assertGreater(self.run_.column("ball.position_z_m")[-1], 0.12)
        self.assertGreater(self.run_.peak("interface.force_z_N"), 1000)
        self.assertLess(self.run_.energy_error(), 1e-3)

    def test_what_presses_on_the_sheet_is_what_the_ball_feels(self):
        with h5py.File(self.run_.result / "fields.h5") as file:
            named = {}
            file.visititems(lambda name, item: named.update({name: item[...]}) if isinstance(item, h5py.Dataset) else None)
        forces = [values for name, values in named.items() if "boundary_surface" in name and "force" in name]
        self.assertTrue(forces, sorted(named))
        times = self.run_.column("time_s")
        row = np.abs(times - 0.02).argmin()
        probe = self.run_.column("interface.force_z_N")[row]
        self.assertTrue(any(abs(values[..., 2].sum() - probe) < 1e-6 * abs(probe) for values in forces), [v[..., 2].sum() for v in forces] + [probe])


if __name__ == "__main__":
    unittest.main(argv=[__file__, "-v"])
