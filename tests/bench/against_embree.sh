#!/usr/bin/env bash
# Races quartet against the path tracer of Debian's embree-tools: the same box with the same point
# light, size, samples per pixel, threads, and depth (theirs counts a segment and the shadow ray at
# its end as one; for ours that ray is the last segment), runs in turn. Theirs ends a path when less
# than 1 % of it is left, ours by Russian roulette from the third segment on.
# Usage: tests/bench/against_embree.sh [PROGRAM] [RUNS]
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
program=${1:-$here/../../build/release/quartet}
runs=${2:-5}
spp=32 size=512 depth=8

command -v pathtracer >/dev/null || { echo "pathtracer is missing: install Debian's embree-tools" >&2; exit 1; }
models=$(dpkg -L embree-tools | grep -m 1 '/cornell_box\.ecs$')
models=${models%/*}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

seconds() {
  local start end
  start=$(date +%s.%N)
  "$@" >/dev/null 2>&1
  end=$(date +%s.%N)
  awk "BEGIN { print $end - $start }"
}

theirs=0 ours=0
for ((i = 0; i < runs; ++i)); do
  a=$(seconds pathtracer -c "$models/cornell_box.ecs" --max-path-length $depth --size $size $size \
    --spp $spp -o "$out/embree.ppm")
  b=$(seconds "$program" render "$here/embree-cornell.xml" --size ${size}x${size} --spp $spp \
    -o "$out/quartet.exr")
  printf 'embree %6.2f s   quartet %6.2f s   ratio %.2f\n' "$a" "$b" "$(awk "BEGIN { print $b / $a }")"
  theirs=$(awk "BEGIN { print $theirs + $a }") ours=$(awk "BEGIN { print $ours + $b }")
done
printf 'all runs: quartet takes %.2f of the time of embree\n' "$(awk "BEGIN { print $ours / $theirs }")"
