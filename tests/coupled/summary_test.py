"""What the summary and the log of a run say of it beside its results.

Arguments: the folder of the repository, the folder of the build."""
import sys
import unittest

from scene_run import Run

SHORT = "time: {end: 2 ms}\noutput: {fields_every: ~}\n"
HEAVY_WIRE = "structure: {parts: {net: {cable: {density: 31000 kg/m^3}}}}\n"
HEAVY_ROCK = "particles: {materials: {rock: {density: 31000 kg/m^3}}}\n"


def said(run: Run, words: str) -> list[bool]:
    """In the summary, in the log."""
    return [any(words in warning for warning in run.summary["warnings"]), words in (run.result / "log.txt").read_text()]


class Warnings(unittest.TestCase):
    def test_an_unusual_value_on_either_side_of_a_coupled_scene_is_in_its_summary_and_its_log(self):
        for changes, key in ((HEAVY_WIRE, "structure.parts.net.cable.density"), (HEAVY_ROCK, "particles.materials.rock.density")):
            with self.subTest(key):
                run = Run("examples/cable_net", SHORT + changes)
                self.assertEqual(said(run, key), [True, True])
                self.assertEqual(run.done.stderr.count(key + ":"), 1, "it is shown once")

    def test_a_usual_value_is_not_warned_of(self):
        run = Run("examples/cable_net", SHORT)
        self.assertEqual(said(run, "which is unusual"), [False, False])

    def test_an_unusual_value_of_a_structure_alone_is_in_its_summary(self):
        run = Run("examples/hanging_net", "time: {end: 2 ms}\n" + HEAVY_WIRE, program="fem_solver")
        self.assertTrue(any("density" in warning for warning in run.summary["warnings"]))


class Facts(unittest.TestCase):
    def test_how_well_spheres_fill_a_rock_is_in_the_summary_alone_and_coupled(self):
        block = "particles: {rocks: {block: {block: {edge: 0.3 m, deviation: 0.05 m}, material: rock, at: [1.5, 1.5, 2]}}}\n"
        for run, rock in ((Run("examples/block_from_surface", "time: {end: 1 ms}\n", program="dem_solver"), "particles.rocks.block"),
                          (Run("examples/cable_net", SHORT + block), "particles.rocks.block")):
            facts = run.summary["facts"]
            self.assertGreater(facts[f"{rock}.spheres"], 1)
            self.assertGreater(facts[f"{rock}.filling_deviation_m"], 0.01)  # 0.05 m are wanted; a corner may be further away
            self.assertLess(facts[f"{rock}.filling_deviation_m"], 0.1)

    def test_which_way_is_down_and_where_the_planes_are_is_in_the_summary(self):
        def vector(facts, name, unit):
            return [facts[f"{name}_{axis}_{unit}"] for axis in "xyz"]
        facts = Run("examples/bouncing_spheres", "time: {end: 1 ms}\nparticles: {gravity: [1, 2, -3], planes: {floor: {point: [4 m, 5 m, 0 m]}}}\n",
                    program="dem_solver").summary["facts"]
        self.assertEqual(vector(facts, "particles.gravity", "m_per_s2"), [1, 2, -3])
        self.assertEqual(vector(facts, "particles.planes.floor.point", "m"), [4, 5, 0])
        self.assertEqual(vector(facts, "particles.planes.floor.normal", "1"), [0, 0, 1])
        facts = Run("examples/hanging_net", "time: {end: 1 ms}\nstructure: {gravity: [0, -1, -2]}\n", program="fem_solver").summary["facts"]
        for found, expected in zip(vector(facts, "structure.gravity", "m_per_s2"), [0, -1, -2]):
            self.assertAlmostEqual(found, expected, places=12)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
