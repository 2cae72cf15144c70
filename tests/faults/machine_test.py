"""What the machine refuses: full and read-only disks, little shared memory. And what a look at a scene must not do.

    machine_test.py ROOT BUILD

Small file systems are mounted in a name space of their own, which this test enters first; where that is not allowed, only the cases that
need none are run."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
DISK = ROOT / "tests/field/disk"
MACHINE = 7  # the exit code
INSIDE = "--inside"


def enter_name_space() -> None:
    """Starts this test again where it may mount; returns where that is not possible, or done."""
    if INSIDE in sys.argv:
        return
    enter = ["unshare", "--mount", "--propagation", "private"] + ([] if os.geteuid() == 0 else ["--user", "--map-root-user"])
    probe = subprocess.run([*enter, "mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", "/mnt"], capture_output=True)
    if probe.returncode == 0:
        os.execvp(enter[0], [*enter, sys.executable, *sys.argv, INSIDE])


class Disk:
    """A small file system in a folder."""

    def __init__(self, size: str, path: pathlib.Path | None = None):
        self.path = path or pathlib.Path(tempfile.mkdtemp())
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", self.path], check=True)

    def fill(self) -> None:
        with open(self.path / "fill", "wb", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(4096))
            except OSError:
                pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", self.path], check=True)


def run(scene: pathlib.Path, *options, command: str = "run") -> subprocess.CompletedProcess:
    return subprocess.run([BUILD / "bin/talus", command, scene, *options], capture_output=True, text=True, timeout=120)


def check(condition: bool, done: subprocess.CompletedProcess) -> None:
    if not condition:
        raise AssertionError(f"exit code {done.returncode}\n{done.stdout}{done.stderr}")


def errors(done: subprocess.CompletedProcess) -> list[str]:
    return [line for line in done.stderr.splitlines() if line.startswith("error")]


def a_disk_that_fills_up_ends_a_run_as_failed_with_the_cause():
    for scene in ("midrun", "scene"):
        with Disk("2m") as disk:
            done = run(DISK / f"{scene}.yaml", "--out", disk.path / "result", "--quiet")
            check(done.returncode == MACHINE and len(errors(done)) == 1 and "No space left on device" in errors(done)[0], done)
            summary = json.loads((disk.path / "result/summary.json").read_text())
            check(summary["status"] == "failed" and "No space left on device" in summary["message"], done)


def a_disk_that_is_full_from_the_start_is_said_in_one_sentence():
    with Disk("2m") as disk:
        disk.fill()
        done = run(DISK / "scene.yaml", "--out", disk.path / "result", "--quiet")
        check(done.returncode == MACHINE and len(errors(done)) == 1 and "No space left on device" in errors(done)[0], done)


def what_a_run_on_a_full_disk_left_is_replaced_once_there_is_room():
    with Disk("2m") as disk:
        run(DISK / "midrun.yaml", "--out", disk.path / "result", "--quiet")
        scene = pathlib.Path(tempfile.mkdtemp()) / "scene.yaml"
        scene.write_text(f"extends: {DISK}/cable_net.yaml\ntime: {{end: 1 ms}}\noutput: {{fields_every: ~}}\n")
        done = run(scene, "--out", disk.path / "result", "--quiet", "--overwrite")
        check(done.returncode == 0, done)
        check(not list((disk.path / "result").glob("*.part")), done)


def a_folder_that_is_read_only_is_an_error_of_the_machine():
    with Disk("2m") as disk:
        subprocess.run(["mount", "-o", "remount,ro", disk.path], check=True)
        done = run(DISK / "scene.yaml", "--out", disk.path / "result", "--quiet")
        check(done.returncode == MACHINE and len(errors(done)) == 1 and "Read-only file system" in errors(done)[0], done)


def a_run_goes_on_where_only_a_checkpoint_finds_no_room():
    with Disk("240k") as disk:  # a checkpoint has 180 kB, the rest of the result 110
        scene = disk.path / "scene.yaml"
        scene.write_text(f"extends: {DISK}/cable_net.yaml\ntime: {{end: 0.1 s}}\noutput: {{every: 10 ms, fields_every: ~}}\n"
                         "coupling: {checkpoint_every: 5 ms}\n")
        done = run(scene, "--out", disk.path / "result", "--quiet")
        check(done.returncode == 0, done)
        check(done.stderr.count("the run goes on without") == 1 and "No space left on device" in done.stderr, done)
        check(json.loads((disk.path / "result/summary.json").read_text())["status"] == "finished", done)
        check(not list((disk.path / "result").glob("*.part")), done)


def shared_memory_that_does_not_suffice_is_said_with_what_needs_how_much():
    for size, part in (("100k", "the run needs "), ("220k", "The outputs of the structure (tables, fields) take ")):
        with Disk(size, pathlib.Path("/dev/shm")):
            done = run(DISK / "scene.yaml", "--out", pathlib.Path(tempfile.mkdtemp()) / "result", "--quiet")
            check(done.returncode == MACHINE and len(errors(done)) == 1, done)
            check("of shared memory, but /dev/shm has" in done.stderr and "--shm-size=" in done.stderr and part in done.stderr, done)


def a_look_at_a_scene_starts_no_program_that_it_names_unless_it_is_trusted():
    folder = pathlib.Path(tempfile.mkdtemp())
    started, program, scene = folder / "started", folder / "fem_solver", folder / "scene.yaml"
    program.write_text(f"#!/bin/sh\ntouch {started}\nexec {BUILD}/bin/fem_solver \"$@\"\n")
    program.chmod(0o700)
    scene.write_text(f"extends: {DISK}/cable_net.yaml\n")
    whole = run(scene, command="check")
    scene.write_text(f"extends: {DISK}/cable_net.yaml\nstructure: {{solver: fem_solver}}\n")
    for command in ("check", "explain"):
        looked = run(scene, command=command)
        check(looked.returncode == 0 and not started.exists(), looked)
        check(str(program) in looked.stdout and "--trust" in looked.stdout and "structure was not asked" in looked.stdout, looked)
    trusted = run(scene, "--trust", command="check")
    check(started.exists() and trusted.stdout == whole.stdout and str(program) in trusted.stderr, trusted)


def what_cannot_be_printed_is_an_error_of_the_machine():
    scene = pathlib.Path(tempfile.mkdtemp()) / "scene.yaml"
    scene.write_text(f"extends: {DISK}/cable_net.yaml\n")
    for command in (["schema"], ["check", scene]):
        with open("/dev/full", "w") as full:
            done = subprocess.run([BUILD / "bin/talus", *command], stdout=full, stderr=subprocess.PIPE, text=True, timeout=120)
        done.stdout = ""
        check(done.returncode == MACHINE and len(errors(done)) == 1, done)


def main() -> None:
    cases = [what_cannot_be_printed_is_an_error_of_the_machine, a_look_at_a_scene_starts_no_program_that_it_names_unless_it_is_trusted]
    mounted = [a_disk_that_fills_up_ends_a_run_as_failed_with_the_cause, a_disk_that_is_full_from_the_start_is_said_in_one_sentence,
               what_a_run_on_a_full_disk_left_is_replaced_once_there_is_room, a_folder_that_is_read_only_is_an_error_of_the_machine,
               a_run_goes_on_where_only_a_checkpoint_finds_no_room,
               shared_memory_that_does_not_suffice_is_said_with_what_needs_how_much]
    enter_name_space()
    if INSIDE not in sys.argv:
        print("small disks cannot be mounted here; only what needs none is tested")
        mounted = []
    for case in cases + mounted:
        case()
        print("right:", case.__name__.replace("_", " "))


if __name__ == "__main__":
    main()
