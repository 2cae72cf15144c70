"""`talus explain RESULT` after runs that a user would make: shares of the time, of the energy, and what it proposes.

Arguments: the folder of the repository, the folder of the build."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from scene_run import BUILD, Run, WORK


def explained(run: Run) -> str:
    assert run.summary
    return subprocess.run([BUILD / "bin/talus", "explain", run.result], capture_output=True, text=True, check=True).stdout


class AfterARun(unittest.TestCase):
    def test_each_stage_has_its_share_of_the_time_and_no_side_has_more_than_all(self):
        text = explained(Run("examples/cable_net", "time: {end: 50 ms}\noutput: {stage_times: {}}"))
        shares = re.findall(r"^ +([\d.]+) %  (structure|particles) +(.+)$", text, re.M)
        for side in ("structure", "particles"):
            total = sum(float(share) for share, owner, _ in shares if owner == side)
            self.assertGreater(total, 1)
            self.assertLessEqual(total, 100)
        stages = [stage for _, _, stage in shares]
        self.assertIn("elements of net", stages)
        self.assertIn("contacts with the boundary", stages)
        self.assertRegex(text, r"J +stored +particles\.kinetic_J")

    def test_times_are_told_only_where_the_scene_asks_and_change_no_bit_of_the_motion(self):
        timed, untimed = (Run("examples/cable_net", f"time: {{end: 5 ms}}\noutput: {{fields_every: ~{times}}}") for times in (", stage_times: {}", ""))
        self.assertFalse([name for name in untimed.columns if "_time." in name])
        self.assertTrue([name for name in timed.columns if "_time." in name])
        for name, values in untimed.columns.items():
            self.assertEqual(list(timed.column(name)), list(values), name)
        self.assertIn("time: not measured", explained(untimed))

    def test_an_implicit_structure_has_its_stages_too(self):
        run = Run("examples/hanging_net_implicit", "time: {end: 20 ms}\noutput: {fields_every: ~, stage_times: {}}", program="fem_solver")
        self.assertGreater(run.column("structure_time.everything_else_s")[-1], 0)
        self.assertLess(sum(values[-1] for name, values in run.columns.items() if "_time." in name), run.summary["wall_time_s"])


def advice(run: Run, heading: str) -> list[str]:
    """The lines below a heading of the explanation."""
    below = explained(run).split(heading + "\n", 1)[1].splitlines()
    lines = []
    for line in below:
        if not line.startswith("  "):
            break
        lines.append(line.strip())
    return lines


MAY_GO, MISSING = "may be left out", "seems to be missing"
PROMISED = 1e-3  # of a peak; what the explanation says that following it changes at most

BALL = """
time: {end: 0.6 s, step: 20 us}
particles:
  gravity: [0, 0, -9.81]
  materials:
    steel: {density: 7850 kg/m^3, youngs_modulus: 1e8 Pa, poissons_ratio: 0.3}
    stone: {density: 2600 kg/m^3, youngs_modulus: 1e9 Pa, poissons_ratio: 0.3}
    floor: {youngs_modulus: 1e9 Pa, poissons_ratio: 0.2}
  contacts:
    - {between: [steel, floor], hertz: {restitution: 0.9}STEEL}
    - {between: [stone, floor], hertz: {restitution: 0.1}STONE}
    - {between: [stone, steel], hertz: {restitution: 0.1}}
  spheres:
    ball: {material: steel, radius: 0.3 m, at: [0, 0, 2]}
  planes:
    floor: {material: floor, point: [0, 0, 0], normal: [0, 0, 1]}
    slope: {material: floor, point: [10, 0, 0], normal: [-0.2, 0, 1]}
output: {every: 5 ms}
"""
# On the slope of 1 in 5, beside the ball that makes the impact.
BLOCK = "  rocks: {block: {material: stone, block: {edge: 0.4 m, deviation: 0.05 m}, at: [19.96077677, 0, 2.19611614], turned: [0, -0.19739556, 0]}}\n"
FRICTION = ", friction: {coefficient: 0.5}"
SHEET = """
time: {end: 40 ms, step: 20 us}
structure:
  parts:
    sheet:
      sheet: {corner: [0 m, 0 m, 0 m], size: [1 m, 1 m], element_size: 0.1 m}
      membrane: {thickness: 1 mm, density: 1000 kg/m^3, isotropic: {youngs_modulus: 1 GPa, poissons_ratio: 0.3}, prestress: {xx: 10 MPa, yy: 10 MPa}FIELD}
  supports: [{nodes: sheet.rim, fix: xyz}]
  loads: [{at: [0.5 m, 0.5 m, 0 m], force: [0 N, 0 N, -20 N]}]
output: {every: 0.5 ms, fields_every: 1 ms, probes: {middle: {at: [0.5 m, 0.5 m, 0 m]}}}
"""
ELASTIC_BRAKE = "brake: ~, cable: {area: 10 cm^2, density: 1e4 kg/m^3, youngs_modulus: 20 GPa}"  # 200 kN at 5 mm of 0.5 m
STIFF_BRAKE = "brake: {table: [[5 mm, 200 kN], [0.4 m, 300 kN]]}"


def written(text: str) -> Run:
    """A scene of its own."""
    file = pathlib.Path(tempfile.mkdtemp(dir=WORK.name), "base.yaml")
    file.write_text(text)
    return Run(file)


def ball(*, steel: str = "", stone: str = "", block: str = "") -> Run:
    return written(BALL.replace("STEEL", steel).replace("STONE", stone).replace("output:", block + "output:"))


class AdviceTaken(unittest.TestCase):
    """Each advice: where it is given, following it changes no more than it says; and a scene where it must not be given."""

    def assertNoPeakChanges(self, before: Run, after: Run):
        for name, peak in after.summary["peaks"].items():
            if name not in before.summary["peaks"] or before.peak(name) < 1e-9:
                continue  # round-off
            self.assertLess(abs(before.peak(name) - abs(peak["value"])), PROMISED * before.peak(name), name)

    def assertGiven(self, run: Run, heading: str, key: str):
        self.assertTrue([line for line in advice(run, heading) if key in line], f"{key} is not told")

    def assertNotGiven(self, run: Run, heading: str, key: str):
        self.assertFalse([line for line in advice(run, heading) if key in line], f"{key} is told")

    def test_friction_of_a_ball_that_nothing_turns_may_go_and_friction_that_holds_a_block_may_not(self):
        falling = ball(steel=FRICTION)
        self.assertGiven(falling, MAY_GO, "particles.contacts[0].friction")
        self.assertNoPeakChanges(falling, ball())
        held = ball(stone=FRICTION, block=BLOCK)
        energy = held.energy("contacts.friction_J").max() / held.energy("particles.kinetic_J").max()
        self.assertLess(energy, 1e-6)  # it does no work
        self.assertNotGiven(held, MAY_GO, "friction")
        slides = ball(block=BLOCK)
        self.assertGreater(slides.peak("block.velocity_x_m_per_s"), 100 * held.peak("block.velocity_x_m_per_s"))

    def test_damping_that_takes_nothing_may_go_and_damping_that_takes_a_part_may_not(self):
        short = "time: {end: 60 ms}\noutput: {fields_every: ~}\n"
        hardly = Run("examples/cable_net_converged", short + "structure: {damping: {mass: 1e-6 1/s}}")
        self.assertGiven(hardly, MAY_GO, "structure.damping.mass")
        self.assertNoPeakChanges(hardly, Run("examples/cable_net_converged", short + "structure: {damping: ~}"))
        self.assertNotGiven(Run("examples/cable_net_converged", short), MAY_GO, "damping")

    def test_a_brake_that_never_slips_may_go_and_a_rope_whose_friction_holds_may_not(self):
        held = Run("examples/braked_rope", f"structure: {{parts: {{brake: {{{STIFF_BRAKE}}}}}}}")
        self.assertGiven(held, MAY_GO, "structure.parts.brake.brake")
        elastic = Run("examples/braked_rope", f"structure: {{parts: {{brake: {{{ELASTIC_BRAKE}}}}}}}")
        self.assertNoPeakChanges(held, elastic)
        self.assertNotGiven(Run("examples/braked_rope"), MAY_GO, "structure.parts.brake.brake")
        self.assertNotGiven(held, MAY_GO, "sliding_cable.friction")

    def test_a_tension_field_of_a_taut_sheet_may_go_and_one_of_a_sheet_that_wrinkles_may_not(self):
        taut = written(SHEET.replace("FIELD", ", tension_field: {}"))
        self.assertGiven(taut, MAY_GO, "structure.parts.sheet.membrane.tension_field")
        self.assertNoPeakChanges(taut, written(SHEET.replace("FIELD", "")))
        wrinkled = Run("examples/membrane_tension_field", "time: {end: 60 ms}\noutput: {fields_every: 2 ms}")
        self.assertNotGiven(wrinkled, MAY_GO, "tension_field")

    def test_iterations_may_go_where_no_window_in_contact_needs_a_second_and_not_where_their_mean_is_near_one(self):
        def strong(tolerance: float) -> Run:
            return Run("examples/cable_net_converged", f"""
time: {{end: 60 ms}}
output: {{fields_every: ~}}
coupling:
  serial_implicit:
    {{relax: motion, aitken: {{}}, iterations: 30, tolerance: {{relative: {tolerance}, force: 1 N, displacement: 1 um, velocity: 1 mm/s}}}}""")
        loose = strong(10)
        self.assertEqual(loose.summary["iterations"]["in_contact"]["most"], 1)
        self.assertGiven(loose, MAY_GO, "serial_explicit")
        self.assertNoPeakChanges(loose, Run("examples/cable_net_converged", "time: {end: 60 ms}\noutput: {fields_every: ~}"))
        iterating = strong(0.01)
        self.assertLess(iterating.summary["iterations"]["mean"], 1.05)  # over free flight
        self.assertNotGiven(iterating, MAY_GO, "serial_explicit")

    def test_a_sheet_that_is_pressed_misses_a_tension_field_and_is_not_pressed_with_it(self):
        self.assertGiven(Run("examples/membrane_plain", "time: {end: 60 ms}"), MISSING, "structure.parts.net.membrane.tension_field")
        self.assertNotGiven(Run("examples/membrane_tension_field", "time: {end: 60 ms}"), MISSING, "tension_field")

    def test_a_step_too_long_for_the_dashpots_misses_implicit_contact_which_then_keeps_the_peak(self):
        plain = "time: {end: 80 ms}\noutput: {fields_every: ~}\n"
        long = Run("examples/cable_net", plain)
        self.assertGiven(long, MISSING, "particles.implicit_contact")
        converged = Run("examples/cable_net_converged", plain)
        self.assertNotGiven(converged, MISSING, "implicit_contact")
        followed = Run("examples/cable_net", plain + "particles: {implicit_contact: {}}")
        name = "net_centre.displacement_z_m"
        self.assertLess(abs(followed.peak(name) / converged.peak(name) - 1), 0.01)
        self.assertGreater(abs(long.peak(name) / converged.peak(name) - 1), 0.1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
