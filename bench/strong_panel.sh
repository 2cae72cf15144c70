#!/usr/bin/env bash
# The rock on the panel of net_sliding_edges.yaml, its contacts explicit: weak steps below the dashpot limit of the light nodes (4.19 us), and
# strong windows twenty times as long with an implicit structure. The table of docs/panel.md, one JSON object a run; the strong one takes minutes.
#   ./talus bench strong_panel
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { # name, sections of the scene besides those of the example
  printf 'extends: %s\noutput: {fields_every: ~}\n%s\n' "$root/configs/examples/net_sliding_edges.yaml" "$2" >"$work/$1.yaml"
  "$TALUS_BUILD_DIR/bin/talus" run "$work/$1.yaml" --out "$work/$1" --quiet >&2
  /usr/bin/python3 - "$1" "$work/$1" <<'PYTHON'
import json, sys
name, folder = sys.argv[1:]
summary = json.load(open(f"{folder}/summary.json"))
peak, windows = summary["peaks"]["middle.displacement_z_m"], round(summary["simulated_time_s"] / summary["window_s"])
iterations = summary.get("iterations", {})
print(json.dumps({"run": name, "deflection_m": peak["value"], "at_s": peak["time_s"], "rope_N": summary["peaks"]["south.axial_force_max_N"]["value"],
                  "windows": windows, "calls_of_each_solver": iterations.get("total", windows),
                  "windows_not_converged": iterations.get("windows_not_converged", 0),
                  "energy_error": summary["energy"]["largest_error_relative"], "wall_s": round(summary["wall_time_s"], 2)}))
PYTHON
}

end="end: 145 ms"
explicit_contact="particles: {implicit_contact: ~"
run weak_1_us "time: {step: 1 us, $end}
$explicit_contact}"
run weak_4_us "time: {step: 4 us, $end}
$explicit_contact}"
run strong_80_us "time: {step: 80 us, $end}
structure: {implicit: {}, step: 80 us}
$explicit_contact, step: 4 us}
coupling:
  serial_explicit: ~
  serial_implicit:
    aitken: {}
    relax: free_motion
    iterations: 30
    tolerance: {relative: 1e-3, force: 1 N, displacement: 1e-6 m, velocity: 1 mm/s}"
