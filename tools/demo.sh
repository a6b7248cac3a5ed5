#!/usr/bin/env bash
# Compresses the sample terrain, judges the result and draws it: all that tinsmith does, on a machine with
# Debian 12 and git. The second run takes seconds and no network.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

require_packages "$build_packages"
# A build folder that test.sh made keeps its tests.
grep -qs '^TINSMITH_TESTS:BOOL=ON' "$build/CMakeCache.txt" && tests=ON || tests=OFF
build_release $tests tinsmith_cli

terrain=$top/data/matterhorn.tif
out=$build/demo
mkdir -p "$out"

say 'tinsmith compress data/matterhorn.tif matterhorn.ply --max-error 10'
"$build/tinsmith" compress "$terrain" "$out/matterhorn.ply" --max-error 10
say 'tinsmith verify data/matterhorn.tif matterhorn.ply --max-error 10'
"$build/tinsmith" verify "$terrain" "$out/matterhorn.ply" --max-error 10 | tee "$out/certificate.txt"
say 'tinsmith render data/matterhorn.tif matterhorn.ply matterhorn.png'
"$build/tinsmith" render "$terrain" "$out/matterhorn.ply" "$out/matterhorn.png"

cat <<END

The certificate holds. The files:
  mesh         $out/matterhorn.ply
  certificate  $out/certificate.txt
  picture      $out/matterhorn.png  (hillshade, wireframe, error)
END
