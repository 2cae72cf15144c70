#!/usr/bin/env bash
# The three-span barrier configs/barriers/d1000.yaml from the touch to rest: what it computes and what it takes, one JSON object a run.
#   ./talus bench barrier [repetitions, 3]
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for repetition in $(seq "${1:-3}"); do
  "$TALUS_BUILD_DIR/bin/talus" run "$root/configs/barriers/d1000.yaml" --out "$work/$repetition" --quiet >&2
  /usr/bin/python3 - "$work/$repetition" <<'PYTHON'
import csv, json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
rows = list(csv.DictReader(open(folder / "probes.csv")))
deepest = min(rows, key=lambda row: float(row["middle.displacement_y_m"]))
last, energy = rows[-1], summary["energy"]
brakes = [name for name in ("brake_uw", "brake_ue", "brake_lw", "brake_le")]
dissipated = sum(float(last[f"{brake}.dissipated_J"]) for brake in brakes)
print(json.dumps({"wall_s": round(summary["wall_time_s"], 1), "elongation_m": round(-float(deepest["middle.displacement_y_m"]), 3),
                  "braking_time_s": float(deepest["time_s"]), "brake_travel_m": [round(float(last[f"{brake}.travel_max_m"]), 3) for brake in brakes],
                  "energy_in_brakes": round(dissipated / energy["impact_J"], 3), "energy_error": float(f"{energy['largest_error_relative']:.2g}")}))
PYTHON
done
