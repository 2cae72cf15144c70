#!/usr/bin/env bash
# Interrupts three coupled scenes at random windows (Ctrl-C, which leaves a checkpoint) or kills them at random moments (kill -9, after which the
# last automatic checkpoint counts), restarts them, and compares the tables with those of the run in one piece, byte by byte. One JSON object a
# scene and kind; ends with 1 where anything differs.
#   ./talus bench restarts [TIMES]     (100 where not given; some minutes)
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
exec /usr/bin/python3 "$root/bench/restarts.py" "$TALUS_BUILD_DIR/bin/talus" "$root/configs/examples" "${1:-100}"
