#!/usr/bin/env bash
# Particle-steps per second of a settling bed, one JSON object a line.
#   ./talus bench settling [--n N] [--steps N] [--settle N] [--threads N] [--peers | --scaling | --speedup]
# --peers runs LIGGGHTS and LAMMPS (Debian packages liggghts and lammps) on the same bed, material and step, one after the other, and
# prints how many times faster Talus is. Rates fall as contacts form, so only equal --n, --settle and --steps compare; on a busy machine
# read the ratios, and repeat.
# --scaling runs 10 000, 100 000 and 1 000 000 spheres for the same steps instead, three times in turn, and prints the least time of a
# particle-step over that of the first, and where it goes.
# --speedup runs 10 000 and 50 000 spheres with one thread and with --threads (2), five times in turn, and prints the ratio of the highest rates
# (what others on the machine take only ever lowers them) beside what the machine gives to arithmetic alone and to copying alone.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$TALUS_BUILD_DIR/bin/bench_settling
n=10000 steps=5000 settle=0 threads=1 peers=no scaling=no speedup=no
while [ $# -gt 0 ]; do
  case $1 in
    --n) n=$2; shift 2 ;;
    --steps) steps=$2; shift 2 ;;
    --settle) settle=$2; shift 2 ;;
    --threads) threads=$2; shift 2 ;;
    --peers) peers=yes; shift ;;
    --scaling) scaling=yes; shift ;;
    --speedup) speedup=yes; shift ;;
    *) echo "settling: unknown option $1" >&2; exit 2 ;;
  esac
done

# Threads that wait sleep after some tenths of a millisecond, so that another program on their core costs its share and no more.
export GOMP_SPINCOUNT=${GOMP_SPINCOUNT:-20000}

number_of() { sed -n "s/.*\"$2\":\([0-9.e+-]*\).*/\1/p" <<<"$1"; }

highest() { printf '%s\n' "$@" | sort -g | tail -n 1; }

if [ $scaling = yes ]; then
  declare -A rates
  for round in 1 2 3; do
    for n in 10000 100000 1000000; do
      line=$("$program" --n $n --steps "$steps" --settle "$settle" --threads "$threads")
      rates[$n]+=" $(number_of "$line" particle_steps_per_s)"
      [ $round = 3 ] && echo "$line"
    done
  done
  for n in 10000 100000 1000000; do
    awk -v n=$n -v first="$(highest ${rates[10000]})" -v rate="$(highest ${rates[$n]})" \
      'BEGIN { printf "{\"n\":%d,\"ns_of_a_particle_step\":%.1f,\"over_first\":%.3f}\n", n, 1e9 / rate, first / rate }'
  done
  for n in 10000 1000000; do
    "$program" --n $n --steps "$steps" --settle "$settle" --threads "$threads" --stages | head -n 1
  done
  exit 0
fi

rate_of() { number_of "$("$program" --n "$1" --steps "$steps" --settle "$settle" --threads "$2")" particle_steps_per_s; }

if [ $speedup = yes ]; then
  [ "$threads" -gt 1 ] || threads=2
  for n in 10000 50000; do
    one=() several=()
    for _ in 1 2 3 4 5; do
      one+=("$(rate_of $n 1)")
      several+=("$(rate_of $n "$threads")")
    done
    machine=$("$program" --machine --threads "$threads")
    awk -v n=$n -v threads="$threads" -v one="$(highest "${one[@]}")" -v several="$(highest "${several[@]}")" -v machine="${machine#*,}" \
      'BEGIN { printf "{\"n\":%d,\"threads\":%d,\"particle_steps_per_s\":%.0f,\"speedup\":%.2f,%s\n", n, threads, several, several / one, machine }'
  done
  exit 0
fi

own=$("$program" --n "$n" --steps "$steps" --settle "$settle" --threads "$threads")
echo "$own"
[ $peers = yes ] || exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
side=$("$program" --n "$n" --write-data "$work/bed.data")
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
parallel=()
[ "$threads" -gt 1 ] && parallel=(mpirun -np "$threads" --oversubscribe)

run_peer() { # name, program, deck
  command -v "$2" >/dev/null || { echo "settling: $2 is not installed" >&2; return; }
  (cd "$work" && "${parallel[@]}" "$2" -in "$here/settling/$3" -log "$work/$1.log" -var data "$work/bed.data" \
    -var side "$side" -var settle "$settle" -var steps "$steps" >"$work/$1.out" 2>&1) ||
    { tail -5 "$work/$1.out" >&2; return; }
  # The last "Loop time" is that of the timed steps; the last row of the log gives mean height and contacts.
  wall=$(sed -n 's/^Loop time of \([0-9.e+-]*\).*/\1/p' "$work/$1.log" | tail -1)
  row=$(grep -E "^ *$((settle + steps)) +$n " "$work/$1.log" | tail -1)
  line=$(awk -v peer="$1" -v n="$n" -v steps="$steps" -v settle="$settle" -v threads="$threads" -v wall="$wall" '{
    printf "{\"peer\":\"%s\",\"n\":%d,\"steps\":%d,\"settle\":%d,\"threads\":%d,\"wall_s\":%.3f,\"particle_steps_per_s\":%.0f,\"mean_z_m\":%.5f,\"kinetic_J\":%.5g,\"mean_contacts\":%.3f}",
           peer, n, steps, settle, threads, wall, n * steps / wall, $4, $3, $5 }' <<<"$row")
  echo "$line"
  awk -v peer="$1" -v a="$(number_of "$own" particle_steps_per_s)" -v b="$(number_of "$line" particle_steps_per_s)" \
    -v za="$(number_of "$own" mean_z_m)" -v zb="$(number_of "$line" mean_z_m)" \
    'BEGIN { printf "{\"ratio_to\":\"%s\",\"speed\":%.2f,\"mean_z\":%.4f}\n", peer, a / b, za / zb }'
}

run_peer liggghts liggghts liggghts.in
run_peer lammps lmp lammps.in
