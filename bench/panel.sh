#!/usr/bin/env bash
# The paper's panel under one rock, computed in different ways: the tables of docs/panel.md, one JSON object a run. Deflections, forces and
# gaps are peaks; wall times are those of the whole coupled run, times of a step those of the structure alone: on a busy machine read their
# ratios, and repeat.
#   ./talus bench panel
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
longest_step=25e-6

run() { # name, scene: at 25 us, or half of the structure's limit where that is shorter
  "$TALUS_BUILD_DIR/bin/bench_panel_structure" "$2" >"$work/alone.json"
  local step
  step=$(/usr/bin/python3 -c "import json; print(min($longest_step, 0.5 * json.load(open('$work/alone.json'))['step_limit_s']))")
  printf 'extends: %s\ntime: {step: %s}\noutput: {fields_every: ~}\n' "$2" "$step" >"$work/run.yaml"
  "$TALUS_BUILD_DIR/bin/talus" run "$work/run.yaml" --out "$work/$1" --quiet >&2
  /usr/bin/python3 - "$1" "$work/$1" "$work/alone.json" "$step" <<'PYTHON'
import json, sys
name, folder, alone, step = sys.argv[1:]
summary = json.load(open(f"{folder}/summary.json"))
def peak(column): return summary["peaks"].get(column, {}).get("value")
print(json.dumps({"run": name, "deflection_m": peak("middle.displacement_z_m"), "edge_inwards_m": peak("edge.displacement_y_m"),
                  "rope_N": peak("south.axial_force_max_N"), "gap_m": peak("edge_south.gap_max_m"),
                  "wrinkled_m2": peak("net.wrinkled_area_m2"), "energy_error": summary["energy"]["largest_error_relative"],
                  "step_s": float(step), "wall_s": round(summary["wall_time_s"], 3), **json.load(open(alone))}))
PYTHON
}

for scene in net_sliding_edges net_mpc_edges membrane_tension_field membrane_plain; do
  run "$scene" "$root/configs/examples/$scene.yaml"
done
for scene in membrane_tension_field membrane_plain; do
  printf 'extends: %s\nstructure: {parts: {net: {membrane: {orthotropic: ~, material_axis: ~, isotropic: {youngs_modulus: 6.911 GPa, poissons_ratio: 0}}}}}\n' \
    "$root/configs/examples/$scene.yaml" >"$work/$scene.yaml"
  run "${scene}_isotropic" "$work/$scene.yaml"
done
for stiffness in 2e3 2e4 2e5 2e6 2e7 2e8 2e9; do
  slides=""
  for edge in south east north west; do slides+="edge_$edge: {penalty: {stiffness: $stiffness}}, "; done
  printf 'extends: %s\nstructure: {slides: {%s}}\n' "$root/configs/examples/net_penalty_edges.yaml" "${slides%, }" >"$work/penalty.yaml"
  run "penalty_$stiffness" "$work/penalty.yaml"
done
