#!/usr/bin/env bash
# Fuzzes what reads bytes of others: tests/fuzz/run.sh scene_reader|messages [seconds, default 60]. Needs clang with its sanitizers (Debian
# packages clang, libclang-rt-14-dev). Ends with an error where an input crashes it, runs longer than 10 s, leaks, or takes more than 1 GB.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=${1:?"scene_reader or messages"} seconds=${2:-60}
build=build/fuzz/$target
mkdir -p "$build/corpus" "$build/seeds"

case "$target" in
  scene_reader)
    sources="core/errors.cpp core/program/log.cpp core/output/file.cpp core/utf8.cpp core/input_file.cpp core/scene/*.cpp core/units/units.cpp"
    libraries="-lyaml-cpp -ludunits2 -lfmt -lspdlog"
    options="-dict=tests/fuzz/scene_reader.dict"
    find configs -name '*.yaml' -exec cp {} "$build/seeds/" \; ;;
  messages)
    sources="coupler/messages/messages.cpp coupler/messages/validate.cpp core/errors.cpp core/utf8.cpp core/steps.cpp core/units/units.cpp"
    libraries="-lfmt -ludunits2"
    options=""
    python3 tests/fuzz/message_seeds.py "$build/seeds" ;;
  *) echo "run.sh: scene_reader or messages, not '$target'" >&2; exit 2 ;;
esac

clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DSPDLOG_FMT_EXTERNAL -I. -isystem /usr/include/eigen3 \
  "tests/fuzz/$target.cpp" $sources $libraries -o "$build/fuzz"
"$build/fuzz" $options -max_total_time="$seconds" -max_len=65536 -timeout=10 -rss_limit_mb=1024 \
  -artifact_prefix="$build/" -print_final_stats=1 "$build/corpus" "$build/seeds"
