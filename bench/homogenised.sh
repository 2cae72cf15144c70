#!/usr/bin/env bash
# The same impact on a chain-link net computed wire by wire and homogenised: the table of docs/openings.md, one JSON object a run. Each run
# is repeated; wall times are those of the fastest whole coupled run. The last two rows show what the sheet needs: triangles that do not
# run along the wires, and a mechanism that was left five per cent of coupling short.
#   ./talus bench homogenised
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { # name, scene, repetitions
  for repetition in $(seq "$3"); do
    "$TALUS_BUILD_DIR/bin/talus" run "$2" --out "$work/$1/$repetition" --quiet >&2
  done
  /usr/bin/python3 - "$1" "$work/$1" <<'PYTHON'
import csv, json, pathlib, sys
name, folder = sys.argv[1], pathlib.Path(sys.argv[2])
summaries = [json.load(open(path)) for path in sorted(folder.glob("*/summary.json"))]
rows = list(csv.DictReader(open(folder / "1/probes.csv")))
deepest = min(rows, key=lambda row: float(row["block.position_z_m"]))
peaks = summaries[0]["peaks"]
print(json.dumps({"run": name, "structure_nodes": summaries[0]["interface"]["structure_nodes"], "windows": round(summaries[0]["simulated_time_s"] / summaries[0]["window_s"]),
                  "panel_m": round(-peaks["middle.displacement_z_m"]["value"], 4), "block_m": round(0.26 - float(deepest["block.position_z_m"]), 4),
                  "stop_s": float(deepest["time_s"]), "rope_kN": round(peaks["south.axial_force_max_N"]["value"] / 1e3, 1),
                  "edge_m": round(peaks["edge.displacement_y_m"]["value"], 4), "wall_s": round(min(s["wall_time_s"] for s in summaries), 2)}))
PYTHON
}

for kind in detailed homogenised; do
  run "$kind" "$root/configs/examples/chain_link_$kind.yaml" 5
done
coarse() { # name, sheet
  printf 'extends: %s\nstructure: {parts: {net: {%s}}}\n' "$root/configs/examples/chain_link_homogenised.yaml" "$2" >"$work/$1.yaml"
  run "$1" "$work/$1.yaml" 1
}
coarse finer 'sheet: {crossed_cell: [194 mm, 336 mm]}'
coarse across_wires 'sheet: {crossed_cell: ~, element_size: 0.2 m}'
coarse stiff_mechanism 'membrane: {orthotropic: {youngs_modulus_x: 200.551 MPa, youngs_modulus_y: 1804.96 MPa, poissons_ratio_xy: 2.85}}'
