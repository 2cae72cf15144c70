#!/usr/bin/env bash
# The paper's panel under one rock, computed in different ways: the table of docs/panel.md, one JSON object a run. Deflections and forces
# are peaks; wall times are those of the whole coupled run: on a busy machine read their ratios, and repeat.
#   ./talus bench panel
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { # name, scene
  "$TALUS_BUILD_DIR/bin/talus" run "$2" --out "$work/$1" --quiet >&2
  /usr/bin/python3 - "$1" "$work/$1" <<'PYTHON'
import json, sys
name, folder = sys.argv[1:]
summary = json.load(open(f"{folder}/summary.json"))
def peak(column): return summary["peaks"].get(column, {}).get("value")
limit = next(l["limit_s"] for l in summary["limits"] if "highest frequency" in l["name"])
print(json.dumps({"run": name, "deflection_m": peak("middle.displacement_z_m"), "edge_inwards_m": peak("edge.displacement_y_m"),
                  "rope_N": peak("south.axial_force_max_N"), "wrinkled_m2": peak("net.wrinkled_area_m2"), "step_limit_s": limit,
                  "energy_error": summary["energy"]["largest_error_relative"], "wall_s": round(summary["wall_time_s"], 3)}))
PYTHON
}

for scene in net_sliding_edges membrane_tension_field membrane_plain; do
  run "$scene" "$root/configs/examples/$scene.yaml"
done
for scene in membrane_tension_field membrane_plain; do
  printf 'extends: %s\nstructure: {parts: {net: {membrane: {orthotropic: ~, material_axis: ~, isotropic: {youngs_modulus: 6.911 GPa, poissons_ratio: 0}}}}}\n' \
    "$root/configs/examples/$scene.yaml" >"$work/$scene.yaml"
  run "${scene}_isotropic" "$work/$scene.yaml"
done
