#!/usr/bin/env bash
# What friction costs a rope that has none: instructions (valgrind's callgrind) of the same forces by a program that knows friction and by
# one that does not, and whether both sums have the same bits. One JSON object; exit code 1 above 1 % or at other bits.
set -euo pipefail
program=$TALUS_BUILD_DIR/bin/bench_frictionless_rope
command -v valgrind >/dev/null || { echo "frictionless_rope: valgrind is not installed" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for knowledge in with without; do
  valgrind --tool=callgrind --callgrind-out-file="$work/$knowledge.out" "$program" $knowledge >"$work/$knowledge.sum" 2>"$work/$knowledge.log"
  sed -n 's/.*Collected : \([0-9]*\).*/\1/p' "$work/$knowledge.log" >"$work/$knowledge.count"
done
same=$(cmp -s "$work/with.sum" "$work/without.sum" && echo true || echo false)
awk -v with="$(cat "$work/with.count")" -v without="$(cat "$work/without.count")" -v same="$same" 'BEGIN {
  ratio = with / without
  printf "{\"instructions_with\":%d,\"instructions_without\":%d,\"ratio\":%.5f,\"same_bits\":%s}\n", with, without, ratio, same
  exit !(ratio < 1.01 && same == "true") }'
