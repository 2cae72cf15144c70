"""The faults that are made, and the copy they are made in.

Arguments: the folder of the repository."""
import os
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import workshop  # noqa: E402
from areas import AREAS  # noqa: E402
from mutations import in_turn, mutants_of  # noqa: E402

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
KERNEL = """#include <cmath>  // a - b
/// f = 2 k - c
double force(double k, const Quad<double>& v) {
  if (k < 0 && v.x > 1) throw Error("k - 1 < 0");
  double sum = 0.5 * k - v.y;
  sum += std::max(k, -v.z);
  for (int i = 0; i < 3; ++i) note(sum);
  return cross(a, b);
}
"""


def changes(text: str) -> list[tuple[str, str]]:
    return [(mutant.source, mutant.applied(text).splitlines()[mutant.line - 1].strip()) for mutant in mutants_of("a.cpp", text)]


class Faults(unittest.TestCase):
    def test_each_kind_is_made_where_it_can_be(self):
        made = {after for _, after in changes(KERNEL)}
        for expected in ("double sum = 0.5 * k + v.y;", "double sum = 0.5 * k;", "double sum = 1.0 * k - v.y;", "double sum = 0.25 * k - v.y;",
                         "double sum = 0.5 * k - v.z;", "sum -= std::max(k, -v.z);", "sum += std::min(k, -v.z);", "sum += std::max(k, v.z);", ";",
                         'if (k <= 0 && v.x > 1) throw Error("k - 1 < 0");', 'if (k < 0 || v.x > 1) throw Error("k - 1 < 0");', "return cross(b, a);"):
            self.assertIn(expected, made)

    def test_comments_texts_directives_loops_and_errors_stay_as_they_are(self):
        for before, after in changes(KERNEL):
            self.assertFalse(before.startswith(("#", "//")), before)
            self.assertIn('throw Error("k - 1 < 0")' if "throw" in before else "", after)
            self.assertTrue(after.startswith("for (int i = 0; i < 3; ++i)" if before.startswith("for") else ""), after)

    def test_every_mutant_differs_from_the_text_and_from_the_others_and_keeps_its_name_when_lines_come_before_it(self):
        mutants, later = mutants_of("a.cpp", KERNEL), mutants_of("a.cpp", "// new\n\n" + KERNEL)
        texts = [mutant.applied(KERNEL) for mutant in mutants]
        self.assertNotIn(KERNEL, texts)
        self.assertEqual(len(set(texts)), len(texts))
        self.assertEqual([mutant.id for mutant in mutants], [mutant.id for mutant in later])
        self.assertEqual(len({mutant.id for mutant in mutants}), len(mutants))

    def test_the_first_mutants_of_a_seed_are_the_same_and_come_from_all_areas(self):
        def groups():
            return {area.name: [m for file in area.files(ROOT) for m in mutants_of(file, (ROOT / file).read_text())] for area in AREAS}
        first, second, other = in_turn(groups(), 1), in_turn(groups(), 1), in_turn(groups(), 2)
        self.assertEqual(first, second)
        self.assertNotEqual(first, other)
        self.assertGreater(len(first), 1000)
        self.assertEqual({next(a.name for a in AREAS if m.file in a.files(ROOT)) for m in first[:len(AREAS)]}, {a.name for a in AREAS})

    def test_every_area_has_files_and_its_tests_are_programs_of_the_build(self):
        lists = "\n".join(path.read_text() for path in (ROOT / "tests").rglob("CMakeLists.txt"))
        for area in AREAS:
            self.assertTrue(area.files(ROOT), area.name)
            for test in area.tests:
                self.assertTrue(re.search(rf"talus_test\({test}\b", lists), test)


class Copy(unittest.TestCase):
    """With programs that only seem to build: ninja fails where a file says `+ k`, and takes for the test a script that looks for `v.z`."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        folder = pathlib.Path(self.folder.name)
        self.tree, tools = folder / "tree", folder / "tools"
        (folder / "build/bin").mkdir(parents=True)
        self.tree.mkdir()
        tools.mkdir()
        (self.tree / "a.cpp").write_text(KERNEL)
        self.script(tools / "ninja", "if grep -q '+ v.y' a.cpp; then echo 'a.cpp:1: error: no plus'; exit 1; fi")
        self.script(folder / "build/bin/looks_for_z", """grep -q 'k - v.z' a.cpp && sleep 60
grep -q 'max(k, -v.z)' a.cpp || { echo '<TestCase name="z &lt; 0"><OverallResult success="false"/></TestCase>'; exit 1; }""")
        path = os.environ["PATH"]
        os.environ["PATH"] = f"{tools}:{path}"
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        self.place = workshop.Workshop(ROOT, folder, 1)
        self.place.seconds = {"looks_for_z": 0.01}
        self.addCleanup(setattr, workshop, "LEAST", workshop.LEAST)
        workshop.LEAST = 1

    @staticmethod
    def script(path: pathlib.Path, text: str):
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def test_mutants_are_killed_survive_do_not_compile_or_take_too_long_and_leave_the_copy_as_it_was(self):
        results = {}
        for mutant in mutants_of("a.cpp", KERNEL):
            results[mutant.applied(KERNEL).splitlines()[mutant.line - 1].strip()] = self.place.try_out(mutant, ("looks_for_z",))
            self.assertEqual((self.tree / "a.cpp").read_text(), KERNEL)
        self.assertEqual(results["sum += std::min(k, -v.z);"], {"outcome": "killed", "by": "looks_for_z: z < 0"})
        self.assertEqual(results["double sum = 1.0 * k - v.y;"], {"outcome": "survived", "by": ""})
        self.assertEqual(results["double sum = 0.5 * k + v.y;"], {"outcome": "does not compile", "by": "no plus"})
        self.assertEqual(results["double sum = 0.5 * k - v.z;"]["outcome"], "timed out")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
