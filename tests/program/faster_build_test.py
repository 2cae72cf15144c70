"""A program for any x86-64 becomes its copy for x86-64-v3 where there is one and the processor has it.

faster_build_test.py PROGRAM; ends with 77 (skipped) on a processor without x86-64-v3."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

if not {"avx2", "fma", "bmi2"} <= set(pathlib.Path("/proc/cpuinfo").read_text().split()):
    print("skipped: this processor is no x86-64-v3")
    sys.exit(77)


class FasterBuild(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.prefix = pathlib.Path(place.name)
        self.program = self.prefix / "bin/program"
        self.program.parent.mkdir()
        shutil.copy(sys.argv[1], self.program)

    def add_copy(self):
        copy = self.prefix / "lib/talus/x86-64-v3/bin/program"
        copy.parent.mkdir(parents=True)
        copy.write_text('#!/bin/sh\necho "for v3: $*"\n')
        copy.chmod(0o755)

    def said(self, **variables):
        return subprocess.run([self.program, "--a", "b c"], capture_output=True, text=True, check=True, env=os.environ | variables).stdout

    def test_the_copy_for_newer_processors_runs_with_the_same_arguments(self):
        self.add_copy()
        self.assertEqual(self.said(), "for v3: --a b c\n")

    def test_without_a_copy_the_program_itself_runs(self):
        self.assertEqual(self.said(), "for any\n")

    def test_the_environment_can_keep_it_from_its_copy(self):
        self.add_copy()
        self.assertEqual(self.said(TALUS_CPU="x86-64"), "for any\n")

    def test_it_is_found_through_a_link_on_path(self):
        self.add_copy()
        link = self.prefix / "link"
        link.symlink_to(self.program)
        self.program = link
        self.assertEqual(self.said(), "for v3: --a b c\n")


unittest.main(argv=sys.argv[:1])
