#!/usr/bin/env bash
# Looks for bytes that make a reader of meshes crash, go beyond its memory or take more than it should:
#   tests/fuzz/run.sh [SECONDS]      60 by default
# What it finds is build/fuzz/crash-*, oom-* or timeout-*; build/fuzz/read_meshes FILE shows it again.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/setup.sh"
seconds=${1:-60}
fuzz=$build/fuzz

require_packages "$build_packages" "$test_packages" "$check_packages"
build_release ON tinsmith_cli
cmake -S "$top" -B "$fuzz" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DTINSMITH_FUZZ=ON >/dev/null
cmake --build "$fuzz" --target read_meshes

# Small meshes of every format, written by the program itself.
seeds=$fuzz/seeds
mkdir -p "$seeds" "$fuzz/corpus"
cp "$top/tests/fuzz/half_torus.obj" "$seeds"
for extension in ply obj glb 2dm; do
  colour=(--color "$top/data/matterhorn.tif")
  [ $extension != 2dm ] || colour=()
  "$build/tinsmith" compress "$top/data/matterhorn.tif" "$seeds/terrain.$extension" --bbox 7.1 45.5 7.11 45.51 \
    --max-error 20 --quiet "${colour[@]}" >/dev/null
done
for extension in ply obj stl glb; do
  "$build/tinsmith" simplify "$seeds/half_torus.obj" "$seeds/surface.$extension" --ratio 0.6 --placement subset \
    --progressive "$seeds/surface.tspm" --quiet >/dev/null
done

# The memory is what a small GLB that shows its meshes again and again may take, 2^20 vertices of them, and what the
# sanitizers add.
cd "$fuzz"
ASAN_OPTIONS=quarantine_size_mb=16 ./read_meshes corpus seeds -dict="$top/tests/fuzz/words.dict" \
  -max_total_time="$seconds" -rss_limit_mb=512 -malloc_limit_mb=256 -timeout=10 -max_len=16384 -print_final_stats=1
