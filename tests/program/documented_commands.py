#!/usr/bin/env python3
"""Runs every command of README.md and docs/*.md that stands in a block marked ```sh, from the top of the repository.

A block marked ```text or ```console is shown, not run; `./talus test` itself is skipped, because this test is part of it. The commands
run in an empty folder that links to the repository's entries, so that their results never meet a user's."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```sh\n(.*?)^```", re.S | re.M)
SKIPPED = ("./talus test", "./talus bench", "./talus study", "./talus tune")  # the suite itself, and what takes minutes


def commands(page: pathlib.Path):
    for block in BLOCK.findall(page.read_text()):
        for line in block.replace("\\\n", " ").splitlines():
            command = line.split("  #")[0].strip()
            if command and not command.startswith("#") and not command.startswith(SKIPPED):
                yield command


def main(root: pathlib.Path, build: pathlib.Path) -> int:
    pages = [root / "README.md", *sorted((root / "docs").glob("*.md"))]
    failed, ran = [], 0
    environment = dict(os.environ, TALUS_BUILD_DIR=str(build), PATH=f"{build}/bin:{os.environ['PATH']}")
    with tempfile.TemporaryDirectory() as folder:
        for entry in root.iterdir():
            if entry.name not in ("results", "build", ".git"):
                pathlib.Path(folder, entry.name).symlink_to(entry)
        for page in pages:
            for command in commands(page):
                run = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True,
                                     stdin=subprocess.DEVNULL, capture_output=True, timeout=300)
                ran += 1
                if run.returncode != 0:
                    failed.append(f"{page.relative_to(root)}: {command}\n{run.stdout[-2000:]}{run.stderr[-2000:]}")
    print("\n".join(failed) or f"{ran} documented commands run")
    return 1 if failed or ran == 0 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
