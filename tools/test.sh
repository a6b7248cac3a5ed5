#!/usr/bin/env bash
# Builds tinsmith and runs its whole test suite, on a machine with Debian 12 and git. Arguments go to ctest,
# for example: tools/test.sh -R stitch
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

require_packages "$build_packages" "$test_packages"
build_release ON all
say 'testing'
ctest --test-dir "$build" --parallel 2 --output-on-failure "$@"
