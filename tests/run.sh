#!/bin/sh
# run.sh [PRESET]: installs what is missing, builds the preset (release, in build/), runs every test and checks that
# every test case in the sources did run. A second run is incremental.
# SKLAR_TEST_DATA=FOLDER (with conformance/ and materials/) adds the tests on reference and measured data.
set -eu
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages

preset=${1:-release}
case $preset in release) build=build ;; *) build=build-$preset ;; esac
# Fewer random draws where each costs ten times as much.
case $preset in asan | tsan) export SKLAR_DRAWS="${SKLAR_DRAWS:-10000}" ;; esac
if [ -n "${SKLAR_TEST_DATA:-}" ]; then
  SKLAR_TEST_DATA=$(cd "$SKLAR_TEST_DATA" && pwd)
  export SKLAR_TEST_DATA
fi

[ "$preset" != tsan ] || sh tests/support/threads_tbb.sh "$PWD/$build/tbb"
cmake --preset "$preset" --log-level=WARNING
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error --output-log "$build/tests.log"
sh tests/support/check_complete.sh "$build/tests.log"
