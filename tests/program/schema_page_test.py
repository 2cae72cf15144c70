"""docs/schema.md is what `talus schema` prints. Remake it with: ./talus schema > docs/schema.md"""
import pathlib
import subprocess
import sys

root, build = map(pathlib.Path, sys.argv[1:3])
printed = subprocess.run([build / "bin/talus", "schema"], check=True, capture_output=True, text=True).stdout
page = (root / "docs/schema.md").read_text()
if printed != page:
    sys.exit("docs/schema.md is out of date; remake it with: ./talus schema > docs/schema.md")
print("docs/schema.md is up to date")
