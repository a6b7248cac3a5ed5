#!/usr/bin/env bash
# compare.sh REV_A REV_B [PAIRS] [METRES...]: builds two commits in folders below the build folder and times them by
# turns on the sample terrain, with two threads and without verification. Prints for each tolerance the triangles, the
# median seconds and the median of B : A, pair by pair.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../setup.sh"
build=${TINSMITH_BENCH_BUILD:-$build/bench}
[ $# -ge 2 ] || die 'usage: compare.sh REV_A REV_B [PAIRS] [METRES...], for example: compare.sh HEAD~1 HEAD 7 5 20'
pairs=${3:-7}
tolerances=("${@:4}")
[ ${#tolerances[@]} -gt 0 ] || tolerances=(2 5 10 20 50)
require_packages "$build_packages python3"

commit_of() {
  git -C "$top" rev-parse --verify --quiet "$1^{commit}" || die "$1: no such commit"
}

# Prints the folder of the build of a commit, which also has a name; what was built before is kept.
build_commit() {
  local commit=$1 folder
  folder=$build/compare/${commit:0:12}
  if ! [ -d "$folder/tree" ]; then
    # No worktree: git would go on knowing it when the folder is long gone.
    rm -rf "$folder/tree.new"
    mkdir -p "$folder/tree.new"
    git -C "$top" archive "$commit" | tar -x -C "$folder/tree.new"
    mv "$folder/tree.new" "$folder/tree"
  fi
  say "building $2 (${commit:0:12})"
  cmake -S "$folder/tree" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTINSMITH_TESTS=OFF >"$folder/log" 2>&1 &&
    cmake --build "$folder/build" --target tinsmith_cli >>"$folder/log" 2>&1 || die "the build of $2 failed: see $folder/log"
  printf '%s\n' "$folder/build"
}

# Both before the first build: HEAD may move meanwhile.
commit_a=$(commit_of "$1")
commit_b=$(commit_of "$2")
a=$(build_commit "$commit_a" "$1")
b=$(build_commit "$commit_b" "$2")
exec python3 -B "$top/tools/bench/compare.py" "$a/tinsmith" "$b/tinsmith" "$top/data/matterhorn.tif" "$pairs" \
  "${tolerances[@]}"
