#!/usr/bin/env bash
# What the two rules of contact with a boundary, and the laws without dashpots, do on nets that a structure moves: figures of docs/particles.md, one JSON
# object a run.
#   ./talus bench contact_rules
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# run NAME SCENE COLUMN CHANGES: the peak of a column and the largest error of the energy. One that the guard ends says so.
run() {
  printf 'extends: %s/configs/%s.yaml\n%s\n' "$root" "$2" "$4" > "$work/$1.yaml"
  "$TALUS_BUILD_DIR/bin/talus" run "$work/$1.yaml" --out "$work/$1" --quiet >/dev/null 2>&1 || true
  /usr/bin/python3 - "$work/$1/summary.json" "$1" "$3" <<'PYTHON'
import json, sys
summary = json.load(open(sys.argv[1]))
energy = (summary.get("energy") or {}).get("largest_error_relative")
peak = (summary.get("peaks") or {}).get(sys.argv[3], {}).get("value")
print(json.dumps({"run": sys.argv[2], "status": summary["status"], sys.argv[3]: peak and round(peak, 4), "energy_error": energy and float(f"{energy:.2g}")}))
PYTHON
}

run cable_net_tangent_plane examples/cable_net_converged net_centre.displacement_m 'particles: {contact_rule: tangent_plane}'
run cable_net_local_minima examples/cable_net_converged net_centre.displacement_m 'particles: {contact_rule: local_minima}'
run d1000_dashpots barriers/d1000 middle.displacement_m 'output: {fields_every: ~}'
run d1000_foundation barriers/d1000 middle.displacement_m "output: {fields_every: ~}
particles:
  implicit_contact: ~
  contacts:
    - {between: [concrete, wire], foundation: {stiffness_per_area: 1 GPa/m, restitution: 0.2}, friction: {coefficient: 0.4}}
  rocks: {block: {surface: {deviation: ~, spacing: 80 mm}}}"
