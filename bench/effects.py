"""What the effects of the examples cost, see effects.sh. Arguments: the folder of the repository, the folder of the build, the page to write.

Instructions are counted by callgrind over all processes of a run, at two lengths; their difference is that of the steps, without the start. Times are
the median of several runs of the full length, so that they include what instructions do not tell (memory, waiting)."""
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT, BUILD, PAGE = map(pathlib.Path, sys.argv[1:4])
REPEATS = 3
COUNTED_WINDOWS = 200

GRAVITY_FREE = "particles: {gravity: ~}"
# Scene, effect, what leaves it out (or, where the scene has not got it, what puts it in).
EFFECTS = [
    ("cable_net", "mass-proportional damping", "without", "structure: {damping: ~}"),
    ("cable_net", "gravity on the rocks", "without", GRAVITY_FREE),
    ("cable_net", "friction and rotation", "without",
     "particles: {contacts: [{between: [rock, wire], hertz: {restitution: 0.2}}, {between: [rock, rock], hertz: {restitution: 0.2}}]}"),
    ("cable_net", "fields every 5 ms", "without", "output: {fields_every: ~}"),
    ("cable_net", "gravity on the net", "with", "structure: {gravity: [0, -6.378103, -6.378103]}"),
    ("cable_net", "stiffness-proportional damping", "with", "structure: {damping: {stiffness: 1e-7 s}}"),
    ("cable_net", "implicit contact", "with", "particles: {implicit_contact: {}}"),
    ("cable_net", "stage times", "with", "output: {stage_times: {}}"),
    ("net_sliding_edges", "friction of the ropes", "with",
     "structure: {parts: {%s}}" % ", ".join("%s: {sliding_cable: {friction: 0.1}}" % side for side in ("south", "east", "north", "west"))),
    ("rocks_and_stones", "gravity on the stones", "without", GRAVITY_FREE),
    ("rocks_and_stones", "gates", "without", "particles: {gates: ~}"),
    ("rocks_and_stones", "rolling resistance", "without",
     "particles: {contacts: [{between: [stone, stone], hertz: {restitution: 0.3}, friction: {coefficient: 0.6}},"
     " {between: [stone, ground], hertz: {restitution: 0.3}, friction: {at_rest: 0.7, sliding: 0.5, decay_speed: 0.1}}]}"),
    ("rocks_and_stones", "friction, rotation and rolling resistance", "without",
     "particles: {contacts: [{between: [stone, stone], hertz: {restitution: 0.3}}, {between: [stone, ground], hertz: {restitution: 0.3}}]}"),
]


class Scene:
    def __init__(self, name: str, folder: str, change: str = ""):
        self.file = pathlib.Path(folder, "scene.yaml")
        self.result = pathlib.Path(folder, "result")
        self.extends = f"extends: {ROOT}/configs/examples/{name}.yaml\n{change}\n"

    def run(self, end: float | None = None, prefix: tuple = ()) -> tuple[dict, str]:
        self.file.write_text(self.extends)
        scene = self.file
        if end is not None:
            scene = self.file.with_name("shorter.yaml")
            scene.write_text(f"extends: scene.yaml\ntime: {{end: {end!r}}}\n")
        done = subprocess.run([*prefix, BUILD / "bin/talus", "run", scene, "--out", self.result, "--overwrite", "--quiet"], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"effects: {self.extends}{done.stderr}")
        return json.loads((self.result / "summary.json").read_text()), done.stderr

    def seconds_a_window(self) -> float:
        summaries = [self.run()[0] for _ in range(REPEATS)]
        return statistics.median(s["wall_time_s"] for s in summaries) / (summaries[0]["simulated_time_s"] / summaries[0]["window_s"])

    def instructions_a_window(self, window: float, begin: float) -> float:
        """From `begin` on, where the rock has reached the net."""
        counts = []
        for end in (begin, begin + COUNTED_WINDOWS * window):
            callgrind = ("valgrind", "--tool=callgrind", "--trace-children=yes", f"--callgrind-out-file={self.file.parent}/counts.%p")
            _, log = self.run(end, callgrind)
            counts.append(sum(map(int, re.findall(r"Collected : (\d+)", log))))
        return (counts[1] - counts[0]) / COUNTED_WINDOWS


def measure(name: str, change: str = "") -> dict:
    with tempfile.TemporaryDirectory() as folder:
        scene = Scene(name, folder, change)
        summary, _ = scene.run()
        window = summary["window_s"]
        begin = round(0.2 * summary["simulated_time_s"] / window) * window
        return {"instructions": scene.instructions_a_window(window, begin), "seconds": scene.seconds_a_window()}


def row(name: str, effect: str, how: str, plain: dict, changed: dict) -> str:
    with_it, without = (plain, changed) if how == "without" else (changed, plain)
    more = {key: with_it[key] / without[key] - 1 for key in plain}
    return (f"| `{name}` | {effect} | {without['instructions'] / 1e3:.1f} k | {with_it['instructions'] / 1e3:.1f} k | {more['instructions']:+.1%} "
            f"| {without['seconds'] * 1e6:.1f} us | {with_it['seconds'] * 1e6:.1f} us | {more['seconds']:+.0%} |")


INTRODUCTION = """# What effects cost

`./talus explain SCENE` lists the effects that a scene names, and those that it does not. What it does not name costs nothing:
`tests/verification/effects/effects_test.py` counts the instructions of the steps of a scene without optional effects and those of a lean program of the
same kernels that contains none, and allows 0.5 % between them.

`./talus explain RESULT` says of a run what took its time, where its energy went, what could be left out and what seems to be missing. The times need
`output: {stage_times: {}}` in the scene:

```sh
./talus run configs/examples/rocks_and_stones.yaml
./talus explain results/rocks_and_stones
```

## What each costs when it is on

Made by `./talus bench effects`: instructions of one coupling window of both solvers and the coupler, from a fifth of the run on (callgrind), and wall time of
a window over the whole run (median of %d runs). Read differences of a few percent in time as noise; instructions repeat exactly.

| example | effect | without | with | more instructions | without | with | more time |
|---|---|---|---|---|---|---|---|
"""


def main():
    plain, rows = {}, []
    for name, effect, how, change in EFFECTS:
        if name not in plain:
            plain[name] = measure(name)
        rows.append(row(name, effect, how, plain[name], measure(name, change)))
        print(rows[-1], flush=True)
    notes = PAGE.read_text().partition("\n## What the figures say\n") if PAGE.exists() else ("", "", "")
    PAGE.write_text(INTRODUCTION % REPEATS + "\n".join(rows) + "\n" + notes[1] + notes[2])


main()
