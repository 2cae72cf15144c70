"""One net, two meshes: what passes the real openings of a homogenised panel, and what homogenisation changes of an impact.

Arguments: the folder of the repository, the folder of the build."""
import csv
import math
import sys
import unittest

import h5py
import numpy as np

from scene_run import Run

# The data sheet of the net in all these scenes, m: diagonals of a mesh and the wire's diameter.
ALONG, ACROSS, WIRE = 0.097, 0.168, 0.004
SIDE = math.hypot(ALONG, ACROSS) / 2
OPENING = ALONG * ACROSS / (2 * SIDE) - WIRE
# However the panel shears: a mesh is never wider than as a square. Two per cent for the strain of wires and the overlap in contact.
WIDEST = 1.02 * (SIDE - WIRE)
FEWER_STONES = """
time: {end: 1.4 s}
particles: {streams: {stones_west: {count: 150}, stones_east: {count: 150}}}
output: {fields_every: 0.1 s}
"""


def paths_of_spheres(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Diameters (m; sphere) and positions (m; frame, sphere, axis)."""
    with h5py.File(run.result / "fields.h5") as fields:
        names = [f"{frame:06d}" for frame in range(run.summary["frames"])]
        return 2 * fields[f"particles/radius/{names[0]}"][:].ravel(), np.stack([fields[f"particles/position/{n}"][:] for n in names])


def pass_disc(paths: np.ndarray, centre: tuple[float, float, float], radius: float) -> np.ndarray:
    """Which of the stones (frame, stone, axis; m) fall through a horizontal disc, flying straight between frames."""
    height = paths[:, :, 2] - centre[2]
    crosses = (height[:-1] >= 0) & (height[1:] < 0)
    share = np.where(crosses, height[:-1] / (height[:-1] - height[1:] + 1e-300), 0)[..., None]
    place = paths[:-1] + share * (paths[1:] - paths[:-1]) - centre
    return np.any(crosses & (np.hypot(place[..., 0], place[..., 1]) <= radius), axis=0)


class StonesOnHomogenisedPanel(unittest.TestCase):
    stones = 300  # the last spheres; those before them are the block's

    @classmethod
    def setUpClass(cls):
        cls.run_ = Run("examples/openings", FEWER_STONES)
        diameters, paths = paths_of_spheres(cls.run_)
        cls.of_block = diameters.size - cls.stones  # its spheres have the first numbers
        cls.diameters = diameters[-cls.stones:]
        cls.passed = pass_disc(paths[:, -cls.stones:], centre=(2.328, 2.52, -2.5), radius=2.5)

    def test_no_stone_passes_that_is_larger_than_a_mesh_can_become(self):
        self.assertGreater(np.sum(self.diameters > WIDEST), 20)
        self.assertFalse(np.any(self.passed & (self.diameters > WIDEST)))

    def test_the_block_is_held(self):
        lowest = self.run_.column("block.position_z_m").min()
        self.assertLess(lowest, -0.5)  # it did fall into the net
        self.assertGreater(lowest, -2.5)

    def test_the_larger_the_stones_the_smaller_the_part_that_passes(self):
        limits = [0.01, OPENING / 2, OPENING, WIDEST]
        parts = [self.passed[(self.diameters >= low) & (self.diameters < high)].mean() for low, high in zip(limits, limits[1:])]
        self.assertGreater(parts[0], 0.75)  # some lie on the block or still on their way
        self.assertEqual(parts, sorted(parts, reverse=True))
        self.assertLess(parts[-1], 0.3)  # only where the panel shears towards squares, which it hardly does

    def test_the_largest_stone_that_passes_is_about_as_large_as_an_opening(self):
        largest = self.diameters[self.passed].max()
        self.assertGreater(largest, 0.85 * OPENING)  # some 26 of the stones are between this and the opening
        self.assertLess(largest, WIDEST)

    def test_the_summary_counts_the_stones_that_passed(self):
        below = self.run_.summary["last"]
        self.assertAlmostEqual(below["below.stones_passed"], self.passed.sum(), delta=2)  # frames are 0.1 s apart
        self.assertLess(2 * below["below.largest_radius_m"], WIDEST)

    def test_every_stone_that_passed_stands_once_in_the_table_with_its_own_size(self):
        with open(self.run_.result / "below.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), self.run_.summary["last"]["below.stones_passed"])
        times, stones = [float(row["time_s"]) for row in rows], [int(row["stone"]) for row in rows]
        self.assertEqual(len(set(stones)), len(stones))
        self.assertTrue(0 < min(times) and max(times) <= self.run_.column("time_s")[-1])
        for row, stone in zip(rows, stones):
            self.assertEqual(float(row["diameter_m"]), self.diameters[stone - self.of_block])

    def test_the_summary_counts_stones_that_passed_and_were_held_by_size_and_the_block_among_the_held(self):
        sizes = self.run_.summary["tables"]["below.sizes"]
        self.assertEqual(sum(row["spheres_passed"] for row in sizes), self.run_.summary["last"]["below.stones_passed"])
        self.assertEqual(sum(row["spheres_passed"] + row["spheres_held"] for row in sizes), self.stones)
        self.assertEqual([(row["rocks_passed"], row["rocks_held"]) for row in sizes if row["rocks_held"] + row["rocks_passed"] > 0], [(0, 1)])
        for row in sizes:
            within = (self.diameters >= row["diameter_from_m"]) & (self.diameters < row["diameter_to_m"])
            self.assertEqual(row["spheres_passed"] + row["spheres_held"], within.sum())
            if row["diameter_from_m"] > WIDEST:
                self.assertEqual(row["spheres_passed"], 0)

    def test_the_energy_balance_closes(self):
        self.assertLess(self.run_.energy_error(), 0.01)


class DetailedAgainstHomogenised(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = [Run(f"examples/chain_link_{kind}") for kind in ("detailed", "homogenised")]

    def compare(self, quantity):
        detailed, homogenised = (quantity(run) for run in self.runs)
        self.assertLess(abs(homogenised - detailed), 0.1 * detailed)

    def test_the_panel_gives_way_as_far(self):
        self.compare(lambda run: run.peak("middle.displacement_z_m"))

    def test_the_block_falls_as_deep(self):
        self.compare(lambda run: 0.26 - run.column("block.position_z_m").min())

    def test_the_block_stops_after_the_same_time(self):
        self.compare(lambda run: run.column("time_s")[run.column("block.position_z_m").argmin()])

    def test_the_ropes_pull_as_hard(self):
        self.compare(lambda run: run.peak("south.axial_force_max_N"))

    def test_the_meshes_at_the_edge_are_drawn_in_as_far(self):
        self.compare(lambda run: run.peak("edge.displacement_y_m"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
