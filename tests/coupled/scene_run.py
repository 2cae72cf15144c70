"""A scene run as a user runs it, and what its result says. For tests that are started with the arguments: the folder of the repository, the
folder of the build."""
import atexit
import csv
import functools
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
WORK = tempfile.TemporaryDirectory()
atexit.register(WORK.cleanup)


class Run:
    """`scene`, a file or a path without its ending below configs/, with the YAML text `changes` over it, by `talus` or, where it has no
    particles, `fem_solver`."""

    def __init__(self, scene: str | pathlib.Path, changes: str = "", *, program: str = "talus", options: tuple[str, ...] = ()):
        folder = pathlib.Path(tempfile.mkdtemp(dir=WORK.name))
        changed, self.result = folder / "scene.yaml", folder / "result"
        base = scene if isinstance(scene, pathlib.Path) else f"{ROOT}/configs/{scene}.yaml"
        changed.write_text(f"extends: {base}\n{changes}")
        command = [BUILD / "bin" / program, *(["run"] if program == "talus" else []), changed, "--out", self.result, "--quiet", *options]
        self.done = subprocess.run(command, capture_output=True, text=True)

    @functools.cached_property
    def summary(self) -> dict:
        if self.done.returncode != 0:
            raise AssertionError(self.done.stderr)
        return json.loads((self.result / "summary.json").read_text())

    def _table(self, name: str) -> dict[str, np.ndarray]:
        assert self.summary
        with open(self.result / name, newline="") as file:
            header, *rows = csv.reader(file)
        return dict(zip(header, np.array(rows, dtype=float).T))

    @functools.cached_property
    def columns(self) -> dict[str, np.ndarray]:
        """Of probes.csv, by name."""
        return self._table("probes.csv")

    def energy(self, line: str) -> np.ndarray:
        """A line of energy.csv."""
        return self._table("energy.csv")[line]

    def column(self, name: str) -> np.ndarray:
        return self.columns[name]

    def at(self, name: str, time: float) -> float:
        """Value of the row nearest to `time` (s)."""
        return self.column(name)[np.abs(self.column("time_s") - time).argmin()]

    def peak(self, name: str) -> float:
        """Largest absolute value, as the summary has it."""
        return abs(self.summary["peaks"][name]["value"])

    def energy_error(self) -> float:
        """Largest over time, relative to the energy of the scene."""
        return abs(self.summary["energy"]["largest_error_relative"])
