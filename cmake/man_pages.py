"""Manual pages from the help of the programs: man_pages.py FOLDER_OF_PROGRAMS VERSION OUTPUT_FOLDER writes talus.1, talus-run.1, ..., fem_solver.1."""
import pathlib
import re
import subprocess
import sys

ENTRY = re.compile(r"  (\S.*?)(?:\s{2,}(.*))?$")  # what is to be typed, then what it does


def escaped(text):
    text = text.replace("\\", r"\e").replace("-", r"\-")
    return r"\&" + text if text.startswith((".", "'")) else text


def entries(lines):
    """(typed, meaning) of each; a meaning may begin or go on in the next lines, further in."""
    found = []
    for line in lines:
        entry = ENTRY.match(line)
        if entry and not line.startswith("   "):
            found.append([entry[1], entry[2] or ""])
        elif found:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return found


def sections(text):
    """What stands before the first heading, then (heading, lines) of each part that begins with a line like "Options:"."""
    parts = [("", [])]
    for line in text.splitlines():
        if re.fullmatch(r"[A-Z][A-Za-z ]*:", line):
            parts.append((line[:-1], []))
        elif line.strip():
            parts[-1][1].append(line)
    return parts[0][1], parts[1:]


def page(name, text, version):
    head, parts = sections(text)
    usage = next(line.removeprefix("Usage: ") for line in head if line.startswith("Usage: "))
    purpose = " ".join(line for line in head if not line.startswith("Usage: "))
    roff = [f'.TH {name.upper()} 1 "" "talus {version}" "Talus"', ".SH NAME", f"{name} \\- {escaped(purpose.rstrip('.'))}",
            ".SH SYNOPSIS", escaped(usage)]
    for heading, lines in parts:
        roff.append(f".SH {heading.upper()}")
        if heading == "Example":
            roff += [".nf", *(escaped(line.strip()) for line in lines), ".fi"]
            continue
        for typed, meaning in entries(lines):
            roff += [".TP", rf"\fB{escaped(typed)}\fR", escaped(meaning)]
    return "\n".join(roff) + "\n"


def help_of(*command):
    return subprocess.run([*command, "--help"], capture_output=True, text=True, check=True).stdout


def main(programs, version, output):
    folder = pathlib.Path(output)
    folder.mkdir(parents=True, exist_ok=True)
    whole = help_of(f"{programs}/talus")
    pages = {name: help_of(f"{programs}/{name}") for name in ("dem_solver", "fem_solver")} | {"talus": whole}
    subcommands = next(lines for heading, lines in sections(whole)[1] if heading == "Subcommands")
    for subcommand, _ in entries(subcommands):
        pages[f"talus-{subcommand}"] = help_of(f"{programs}/talus", subcommand)
    for name, text in pages.items():
        (folder / f"{name}.1").write_text(page(name, text, version))


main(*sys.argv[1:])
