"""A copy of the tree in a scratch folder, with a build of its own, in which mutants are built and judged. The tree itself is never touched."""
import html
import os
import pathlib
import re
import shutil
import signal
import subprocess
import threading
import time

from mutations import Mutant

BUILD_LIMIT = 900  # s; a mutant of a header that everything includes takes minutes
MARGIN, LEAST = 5, 20  # a test may take so many times as long as without a mutant, and so many seconds
WORST = 300  # s; of any test


class Broken(Exception):
    """Something other than a mutant is wrong."""


class Stopped(Exception):
    """The user ended it all."""


_stopping = threading.Event()
_running: set[int] = set()  # process groups


def stop() -> None:
    """Ends what runs; whoever waits for it is told by Stopped."""
    _stopping.set()
    for group in list(_running):
        _end(group)


def _end(group: int) -> None:
    try:
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        pass


def run(command: list[str], folder: pathlib.Path, limit: float) -> tuple[int | None, str]:
    """Exit code (None: it took too long, negative: a signal ended it) and output. Nothing that it started is left."""
    if _stopping.is_set():
        raise Stopped
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                               start_new_session=True, env=os.environ | {"GOMP_SPINCOUNT": "1000"})
    _running.add(process.pid)
    try:
        output, _ = process.communicate(timeout=limit)
        result = process.returncode, output
    except subprocess.TimeoutExpired:
        result = None, ""
    finally:
        _end(process.pid)
        _running.discard(process.pid)
        process.stdout.close()
        process.wait()
    if _stopping.is_set():
        raise Stopped
    return result


class Workshop:
    def __init__(self, root: pathlib.Path, scratch: pathlib.Path, compilers: int):
        self.root, self.tree, self.build = root, scratch / "tree", scratch / "build"
        self.compilers = compilers
        self.seconds = {}  # of each test program without a mutant

    def prepare(self, tests: list[str]) -> None:
        """Brings the copy up to date, builds the tests and runs them without a mutant."""
        self._copy()
        if not (self.build / "build.ninja").exists():
            self._succeed(["cmake", "--preset", "dev", "-B", str(self.build), "-DTALUS_BENCH=OFF"], 300)
        self._succeed(["ninja", "-C", str(self.build), f"-j{self.compilers}", *tests], 7200)
        for test in tests:
            begin = time.monotonic()
            outcome = self._judge(test, WORST)
            if outcome:
                raise Broken(f"without any mutant {test} fails: {outcome}")
            self.seconds[test] = time.monotonic() - begin

    def try_out(self, mutant: Mutant, tests: tuple[str, ...]) -> dict:
        """What becomes of a mutant: {"outcome": "killed" | "survived" | "timed out" | "does not compile", "by": the test}."""
        path = self.tree / mutant.file
        text = path.read_text()
        try:
            path.write_text(mutant.applied(text))
            code, output = run(["ninja", "-C", str(self.build), f"-j{self.compilers}", *tests], self.tree, BUILD_LIMIT)
            if code != 0:
                if code is None:
                    return {"outcome": "does not compile", "by": f"not built in {BUILD_LIMIT} s"}
                first = re.search(r"error: ([^\n]*)", output)
                return {"outcome": "does not compile", "by": first[1] if first else ""}
            for test in sorted(tests, key=self.seconds.get):
                outcome = self._judge(test, min(WORST, max(LEAST, MARGIN * self.seconds[test])))
                if outcome:
                    return {"outcome": "timed out" if outcome == "took too long" else "killed", "by": f"{test}: {outcome}"}
            return {"outcome": "survived", "by": ""}
        finally:
            path.write_text(text)  # with a new time, so that ninja builds it again

    def _judge(self, test: str, limit: float) -> str:
        """Empty where it passes; else the test case that fails, or how the program ended."""
        code, output = run([str(self.build / "bin" / test), "~[long]", "--abort", "--reporter", "xml"], self.tree, limit)
        if code == 0:
            return ""
        if code is None:
            return "took too long"
        failed = [found[1] for found in re.finditer(r'<TestCase name="([^"]*)"(?:(?!</TestCase>).)*?(?:success="false"|<FatalErrorCondition)', output, re.S)]
        return html.unescape(failed[0]) if failed else f"ended with {code}"

    def _copy(self) -> None:
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=self.root, capture_output=True, check=True).stdout
        wanted = {name.decode() for name in listed.split(b"\0") if name and (self.root / name.decode()).is_file()}
        for name in wanted:
            source, copy = self.root / name, self.tree / name
            if copy.is_file() and copy.read_bytes() == source.read_bytes():
                continue
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, copy)
        if self.tree.exists():
            for path in self.tree.rglob("*"):
                if path.is_file() and path.relative_to(self.tree).as_posix() not in wanted:
                    path.unlink()

    def _succeed(self, command: list[str], limit: float) -> None:
        code, output = run(command, self.tree, limit)
        if code != 0:
            raise Broken(f"{' '.join(command)} {'took too long' if code is None else 'failed'}:\n{output[-3000:]}")
