"""Steps of unequal length on the two sides, explicit and implicit structures, against the undivided system in small steps.

A ball of 100 kg hits a post: a mass of 10 kg on a bar of 1e5 N/m, through a spring of 2e5 N/m that holds from the first touch to the end of the
run, so that errors have clean orders."""
import pathlib
import tempfile
import unittest

from scene_run import Run

END = 0.03  # s; before the ball leaves


def scene(window: float, structure_steps: int, particle_steps: int, implicit: bool, coupling: str) -> str:
    method = "implicit: {spectral_radius: 1}\n  " if implicit else ""
    return f"""title: A ball hits a post
time: {{end: {END}, step: {window}}}
structure:
  {method}step: {window / structure_steps}
  parts:
    bar: {{mesh: {{nodes: [[0,0,0],[0,0,-1000]], segments: [[0,1]]}}, bar: {{area: 1e-3, density: 1e-6, youngs_modulus: 1e11}}}}
  supports: [{{at: [0,0,-1000], fix: xyz}}, {{at: [0,0,0], fix: xy}}]
  point_masses: [{{at: [0,0,0], mass: 10}}]
particles:
  step: {window / particle_steps}
  materials:
    rock: {{density: 23873.241463784303, youngs_modulus: 1e7, poissons_ratio: 0.25}}
    wire: {{youngs_modulus: 1e20, poissons_ratio: 0.25}}
  contacts: [{{between: [rock, wire], linear: {{stiffness: 2e5, restitution: 1}}}}]
  spheres: {{rock: {{material: rock, radius: 0.1, at: [0, 0, 0.1], velocity: [0, 0, -8]}}}}
interface:
  structure: [bar]
  boundary: {{same_as_structure: {{material: wire}}}}
coupling: {{window: {window}, {coupling}}}
output: {{every: {window}, probes: {{post: {{at: [0,0,0]}}}}}}
"""


STRONG = "serial_implicit: {relax: %s, iqn_ils: {}, iterations: 100, tolerance: {relative: 1e-10}}"
PARALLEL = "parallel_implicit: {iqn_ils: {}, iterations: 100, tolerance: {relative: 1e-10}}"
RATIOS = [(1, 1), (1, 4), (4, 1), (1, 16), (16, 1), (16, 16)]  # steps a window of the structure, of the particles


def run(*case) -> Run:
    file = pathlib.Path(tempfile.mkdtemp(dir=FOLDER.name)) / "base.yaml"
    file.write_text(scene(*case))
    return Run(file)


def undivided() -> float:
    """m; deflection of the post at the end."""
    return run(2e-6, 1, 1, False, "serial_explicit: {}").at("post.displacement_z_m", END)


class UnequalSteps(unittest.TestCase):
    def errors(self, structure_steps, particle_steps, implicit, coupling):
        """Of deflection and energy (J), with windows of 1 ms and of 0.25 ms."""
        pairs = []
        for window in (1e-3, 2.5e-4):
            result = run(window, structure_steps, particle_steps, implicit, coupling)
            pairs.append((abs(result.at("post.displacement_z_m", END) - REFERENCE), abs(result.summary["energy"]["error_J"])))
        return pairs

    def check_second_order(self, cases, coupling):
        for implicit, (structure_steps, particle_steps) in cases:
            with self.subTest(implicit=implicit, structure_steps=structure_steps, particle_steps=particle_steps):
                (coarse, coarse_energy), (fine, fine_energy) = self.errors(structure_steps, particle_steps, implicit, coupling)
                # A quarter of the window: 16 times less at second order, 4 times less at first. 8 leaves room for the next order.
                self.assertLess(fine, coarse / 8)
                # The ball brings 3200 J; what is below 0.01 J is of higher order already.
                self.assertLess(fine_energy, max(coarse_energy / 8, 0.01))
                # First order was 2e-3 to 8e-3 of the deflection of 0.166 m and 12 to 63 J.
                self.assertLess(coarse, 3e-4)
                self.assertLess(coarse_energy, 6)

    def test_strong_windows_of_unequal_steps_are_of_second_order(self):
        self.check_second_order([(implicit, ratio) for implicit in (False, True) for ratio in RATIOS], STRONG % "motion")

    def test_forces_as_the_unknown_give_the_same_order(self):
        self.check_second_order([(False, (16, 1)), (True, (1, 16))], STRONG % "force")

    def test_sides_that_run_side_by_side_give_the_same_order(self):
        self.check_second_order([(False, (1, 16)), (True, (1, 4))], PARALLEL)

    def test_light_nodes_give_the_same_order(self):
        self.check_second_order([(True, (1, 16)), (False, (16, 16))], STRONG % "free_motion")

    def test_the_works_of_both_sides_differ_by_what_the_coupling_makes(self):
        for implicit, (structure_steps, particle_steps) in [(True, (1, 16)), (True, (1, 4)), (False, (1, 16)), (False, (16, 16))]:
            for coupling in ("serial_explicit: {}", STRONG % "motion", STRONG % "free_motion"):
                with self.subTest(implicit=implicit, steps=(structure_steps, particle_steps), coupling=coupling):
                    energy = run(1e-3, structure_steps, particle_steps, implicit, coupling).summary["energy"]
                    # Both sides keep their own energies to 1 J of the 3200 J, so the error of the whole is what the interface made.
                    self.assertAlmostEqual(energy["last"]["interface.created_J"], energy["error_J"], delta=1.5)

    def test_one_step_each_is_the_undivided_leapfrog_whatever_the_scheme(self):
        weak = run(1e-3, 1, 1, False, "serial_explicit: {}").column("post.displacement_z_m")
        strong = run(1e-3, 1, 1, False, STRONG % "motion").column("post.displacement_z_m")
        self.assertLess(max(abs(weak - strong)), 1e-9)


if __name__ == "__main__":
    FOLDER = tempfile.TemporaryDirectory()
    REFERENCE = undivided()
    unittest.main(argv=["unequal_steps"])
