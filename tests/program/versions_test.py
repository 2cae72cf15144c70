"""What users cite and read of a version is the version they run: CITATION.cff, CHANGELOG.md, `talus --version`.

versions_test.py SOURCE BUILD"""
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
VERSION = re.search(r"project\(Talus VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


class Versions(unittest.TestCase):
    def test_the_program_prints_the_version_of_the_project(self):
        said = subprocess.run([BUILD / "bin/talus", "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.strip(), f"talus {VERSION}")

    def test_the_citation_names_it(self):
        self.assertIn(f"\nversion: {VERSION}\n", (SOURCE / "CITATION.cff").read_text())

    def test_the_newest_entry_of_the_changes_is_for_it(self):
        self.assertEqual(re.search(r"^## ([\d.]+)", (SOURCE / "CHANGELOG.md").read_text(), re.M)[1], VERSION)


unittest.main(argv=sys.argv[:1])
