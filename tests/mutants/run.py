#!/usr/bin/env python3
"""Makes small faults in the kernels, one at a time, and tells which of them no test sees. See docs/testing.md.

    tests/mutants/run.py --list --count 50
    tests/mutants/run.py --count 300
    tests/mutants/run.py --count 300 --report
"""
import argparse
import concurrent.futures
import fnmatch
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

sys.dont_write_bytecode = True
from areas import AREAS  # noqa: E402
from mutations import Mutant, in_turn, mutants_of  # noqa: E402
from workshop import Broken, Stopped, Workshop, stop  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUTCOMES = ("killed", "timed out", "survived", "does not compile")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Mutants of the kernels: which of them no test sees.")
    parser.add_argument("--count", type=int, default=300, help="of mutants, spread over areas and kinds (default 300)")
    parser.add_argument("--seed", type=int, default=1, help="of the choice; the first mutants of a seed stay the same when more are asked for")
    parser.add_argument("--files", action="append", metavar="GLOB", help="only files that match, such as 'coupler/schemes/*'; may be given again")
    parser.add_argument("--list", action="store_true", help="show the chosen mutants and do nothing")
    parser.add_argument("--report", action="store_true", help="show what is known of the chosen mutants and do nothing")
    parser.add_argument("--again", action="store_true", help="judge those again that survived, after tests were written")
    parser.add_argument("--jobs", type=int, default=1, help="copies of the tree that are built side by side (default 1, which uses all cores)")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no mutant after so long")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results/mutants.json", help="file to go on from (default results/mutants.json)")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the copies (default: one below the temporary folder, kept for the next time)")
    return parser.parse_args()


def chosen(options: argparse.Namespace) -> list[tuple[Mutant, int]]:
    """With the number of their area."""
    wanted = options.files or ["*"]
    groups, area_of = {}, {}
    for number, area in enumerate(AREAS):
        files = [file for file in area.files(ROOT) if any(fnmatch.fnmatch(file, glob) for glob in wanted)]
        groups[area.name] = [mutant for file in files for mutant in mutants_of(file, (ROOT / file).read_text())]
        area_of |= {file: number for file in files}
    return [(mutant, area_of[mutant.file]) for mutant in in_turn(groups, options.seed)[:options.count]]


class Record:
    """What became of mutants, in a file that is whole whenever the program is stopped."""

    def __init__(self, path: pathlib.Path):
        self.path, self.lock = path, threading.Lock()
        self.known = json.loads(path.read_text()) if path.exists() else {}
        self.commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True).stdout.strip()

    def outcome(self, mutant: Mutant) -> str | None:
        return self.known.get(mutant.id, {}).get("outcome")

    def add(self, mutant: Mutant, result: dict) -> None:
        with self.lock:
            self.known[mutant.id] = result | {"mutant": str(mutant), "commit": self.commit}
            self.path.parent.mkdir(parents=True, exist_ok=True)
            unfinished = self.path.with_suffix(".unfinished")
            unfinished.write_text(json.dumps(self.known, indent=1))
            unfinished.replace(self.path)


def table(mutants: list[tuple[Mutant, int]], record: Record) -> str:
    rows = [("area", "mutants", *OUTCOMES, "not tried", "share killed")]
    for number, area in [*enumerate(AREAS), (None, None)]:
        of_area = [record.outcome(mutant) for mutant, own in mutants if number in (own, None)]
        if not of_area:
            continue
        counts = [of_area.count(outcome) for outcome in OUTCOMES]
        found, judged = counts[0] + counts[1], sum(counts[:3])
        rows.append((area.name if area else "all", len(of_area), *counts, of_area.count(None), f"{100 * found / judged:.0f} %" if judged else "-"))
    widths = [max(len(str(row[k])) for row in rows) for k in range(len(rows[0]))]
    return "\n".join("  ".join(f"{str(cell):<{w}}" if k == 0 else f"{str(cell):>{w}}" for k, (cell, w) in enumerate(zip(row, widths))) for row in rows)


def report(mutants: list[tuple[Mutant, int]], record: Record) -> None:
    print(table(mutants, record))
    survivors = [str(mutant) for mutant, _ in mutants if record.outcome(mutant) == "survived"]
    if survivors:
        print(f"\n{len(survivors)} survived:", *sorted(survivors), sep="\n  ")
    other = {record.known[mutant.id]["commit"] for mutant, _ in mutants if record.outcome(mutant)} - {record.commit}
    if other:
        print(f"\nThis is {record.commit}; some were judged at {', '.join(sorted(other))}.")


def work(workshop: Workshop, share: list[tuple[Mutant, int]], record: Record, deadline: float) -> None:
    workshop.prepare(sorted({test for _, area in share for test in AREAS[area].tests}))
    for number, (mutant, area) in enumerate(share, 1):
        if time.monotonic() > deadline:
            return
        begin = time.monotonic()
        result = workshop.try_out(mutant, AREAS[area].tests)
        record.add(mutant, result)
        print(f"{number}/{len(share)}  {time.monotonic() - begin:.0f} s  {result['outcome']:<16}  {mutant}  {result['by']}", flush=True)


def main() -> int:
    options = arguments()
    mutants = chosen(options)
    if options.list:
        print(*(mutant for mutant, _ in mutants), sep="\n")
        return 0
    record = Record(options.results)
    if options.report:
        report(mutants, record)
        return 0
    left = [pair for pair in mutants if record.outcome(pair[0]) is None or options.again and record.outcome(pair[0]) == "survived"]
    if options.seconds == float("inf"):
        left.sort(key=lambda pair: (pair[0].file, pair[0].begin))  # a file once touched is built anyway
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop())
    scratch = options.scratch or pathlib.Path(tempfile.gettempdir()) / f"talus_mutants_{hashlib.sha1(str(ROOT).encode()).hexdigest()[:8]}"
    deadline = time.monotonic() + options.seconds
    cores = max(1, (os.cpu_count() or 1) // options.jobs)
    shares = [share for share in (left[k::options.jobs] for k in range(options.jobs)) if share]
    with concurrent.futures.ThreadPoolExecutor(max(1, len(shares))) as pool:
        jobs = [pool.submit(work, Workshop(ROOT, scratch / str(k), cores), share, record, deadline) for k, share in enumerate(shares)]
        faults = [fault for fault in (job.exception() for job in jobs) if fault]
    report(mutants, record)
    for fault in faults:
        if isinstance(fault, Broken):
            print(f"mutants: {fault}", file=sys.stderr)
        elif isinstance(fault, Stopped):
            print("mutants: stopped; the same command goes on from here", file=sys.stderr)
        else:
            raise fault
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
