#!/usr/bin/env bash
# Fuzzes the scene reader: tests/fuzz/run.sh [seconds, default 60]. Needs clang with its sanitizers (Debian package clang).
# Ends with an error where an input crashes it, runs longer than 10 s, leaks, or takes more than 1 GB.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
build=build/fuzz
mkdir -p "$build/corpus" "$build/seeds"

clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -I. -isystem /usr/include/eigen3 \
  tests/fuzz/scene_reader.cpp core/errors.cpp core/scene/{reader,schema,section_reader,sections,tree,values,yaml}.cpp core/units/units.cpp \
  -lyaml-cpp -ludunits2 -lfmt -o "$build/scene_reader"

find configs -name '*.yaml' -exec cp {} "$build/seeds/" \;
"$build/scene_reader" -dict=tests/fuzz/scene_reader.dict -max_total_time="$seconds" -max_len=65536 -timeout=10 -rss_limit_mb=1024 \
  -artifact_prefix="$build/" -print_final_stats=1 "$build/corpus" "$build/seeds"
