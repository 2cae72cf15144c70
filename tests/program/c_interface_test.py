"""The C library shows the calls of its header and nothing else, and the Fortran module says the same as the header.

c_interface_test.py SOURCE BUILD"""
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
HEADER = re.sub(r"/\*.*?\*/", "", (SOURCE / "coupler/c_api/talus.h").read_text(), flags=re.S)
MODULE = re.sub(r"!.*", "", (SOURCE / "examples/participants/talus.f90").read_text()).replace("&\n", "")
FORTRAN = {"size_t": "integer(c_size_t)", "int64_t": "integer(c_int64_t)", "int32_t": "integer(c_int32_t)", "int": "integer(c_int)",
           "double": "real(c_double)"}
ENUMS = dict(reversed(pair) for pair in re.findall(r"typedef enum \{(.*?)\} (\w+);", HEADER, re.S))
CALLS = re.findall(r"^\w[\w* ]* \*?(talus_\w+)\(([^;]*?)\);", HEADER, re.M | re.S)


def words(text):
    return [" ".join(word.split()) for word in text.strip().strip(",").split(",")]


def members_in_c(body):
    """Type and name of each, in order: a pointer is a c_ptr, an enumeration an int."""
    for line in filter(None, (" ".join(line.split()) for line in body.split(";"))):
        if "*" in line:
            yield "type(c_ptr)", line.split()[-1].lstrip("*")
            continue
        kind, names = line.split(" ", 1)
        for name in words(names):
            yield FORTRAN["int" if kind in ENUMS else kind], name


def members_in_fortran(body):
    for line in filter(None, (line.strip() for line in body.splitlines())):
        kind, names = line.split(" :: ")
        for name in words(names):
            yield kind, name.split(" = ")[0]


class CInterface(unittest.TestCase):
    def test_the_library_exports_the_calls_of_its_header_and_nothing_else(self):
        told = subprocess.run(["nm", "-D", "--defined-only", BUILD / "bin/libtalus_c.so"], capture_output=True, text=True, check=True)
        exported = {line.split()[-1] for line in told.stdout.splitlines()}
        self.assertGreater(len(CALLS), 30)
        self.assertEqual(exported, {name for name, _ in CALLS})

    def test_structs_in_fortran_have_the_members_of_those_in_c(self):
        in_c = {name: list(members_in_c(body)) for body, name in re.findall(r"typedef struct \{(.*?)\} (\w+);", HEADER, re.S)}
        in_fortran = {name: list(members_in_fortran(body))
                      for name, body in re.findall(r"type, bind\(C\) :: (\w+)\n(.*?)\n\s*end type", MODULE, re.S)}
        self.assertEqual(in_fortran, in_c)

    def test_every_struct_begins_with_its_size(self):
        for body, name in re.findall(r"typedef struct \{(.*?)\} (\w+);", HEADER, re.S):
            self.assertTrue(body.strip().startswith("size_t size;"), name)

    def test_enumerations_in_fortran_have_the_names_of_those_in_c_in_their_order(self):
        in_fortran = [words(" ".join(names.split())) for names in re.findall(r"enumerator :: (.*?)\n\s*end enum", MODULE, re.S)]
        self.assertEqual(in_fortran, [words(body) for body in ENUMS.values()])

    def test_calls_in_fortran_have_the_arguments_of_those_in_c(self):
        in_c = {name: [] if arguments == "void" else [re.search(r"\w+$", one)[0] for one in words(arguments)]
                for name, arguments in CALLS}
        in_fortran = {name: [one for one in words(arguments) if one]
                      for name, arguments in re.findall(r"(?:function|subroutine) (talus_\w+)\((.*?)\) bind\(C\)", MODULE)}
        self.assertEqual(in_fortran, in_c)


unittest.main(argv=sys.argv[:1])
