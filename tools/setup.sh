#!/usr/bin/env bash
# What demo.sh and test.sh share: the Debian packages that each purpose needs, and the build. Sourced, not run.

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$top/build

# "package  # why", one a line; bare Debian 12 is the reference.
build_packages='
  g++                     # the compiler, C++20
  cmake                   # writes the build
  ninja-build             # runs it
  pkgconf                 # finds cairo
  libtbb-dev              # windows in parallel
  libcgal-dev             # constrained Delaunay triangulation
  libgdal-dev             # reads and writes rasters; PROJ comes with it
  libgeographiclib-dev    # metres per degree
  libcairo2-dev           # draws pictures
  fonts-dejavu-core       # the letters in them
  libfmt-dev              # text of messages
  nlohmann-json3-dev      # reports, GLB headers
  libcli11-dev            # command line
  libxxhash-dev           # checksums of unfinished work
'
test_packages='
  libgtest-dev            # the tests
  python3                 # the layer check
'
check_packages='
  clang                   # the second compiler
  clang-format            # the form
  clang-tidy              # the static checks
  libclang-rt-14-dev      # sanitizers and libFuzzer of the second compiler
'

bench_build_packages='
  libmeshoptimizer-dev    # peer: meshopt_simplify
  libeigen3-dev           # matrices of the peer CGAL
  libbenchmark-dev        # micro benchmarks
'

say() { printf '== %s\n' "$*" >&2; }
die() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

package_names() { sed 's/#.*//' <<<"$*" | xargs; }

# Those of the named packages that are not installed.
missing_packages() {
  local name
  for name in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || printf '%s ' "$name"
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

# require_packages LIST...: installs what is missing; touches neither apt nor the network when nothing is.
require_packages() {
  command -v dpkg-query >/dev/null || die "this is not Debian: install by hand what tools/setup.sh lists, then use cmake"
  local missing log reason
  missing=$(missing_packages $(package_names "$*"))
  [ -n "$missing" ] || return 0
  [ "$(id -u)" = 0 ] || command -v sudo >/dev/null ||
    die "missing packages, and neither root nor sudo to install them: $missing"
  say "installing $missing(and what they need; once)"
  log=$(mktemp)
  # A first apt-get install may fail on stale lists only, so the lists are always fetched first.
  if ! { as_root apt-get update && as_root apt-get install -y --no-install-recommends $missing; } >"$log" 2>&1; then
    reason=$(grep -m 1 -E '^(E|Err):' "$log" || tail -n 1 "$log")
    die "apt could not install $missing($reason; all of it in $log): check the network and /etc/apt, then run again"
  fi
  rm -f "$log"
}

# build_release TESTS TARGETS...: configures build/ as Release and builds the targets. TESTS is ON or OFF.
build_release() {
  local tests=$1
  shift
  say "building into ${build#"$PWD"/}"
  mkdir -p "$build"
  cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTINSMITH_TESTS="$tests" >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log" >&2; die "cmake could not configure $build: see above"; }
  cmake --build "$build" --target "$@" >&2 || die "the build of $* failed: see above"
}
