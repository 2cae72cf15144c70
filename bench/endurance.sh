#!/usr/bin/env bash
# Many coupled runs of a tiny scene, many at a time: none may hang, and nothing may be left behind. Prints one JSON object; ends with 1 where
# a run failed or something is left.
#   ./talus bench endurance [RUNS] [AT_A_TIME]     (1000 and 50 where not given)
set -euo pipefail
runs=${1:-1000} together=${2:-50}
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
printf 'extends: %s\ntime: {end: 2 ms}\noutput: {every: 1 ms, fields_every: ~}\n' "$root/configs/examples/cable_net.yaml" >"$work/tiny.yaml"

processes() { pgrep -c -f "$work" || true; }
free_memory() { awk '/MemAvailable/ {print int($2 / 1024)}' /proc/meminfo; }
one_run() { # number: a line 'failed' where it ends badly or not within two minutes
  timeout 120 "$TALUS_BUILD_DIR/bin/talus" run "$work/tiny.yaml" --out "$work/$1" --quiet >"$work/$1.txt" 2>&1 || echo "failed $1"
  rm -rf "${work:?}/$1"
}
export -f one_run
export work TALUS_BUILD_DIR

memory=$(free_memory) begin=$SECONDS
failed=$(seq "$runs" | xargs -P "$together" -I{} bash -c 'one_run {}' | wc -l)
segments=0
for file in /dev/shm/talus-*; do # talus-<pid of the coupler>-...: those whose coupler is gone were forgotten
  [ -e "$file" ] || continue
  pid=${file#/dev/shm/talus-}
  [ -d "/proc/${pid%%-*}" ] || segments=$((segments + 1))
done
left=$(processes)
printf '{"runs":%d,"at_a_time":%d,"failed":%d,"segments_left":%d,"processes_left":%d,"memory_lost_mb":%d,"seconds":%d}\n' \
  "$runs" "$together" "$failed" "$segments" "$left" "$((memory - $(free_memory)))" "$((SECONDS - begin))"
[ "$failed" = 0 ] && [ "$segments" = 0 ] && [ "$left" = 0 ]
