#!/usr/bin/env bash
# Measures tinsmith beside its peers: installs them, builds what is needed, runs all on the same rasters, has every
# result judged by `tinsmith verify` and writes RESULTS.md and RESULTS.json. Started again, it goes on where it
# stopped. Options: tools/bench/run.sh --help.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../setup.sh"
bench=$top/tools/bench
build=${TINSMITH_BENCH_BUILD:-$build/bench}

bench_packages='
  python3                 # runs the runs
  python3-numpy           # hands samples to VTK
  python3-vtk9            # peer: greedy terrain decimation, quadric decimation
'
# Not among them when they are there already: node may come from elsewhere than Debian.
command -v node >/dev/null && command -v npm >/dev/null || bench_packages+=' nodejs npm '
require_packages "$build_packages $bench_build_packages $bench_packages"

say "building into ${build#"$PWD"/}"
mkdir -p "$build/node"
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTINSMITH_TESTS=OFF -DTINSMITH_BENCH=ON \
  >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; die "cmake could not configure $build: see above"; }
cmake --build "$build" --target tinsmith_cli make_terrain dump cgal_peer meshopt_peer micro_bench >&2 ||
  die 'the build failed: see above'

cp "$bench"/peers/*.mjs "$bench/peers/package.json" "$build/node/"
if ! [ -d "$build/node/node_modules/delatin" ] || ! [ -d "$build/node/node_modules/@mapbox/martini" ]; then
  say 'installing delatin and martini from npm (once)'
  (cd "$build/node" && npm install --no-audit --no-fund >npm.log 2>&1) ||
    die "npm could not install the peers: see $build/node/npm.log"
fi

exec python3 -B "$bench/bench.py" --build "$build" "$@"
