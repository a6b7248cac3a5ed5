#!/usr/bin/env bash
# Measures tinsmith simplify beside CGAL, VTK and meshoptimizer on real meshes: installs them, builds what is needed,
# fetches the meshes from Debian packages (unpacked below the build folder, not installed) and writes a Markdown table.
# Options: tools/bench/surface/run.sh --help.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../setup.sh"
build=${TINSMITH_BENCH_BUILD:-$build/bench}

surface_packages='
  python3                 # runs the runs
  python3-numpy           # samples surfaces
  python3-scipy           # counts their parts and borders
  python3-vtk9            # peer: quadric decimation, DecimatePro; the judge of distances
'
require_packages "$build_packages $bench_build_packages $surface_packages"

say "building into ${build#"$PWD"/}"
mkdir -p "$build/surface/packages"
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTINSMITH_TESTS=OFF -DTINSMITH_BENCH=ON \
  >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; die "cmake could not configure $build: see above"; }
cmake --build "$build" --target tinsmith_cli cgal_surface meshopt_surface >&2 || die 'the build failed: see above'

# fetch PACKAGE: unpacks a Debian package below the build folder, once.
fetch() {
  local folder=$build/surface/packages/$1
  [ -d "$folder" ] && return 0
  say "fetching $1 (once)"
  rm -rf "$folder.new"
  mkdir -p "$folder.new"
  (cd "$folder.new" && apt-get download "$1" >apt.log 2>&1 && dpkg-deb -x ./*.deb . && rm ./*.deb) ||
    die "$1 could not be fetched: see $folder.new/apt.log, or run apt-get update"
  mv "$folder.new" "$folder"
}
fetch libcgal-demo  # data/meshes: the Stanford bunny, an elephant
fetch mricron-data  # MRI of a head, whose iso-surfaces are taken

exec /usr/bin/python3 -B "$top/tools/bench/surface/surfaces.py" --build "$build" "$@"
