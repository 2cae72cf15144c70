"""A scene pays for the effects it names, and for no others: instructions of its steps (valgrind's callgrind) and bytes of its state, by the whole
solver and by a lean program of the same kernels that contains no optional effect at all.

Arguments: the folder of the build."""
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv[1])
WORK = tempfile.TemporaryDirectory()
tearDownModule = WORK.cleanup

SAME = 0.005  # of the instructions; what is left are the questions, once a step, whether an effect is there
SMALL = 6000  # bytes; half of the smallest array that an effect could have: one number a node or sphere

def moving(net: str, supports: str = "[{nodes: net.rim, fix: xyz}]", step: str = "10 us") -> str:
    return f"""
time: {{end: 1 s, step: {step}}}
structure:
  unstable_step: allowed
  parts:
    net:
{net}
  supports: {supports}
  initial_velocities: [{{nodes: net, velocity: [0, 0, -5]}}]
"""


NET = moving("""
      square_net: {corner: [0 m, 0 m, 0 m], size: [3 m, 3 m], pitch: 0.075 m}
      cable: {area: 12.566 mm^2, density: 7850 kg/m^3, youngs_modulus: 110 GPa, prestress: 50 MPa}""")
ROPE = moving("""
      polyline: {points: [[0 m, 0 m, 0 m], [10 m, 0 m, 0 m]], divisions: 1000}
      sliding_cable: {area: 100 mm^2, density: 7850 kg/m^3, youngs_modulus: 100 GPa, prestress: 50 MPa}""",
              supports="[{nodes: net.start, fix: xyz}, {nodes: net.end, fix: xyz}]", step="1 us")
MEMBRANE = moving("""
      sheet: {corner: [0 m, 0 m, 0 m], size: [3 m, 3 m], crossed_cell: [0.1 m, 0.1 m]}
      membrane: {thickness: 1 mm, density: 1000 kg/m^3, isotropic: {youngs_modulus: 1 GPa, poissons_ratio: 0.3}, prestress: {xx: 1 MPa, yy: 1 MPa}}""")
SPHERES = """
time: {end: 1 s, step: 10 us}
particles:
  unstable_step: allowed
  materials: {stone: {density: 2600 kg/m^3, youngs_modulus: 1e7 Pa, poissons_ratio: 0.25}}
  contacts: [{between: [stone, stone], hertz: {restitution: 0.5}}]
  streams:
    down: {material: stone, count: 1000, radius: [10 mm], low: [0, 0, 0], high: [0.24, 0.24, 0.24], velocity: [0, 0, -2]}
    up: {material: stone, count: 1000, radius: [10 mm], low: [0, 0, -0.25], high: [0.24, 0.24, -0.01], velocity: [0, 0, 2]}
"""
WIRES = """particles:
  materials: {wire: {youngs_modulus: 1e7 Pa, poissons_ratio: 0.25}}
  contacts: [{between: [stone, stone], hertz: {restitution: 0.5}}, {between: [stone, wire], hertz: {restitution: 0.5}}]
  boundaries: {net: {square_net: {corner: [0 m, 0 m, -0.1 m], size: [0.24 m, 0.24 m], pitch: 0.02 m}, material: wire}}"""
STONES_WITH = "contacts: [{between: [stone, stone], hertz: {restitution: 0.5}, friction: {%s}%s}]"

GATES = ", ".join(f"at_{k}: {{point: [0, 0, {0.008 * (k - 30):.3f}], normal: [0, 0, -1]}}" for k in range(60))

# Bases, each without any optional effect: program, scene, steps.
BASES = {"net": ("count_structure", NET, 20), "rope": ("count_structure", ROPE, 40), "membrane": ("count_structure", MEMBRANE, 20),
         "spheres": ("count_particles", SPHERES, 40)}

# Every optional effect, as a change to a base. The comparison with the lean program says nothing unless it would notice the effect.
EFFECTS = {
    "gravity on the structure": ("net", "structure: {gravity: [0, 0, -9.81]}"),
    "mass-proportional damping": ("net", "structure: {damping: {mass: 5 1/s}}"),
    "stiffness-proportional damping": ("net", "structure: {damping: {stiffness: 1e-7 s}}"),
    "nodal loads": ("net", "structure: {loads: [{nodes: net, force: [0 N, 0 N, -1 N]}]}"),
    "prescribed motion": ("net", "structure: {supports: [{nodes: net.rim, fix: xyz, displacement: [0 m, 0 m, 0.1 m], over_time: [[0 s, 0], [1 ms, 1]]}]}"),
    "tension field, principal": ("membrane", "structure: {parts: {net: {membrane: {tension_field: {wrinkle_direction: principal}}}}}"),
    "tension field, iterated": ("membrane", "structure: {parts: {net: {membrane: {tension_field: {wrinkle_direction: iterated}}}}}"),
    "friction of a rope": ("rope", "structure: {parts: {net: {sliding_cable: {friction: 0.2}}}}"),
    "slides by springs": ("net", """structure:
  parts:
    rope: {polyline: {points: [[0 m, 0 m, 0 m], [3 m, 0 m, 0 m]], divisions: 40}, cable: {area: 100 mm^2, density: 7850 kg/m^3, youngs_modulus: 110 GPa}}
  supports: [{nodes: rope.start, fix: xyz}]
  slides: {edge: {rope: rope, nodes: net.edge_south, penalty: {stiffness: 100 kN/m}}}"""),
    "gravity": ("spheres", "particles: {gravity: [0, 0, -9.81]}"),
    "planes": ("spheres", """particles:
  materials: {ground: {youngs_modulus: 1e7 Pa, poissons_ratio: 0.25}}
  contacts: [{between: [stone, stone], hertz: {restitution: 0.5}}, {between: [stone, ground], hertz: {restitution: 0.5}}]
  planes: {ground: {material: ground, point: [0, 0, -0.25], normal: [0, 0, 1]}}"""),
    "boundary": ("spheres", WIRES),
    "implicit contact": ("spheres and wires", "particles: {implicit_contact: {}}"),
    "rocks": ("spheres", """particles:
  rocks: {dumbbell: {material: stone, spheres: {centres: [[0, 0, 0], [0.01, 0, 0]], radii: [0.01, 0.01]}, at: [0.1, 0.1, 1]}}"""),
    "friction and rotation": ("spheres", "particles: {%s}" % (STONES_WITH % ("coefficient: 0.5", ""))),
    "falling friction coefficient": ("spheres", "particles: {%s}" % (STONES_WITH % ("at_rest: 0.7, sliding: 0.5, decay_speed: 0.1", ""))),
    "rolling resistance": ("spheres", "particles: {%s}" % (STONES_WITH % ("coefficient: 0.5", ", rolling: {constant_torque: {coefficient: 0.1}}"))),
    "sixty gates": ("spheres", "particles: {gates: {%s}}" % GATES),  # of one, which looks at stones near it only, nothing would be noticed
    "energy ledger": ("spheres", "output: {every: 1 ms}"),
}
# What acts before time 0 only: it changes numbers, not steps.
BEFORE_TIME_ZERO = {
    "point masses": ("net", "structure: {point_masses: [{nodes: net.rim, mass: 1 kg}]}"),
    "welded parts": ("net", "structure: {weld: {tolerance: 1e-6 m}}"),
    "mass scaling": ("net", "structure: {mass_scaling: {step: 11 us}}"),
}


def count(program: str, kind: str, scene: str, steps: int) -> tuple[int, int]:
    """Instructions of the steps, and bytes of heap."""
    folder = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
    (folder / "scene.yaml").write_text(scene)
    command = [BUILD / "bin" / program, kind, folder / "scene.yaml"]
    heap = subprocess.run([*command, "0"], capture_output=True, text=True)
    if heap.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}: {heap.stderr}")
    counted = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=*counted_steps*", f"--callgrind-out-file={folder}/out", *command, str(steps)],
                             capture_output=True, text=True)
    if counted.returncode != 0:  # valgrind 3.19 lacks vmovq between registers in its short form, which gcc may put anywhere
        raise AssertionError(f"{' '.join(map(str, command))}: {counted.stderr[:2000]}")
    return int(re.search(r"Collected : (\d+)", counted.stderr).group(1)), int(heap.stdout)


def changed(base: str, change: str) -> tuple[str, str, int]:
    program, scene, steps = BASES[base]
    file = pathlib.Path(WORK.name, f"{base.replace(' ', '_')}.yaml")
    file.write_text(scene)
    return program, f"extends: {file}\n{change}\n", steps


BASES["spheres and wires"] = changed("spheres", WIRES)


class OnlyWhatTheSceneNames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        jobs = {("lean", name): (program, "lean", scene, steps) for name, (program, scene, steps) in BASES.items()}
        jobs |= {("whole", name): (program, "whole", scene, steps) for name, (program, scene, steps) in BASES.items()}
        for name, (base, change) in (EFFECTS | BEFORE_TIME_ZERO).items():
            program, scene, steps = changed(base, change)
            jobs["with", name] = (program, "whole", scene, steps)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            cls.counts = dict(zip(jobs, pool.map(lambda job: count(*job), jobs.values())))

    def test_a_scene_without_effects_runs_the_instructions_of_a_program_without_them_and_holds_no_state_of_theirs(self):
        for base in BASES:
            (whole, whole_heap), (lean, lean_heap) = self.counts["whole", base], self.counts["lean", base]
            print(f"{base:34} {whole / lean - 1:+9.3%} {whole_heap - lean_heap:+9} bytes than without any effect in the program")
            with self.subTest(base=base):
                self.assertLess(abs(whole / lean - 1), SAME)
                self.assertLess(whole_heap - lean_heap, SMALL)

    def test_each_effect_would_have_been_noticed(self):
        for name, (base, _) in EFFECTS.items():
            (with_it, heap), (without, heap_without) = self.counts["with", name], self.counts["whole", base]
            print(f"{name:34} {with_it / without - 1:+9.3%} {heap - heap_without:+9} bytes when it is named")
            with self.subTest(effect=name):
                self.assertTrue(with_it > (1 + SAME) * without or heap > heap_without + SMALL)

    def test_what_acts_before_time_zero_costs_no_step(self):
        for name, (base, _) in BEFORE_TIME_ZERO.items():
            (with_it, heap), (without, heap_without) = self.counts["with", name], self.counts["whole", base]
            with self.subTest(effect=name):
                self.assertLess(abs(with_it / without - 1), SAME)
                self.assertLess(abs(heap - heap_without), SMALL)


if __name__ == "__main__":
    if not shutil.which("valgrind"):
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
