"""Called by restarts.sh: restarts.py TALUS EXAMPLES TIMES."""

import json
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

talus, examples, times = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
CLOSE = "particles: {spheres: {boulder: {at: [1.5, 1.729, 0.22]}}}"  # it touches the net from 2 ms on
SCENES = {  # what each adds to the example of its name
    "cable_net": f"time: {{end: 20 ms}}\n{CLOSE}\ncoupling: {{checkpoint_every: 5 ms, longest_window: 0.5 ms}}",
    "net_sliding_edges": "time: {end: 50 ms}\ncoupling: {checkpoint_every: 5 ms}",
    "cable_net_implicit": f"time: {{end: 20 ms}}\n{CLOSE}\ncoupling: {{checkpoint_every: 5 ms}}",
}
TABLES = ("probes.csv", "energy.csv")


def start(scene, out, *more):
    command = [talus, "run", scene, "--out", out, "--overwrite", "--quiet", *more]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)


def finish(run):
    message = run.communicate()[1]
    if run.returncode != 0:
        sys.exit(f"{' '.join(map(str, run.args))} ended with {run.returncode}: {message}")


def stop_somewhere(scene, out, number, seconds):
    """Sends the signal at a random moment of the run until one comes after the first checkpoint and before the end. Returns the duration to
    choose from next time: shorter where runs had ended before, longer where they had not yet begun, as the machine is more or less busy."""
    while True:
        run = start(scene, out)
        time.sleep(random.uniform(0, seconds))
        run.send_signal(number)
        run.communicate()
        if run.returncode == 0:
            seconds *= 0.95
        elif (out / "checkpoint.h5").exists():
            return seconds
        else:
            seconds *= 1.02


def check(name, kind, number, scene, folder, seconds):
    whole = folder / "whole"
    different = 0
    for _ in range(times):
        seconds = stop_somewhere(scene, folder / "stopped", number, seconds)
        finish(start(scene, folder / "restarted", "--restart", folder / "stopped" / "checkpoint.h5"))
        different += any((folder / "restarted" / t).read_bytes() != (whole / t).read_bytes() for t in TABLES)
    print(json.dumps({"scene": name, "stopped_by": kind, "restarts": times, "different": different}), flush=True)
    return different


random.seed(1)
bad = 0
for name, more in SCENES.items():
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        scene = folder / "scene.yaml"
        scene.write_text(
            f"extends: {examples / name}.yaml\n{more}\noutput: {{every: 1 ms, fields_every: ~}}\n"
        )
        begin = time.monotonic()
        finish(start(scene, folder / "whole"))
        seconds = time.monotonic() - begin
        bad += check(name, "ctrl_c", signal.SIGINT, scene, folder, seconds)
        bad += check(name, "kill_9", signal.SIGKILL, scene, folder, seconds)
sys.exit(bad > 0)
