#!/usr/bin/env python3
"""Every scene of configs/examples/ and configs/barriers/ is extended by one of configs/regression/, which has a baseline. Argument: the repository."""
import pathlib
import re
import sys

configs = pathlib.Path(sys.argv[1], "configs")
regressions = sorted((configs / "regression").glob("*.yaml"))
covered = {(file.parent / match.group(1)).resolve()
           for file in regressions if (match := re.search(r"^extends: *(\S+)", file.read_text(), re.M))}
missing = [f"{example}: no regression extends it" for example in sorted([*(configs / "examples").glob("*.yaml"), *(configs / "barriers").glob("*.yaml")])
           if example.resolve() not in covered]
missing += [f"{file}: has no baseline; make it with talus regress --update" for file in regressions
            if not (file.parent / "baselines" / file.stem / "probes.csv").exists()]
print("\n".join(missing) or f"{len(regressions)} regressions cover all examples")
sys.exit(1 if missing else 0)
