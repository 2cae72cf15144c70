#!/usr/bin/env bash
# What each effect costs when a scene names it: instructions and time of a step with and without it. Writes docs/effects.md; takes minutes.
#   ./talus bench effects
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
command -v valgrind >/dev/null || { echo "effects: valgrind is not installed" >&2; exit 2; }
exec python3 "$root/bench/effects.py" "$root" "$TALUS_BUILD_DIR" "$root/docs/effects.md"
