#!/usr/bin/env bash
# Energy error of configs/hard/snapping_net.yaml over the step, the table of docs/step_limits.md: one JSON object a line.
# Usage: bench/snapping_net.sh [folder of the built programs]
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
programs=${1:-$root/build/release/bin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for microseconds in 600 500 400 300 200 100; do
  printf 'extends: %s\ntime: {step: %s us}\n' "$root/configs/hard/snapping_net.yaml" "$microseconds" > "$work/scene.yaml"
  "$programs/fem_solver" "$work/scene.yaml" --quiet --overwrite --out "$work/result"
  python3 - "$work/result/summary.json" <<'PYTHON'
import json, sys
summary = json.load(open(sys.argv[1]))
step, limit = summary["step_s"], summary["limits"][0]["seconds"]
print(json.dumps({"step_s": step, "step_over_limit": round(step / limit, 3),
                  "energy_error_relative": summary["energy"]["largest_error_relative"]}))
PYTHON
done
