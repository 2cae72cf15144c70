#!/usr/bin/env bash
# Chains of rings pulled until one breaks: the table of docs/nets.md, one JSON object a chain. Those with 5, 9 and 16 windings and three rings are the
# tests that rings are calibrated on; all others are predictions.
#   ./talus bench ring_chains
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

pull() { # rings, windings
  local rings=$1 nodes="" segments="" k
  for ((k = 0; k <= rings; ++k)); do nodes+="[$(/usr/bin/python3 -c "print(0.3 * $k)") m, 0 m, 0 m], "; done
  for ((k = 0; k < rings; ++k)); do segments+="[$k, $((k + 1))], [$((k + 1)), $k], "; done
  local longest
  longest=$(/usr/bin/python3 -c "print(0.53 / 3 * $rings)")
  cat >"$work/scene.yaml" <<YAML
extends: $root/configs/examples/ring_chain.yaml
time: {end: 1 s}
structure:
  parts:
    chain: {mesh: {nodes: [$nodes], segments: [$segments]}, ring: {windings: $2}}
  supports:
    - {nodes: chain.0, fix: xyz}
    - {nodes: chain.$rings, fix: xyz, displacement: [$longest m, 0 m, 0 m], over_time: [[0 s, 0], [1 s, 1]]}
output: {every: 0.1 ms, probes: {end: {at: [$(/usr/bin/python3 -c "print(0.3 * $rings)") m, 0 m, 0 m]}}}
YAML
  "$TALUS_BUILD_DIR/bin/fem_solver" "$work/scene.yaml" --out "$work/result" --overwrite --quiet >&2
  /usr/bin/python3 - "$work/result" "$1" "$2" <<'PYTHON'
import csv, json, sys
rows = list(csv.DictReader(open(sys.argv[1] + "/probes.csv")))
rings = int(sys.argv[2])
force = [float(row[f"chain.{rings}.reaction_x_N"]) for row in rows]
way = [float(row["end.displacement_x_m"]) for row in rows]
last = max(range(len(force)), key=force.__getitem__)
bent = min(range(last), key=lambda k: abs(way[k] - 0.85 * way[last]))
print(json.dumps({"rings": rings, "windings": int(sys.argv[3]), "force_kN": round(force[last] / 1e3, 2), "elongation_mm": round(way[last] * 1e3, 1),
                  "force_at_85_percent": round(force[bent] / force[last], 3)}))
PYTHON
}

for rings in 3 5; do
  for windings in 3 5 7 9 12 16 19; do pull "$rings" "$windings"; done
done
