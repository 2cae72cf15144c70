"""Every step limit that `talus check` states: 0.95 of it runs, 1.1 of it does not. A stability limit is refused before time 0 and, where the scene
insists, makes energy; an accuracy limit keeps what it promises below and warns above.

Arguments: the folder of the repository, the folder of the build."""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

from scene_run import BUILD, ROOT, Run

WORK = tempfile.TemporaryDirectory()
tearDownModule = WORK.cleanup
STRUCTURE = "highest frequency of the structure"


class Scene:
    """A scene whose step and end are still open."""

    def __init__(self, text: str):
        self.file = pathlib.Path(tempfile.mkdtemp(dir=WORK.name), "base.yaml")
        self.file.write_text(text)

    def run(self, step: float, steps: int, more: str = "") -> Run:
        return Run(self.file, f"time: {{step: {step!r}, end: {step * steps!r}}}\n{more}")

    def limits(self) -> dict[str, float]:
        return {limit["name"]: limit["limit_s"] for limit in self.run(1e-9, 1).summary["limits"]}


def energy_error(run: Run) -> float:
    """Infinite where the run broke down."""
    return math.inf if run.done.returncode == 4 else run.energy_error()


def cable(more: str, modulus: str = "100 GPa", prestress: str = "50 MPa") -> str:
    return "{area: 100 mm^2, density: 7850 kg/m^3, youngs_modulus: %s, prestress: %s%s}" % (modulus, prestress, more)


# A structure in which one mechanism sets the limit, kicked at single nodes, which excites the shortest waves.
LINE = "polyline: {points: [[0 m, 0 m, 0 m], [2 m, 0 m, 0 m]], divisions: 20}"
HELD = "supports: [{nodes: line.start, fix: xyz}, {nodes: line.end, fix: xyz}]"
KICK = "initial_velocities: [{at: [1 m, 0 m, 0 m], velocity: [1 mm/s, 1 mm/s, 1 mm/s]}]"
STRUCTURES = {
    "bars": "structure: {parts: {line: {%s, bar: %s}}, %s, %s}" % (LINE, cable(""), HELD, KICK),
    "cables": "structure: {parts: {line: {%s, cable: %s}}, %s, %s}" % (LINE, cable(""), HELD, KICK),
    "geometric stiffness of line alone": "structure: {parts: {line: {%s, cable: %s}}, %s, %s}" % (LINE, cable("", "10 kPa", "1 GPa"), HELD, KICK),
    "sliding rope": "structure: {parts: {line: {%s, sliding_cable: %s}}, %s, %s}" % (LINE, cable(""), HELD, KICK),
    "membrane": """structure:
  parts:
    line:
      sheet: {corner: [0 m, 0 m, 0 m], size: [2 m, 2 m], element_size: 0.2 m}
      membrane: {thickness: 1 mm, density: 1000 kg/m^3, isotropic: {youngs_modulus: 1 GPa, poissons_ratio: 0.3}, prestress: {xx: 10 MPa, yy: 10 MPa}}
  supports: [{nodes: line.edge_south, fix: xyz}, {nodes: line.edge_north, fix: xyz}]
  %s""" % KICK,
    "penalty springs of edge alone": """structure:
  parts:
    line: {%s, cable: %s}
    ring: {polyline: {points: [[1 m, 0 m, 0 m], [1 m, 1 m, 0 m]]}, cable: {area: 10 mm^2, density: 7850 kg/m^3, youngs_modulus: 1 GPa, prestress: 1 MPa}}
  slides: {edge: {rope: line, nodes: ring.start, penalty: {stiffness: 1000 MN/m}}}
  supports: [{nodes: line.start, fix: xyz}, {nodes: line.end, fix: xyz}, {nodes: ring.end, fix: xyz}]
  initial_velocities: [{nodes: ring.start, velocity: [0 m/s, 1 mm/s, 1 mm/s]}]""" % (LINE, cable("")),
    "stiffness damping": "structure: {parts: {line: {%s, bar: %s}}, damping: {stiffness: 1e-5 s}, %s, %s}" % (LINE, cable(""), HELD, KICK),
}


class StructureLimits(unittest.TestCase):
    def test_just_below_runs_just_above_is_refused_and_makes_energy_where_the_scene_insists(self):
        for mechanism, text in STRUCTURES.items():
            scene = Scene(text)
            limits = scene.limits()
            limit = limits[STRUCTURE]
            with self.subTest(mechanism=mechanism):
                if mechanism in limits:
                    self.assertLess(limits[mechanism], 1.05 * limit, "this mechanism does not set the limit")
                self.assertLess(energy_error(scene.run(0.95 * limit, 2000)), 0.5)  # next to the limit energies swing, but do not grow
                refused = scene.run(1.1 * limit, 2000).done
                self.assertEqual(refused.returncode, 2)
                self.assertIn(STRUCTURE, refused.stderr)
                self.assertGreater(energy_error(scene.run(1.1 * limit, 2000, "structure: {unstable_step: allowed}")), 100)


# Stable is not accurate: such runs would end as failed by their energy balance.
INACCURATE = "output: {energy_error: {error: 1e6}}"
STONE = "{density: 2500 kg/m^3, youngs_modulus: 1e8 Pa, poissons_ratio: 0.2}"
GROUND = "{youngs_modulus: 1e8 Pa, poissons_ratio: 0.2}"


def mass(radius: float) -> float:
    return 2500 * 4 / 3 * math.pi * radius**3


class ContactSpring(unittest.TestCase):
    # A stone pressed on the ground by a hundred times its weight, a tenth beside its equilibrium; a linear spring, no dashpot.
    stiffness, press = 1e6, 981.0
    sunk = mass(0.1) * press / stiffness
    scene = Scene(f"""
particles:
  gravity: [0, 0, -{press}]
  materials: {{stone: {STONE}, ground: {GROUND}}}
  contacts: [{{between: [stone, ground], linear: {{stiffness: {stiffness}, restitution: 1}}}}]
  spheres: {{stone: {{material: stone, radius: 0.1 m, at: [0, 0, {0.1 - 0.9 * sunk}]}}}}
  planes: {{ground: {{material: ground, point: [0, 0, 0], normal: [0, 0, 1]}}}}
output: {{every: 1 ms}}
""")

    def height_of_swing(self, run: Run) -> float:
        return run.column("stone.position_z_m").max() - 0.1

    def test_the_limit_is_that_of_the_leapfrog_and_the_stone_stays_below_it(self):
        limit = self.scene.limits()["contact spring"]
        self.assertAlmostEqual(limit * math.sqrt(self.stiffness / mass(0.1)), 2, places=6)
        self.assertLess(self.height_of_swing(self.scene.run(0.95 * limit, 2000)), 0)  # never leaves the ground
        refused = self.scene.run(1.1 * limit, 2000).done
        self.assertEqual(refused.returncode, 2)
        self.assertIn("contact spring", refused.stderr)
        thrown = self.scene.run(1.1 * limit, 2000, f"particles: {{unstable_step: allowed}}\n{INACCURATE}")
        self.assertGreater(self.height_of_swing(thrown), self.sunk)


class Tunnelling(unittest.TestCase):
    # A spring soft enough that it does not limit the step before tunnelling does, and stiff enough to throw the stone back.
    radius, wire, speed = 0.02, 0.002, 20.0
    stiffness = mass(radius) * (2 * speed / radius) ** 2

    def scene(self, height: float) -> Scene:
        return Scene(f"""
particles:
  materials: {{stone: {STONE}, wire: {GROUND}}}
  contacts: [{{between: [stone, wire], linear: {{stiffness: {self.stiffness}, restitution: 1}}}}]
  spheres: {{stone: {{material: stone, radius: {self.radius} m, at: [0.1, 0, {height}], velocity: [0, 0, -{self.speed}]}}}}
  boundaries: {{wire: {{square_net: {{corner: [0 m, -0.1 m, 0 m], size: [0.2 m, 0.2 m], pitch: 0.1 m}}, material: wire, wire_radius: {self.wire} m}}}}
""")

    def passes(self, step: float, more: str = "") -> int:
        """How many of stones that meet the wire at different moments of the step come out behind it."""
        count = 0
        for phase in range(8):
            run = self.scene(0.03 + phase / 8 * self.speed * step).run(step, round(6e-3 / step), more)
            count += run.summary["last"]["stone.position_z_m"] < 0
        return count

    def test_no_stone_passes_below_the_limit_and_some_do_beyond_twice_it(self):
        limit = self.scene(0.03).limits()["tunnelling"]
        self.assertAlmostEqual(limit * 2 * self.speed / (self.radius + self.wire), 1, places=6)
        self.assertEqual(self.passes(0.95 * limit), 0)
        refused = self.scene(0.03).run(1.1 * limit, 10).done
        self.assertEqual(refused.returncode, 2)
        self.assertIn("tunnelling", refused.stderr)
        self.assertGreater(self.passes(2.2 * limit, "particles: {unstable_step: allowed}"), 0)


class AccuracyOfAContact(unittest.TestCase):
    scene = Scene(f"""
particles:
  materials: {{stone: {STONE}, ground: {GROUND}}}
  contacts: [{{between: [stone, ground], hertz: {{restitution: 0.5}}}}]
  spheres: {{stone: {{material: stone, radius: 0.1 m, at: [0, 0, 0.101], velocity: [0, 0, -1]}}}}
  planes: {{ground: {{material: ground, point: [0, 0, 0], normal: [0, 0, 1]}}}}
""")

    def outcome(self, step: float) -> tuple[float, str]:
        """Restitution and warnings."""
        summary = self.scene.run(step, round(0.02 / step)).summary
        return summary["last"]["stone.velocity_z_m_per_s"], " ".join(summary["warnings"])

    def test_thirty_steps_a_contact_keep_the_restitution_within_a_hundredth_and_fewer_warn(self):
        limit = self.scene.limits()["contact duration"]
        restitution, warnings = self.outcome(0.95 * limit)
        self.assertAlmostEqual(restitution, 0.5, delta=0.005)
        self.assertNotIn("contact duration", warnings)
        self.assertIn("contact duration", self.outcome(1.1 * limit)[1])
        self.assertGreater(abs(self.outcome(6 * limit)[0] - 0.5), 0.005)

    def test_a_surface_wave_that_crosses_a_sphere_in_a_step_warns(self):
        limit = self.scene.limits()["Rayleigh wave"]
        self.assertNotIn("Rayleigh wave", self.outcome(0.95 * limit)[1])
        self.assertIn("Rayleigh wave", self.outcome(1.1 * limit)[1])


class DashpotOnLightNodes(unittest.TestCase):
    def outcome(self, step: float) -> tuple[float, str]:
        run = Run("examples/cable_net", f"time: {{end: 0.1, step: {step!r}}}\noutput: {{fields_every: ~}}\n")
        return run.peak("net_centre.displacement_z_m"), " ".join(run.summary["warnings"])

    def test_the_peak_has_converged_below_the_limit_and_not_far_above_it(self):
        limits = {limit["name"]: limit["limit_s"] for limit in Run("examples/cable_net", "time: {end: 1e-5, step: 1e-5}").summary["limits"]}
        limit = limits["contact dashpot on boundary nodes"]
        converged, _ = self.outcome(limit / 4)
        peak, warnings = self.outcome(0.95 * limit)
        self.assertAlmostEqual(peak / converged, 1, delta=0.01)
        self.assertNotIn("dashpot", warnings)
        self.assertIn("dashpot", self.outcome(1.1 * limit)[1])
        self.assertGreater(abs(self.outcome(6 * limit)[0] / converged - 1), 0.1)


class SpringOnLightNodes(unittest.TestCase):
    # A stone stands on the light top of a post whose prestress carries it; a hundredth beside its equilibrium, linear spring, no dashpot.
    stiffness, area, weight = 1e6, 1e-4, mass(0.1) * 9.81
    sunk = weight / stiffness
    scene = Scene(f"""
structure:
  parts:
    post:
      polyline: {{points: [[0 m, 0 m, 0 m], [0 m, 0 m, -1 m]]}}
      bar: {{area: {area}, density: 7850 kg/m^3, youngs_modulus: 200 MPa, prestress: {-weight / area}}}
  supports: [{{nodes: post.start, fix: xy}}, {{nodes: post.end, fix: xyz}}]
particles:
  gravity: [0, 0, -9.81]
  materials: {{stone: {STONE}, wire: {GROUND}}}
  contacts: [{{between: [stone, wire], linear: {{stiffness: {stiffness}, restitution: 1}}}}]
  spheres: {{stone: {{material: stone, radius: 0.1 m, at: [0, 0, {0.102 - 0.99 * sunk}]}}}}
interface:
  structure: [post]
  boundary: {{same_as_structure: {{wire_radius: 2 mm, material: wire}}}}
coupling: {{serial_explicit: {{}}}}
""")

    def test_just_below_the_stone_stays_on_its_post_just_above_it_is_thrown_off(self):
        limit = self.scene.limits()["contact spring on boundary nodes"]
        node = 7850 * self.area / 3  # kg; what of the post, hinged at its foot, moves with its head
        self.assertAlmostEqual(limit * math.sqrt(self.stiffness / node), 2, places=6)
        self.assertGreater(self.scene.run(0.95 * limit, 500, INACCURATE).column("stone.contact_force_z_N")[1:].min(), 0)
        refused = self.scene.run(1.1 * limit, 500).done
        self.assertEqual(refused.returncode, 2)
        self.assertIn("contact spring on boundary nodes", refused.stderr)
        thrown = self.scene.run(1.1 * limit, 500, f"particles: {{unstable_step: allowed}}\n{INACCURATE}")
        self.assertEqual(thrown.column("stone.contact_force_z_N")[1:].min(), 0)


def check(scene: pathlib.Path) -> subprocess.CompletedProcess:
    return subprocess.run([BUILD / "bin/talus", "check", scene], capture_output=True, text=True)


class CheckOfScenes(unittest.TestCase):
    def test_a_scene_that_its_solver_runs_without_a_step_is_not_refused_for_having_none(self):
        for name in ("sliding_rope_static", "loaded_membrane_static", "hanging_net_implicit", "hanger_static", "loaded_net_static", "hanging_net"):
            with self.subTest(scene=name):
                done = check(ROOT / f"configs/examples/{name}.yaml")
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_coupled_scene_without_a_step_still_is(self):
        scene = pathlib.Path(tempfile.mkdtemp(dir=WORK.name), "scene.yaml")
        scene.write_text(f"extends: {ROOT}/configs/examples/cable_net.yaml\ntime: {{step: ~}}\n")
        done = check(scene)
        self.assertEqual(done.returncode, 2)
        self.assertIn("time.step", done.stderr)

    def test_the_limit_of_a_barrier_is_set_by_its_membrane_and_no_post_is_named(self):
        table = check(ROOT / "tests/field/barrier/d1000_membrane.yaml").stdout
        line = next(line for line in table.splitlines() if STRUCTURE in line)
        self.assertIn("set by the membrane of net, most of all at node", line)
        self.assertNotIn("post", line)

    def test_ropes_that_hang_slack_are_told_to_want_a_quarter_of_the_limit_and_prestressed_ones_are_not(self):
        self.assertIn("take a quarter of it", check(ROOT / "configs/examples/hanging_net.yaml").stdout)
        self.assertNotIn("quarter", check(ROOT / "configs/examples/cable_net.yaml").stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
