"""Two structural solvers that share nothing but the formulas, fem_solver and python/cable_net_solver.py, in the same coupled scene.

Arguments: the folder of the repository, the folder of the build."""
import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
END = 0.08  # s; the first touch is at 0.035 s, the net's lowest point at 0.0775 s
AGREEMENT = 1e-6  # m; what is asked for. Both sum in different orders, and contacts amplify round-off (1e-16 to some 1e-13).


def history(scene: str, folder: str) -> tuple[np.ndarray, list[str]]:
    """Rows of probes.csv of an example that ends at END."""
    short, result = pathlib.Path(folder, f"{scene}.yaml"), pathlib.Path(folder, scene)
    short.write_text(f"extends: {ROOT}/configs/examples/{scene}.yaml\ntime: {{end: {END} s}}\n")
    subprocess.run([BUILD / "bin/talus", "run", short, "--out", result, "--quiet"], check=True)
    with open(result / "probes.csv", newline="") as file:
        header, *rows = csv.reader(file)
    return np.array(rows, dtype=float), header


class TwoStructuralSolvers(unittest.TestCase):
    def test_they_move_the_net_and_the_rocks_alike(self):
        with tempfile.TemporaryDirectory() as folder:
            (own, own_names), (other, other_names) = (history(f"cable_net_{name}", folder) for name in ("converged", "scipy"))
        common = [name for name in own_names if name in other_names and name.endswith("_m")]
        self.assertIn("net_centre.displacement_z_m", common)
        self.assertIn("boulder.position_z_m", common)
        for name in common:
            difference = np.abs(own[:, own_names.index(name)] - other[:, other_names.index(name)]).max()
            self.assertLess(difference, AGREEMENT, name)
        self.assertLess(other[:, other_names.index("net_centre.displacement_z_m")].min(), -0.1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
