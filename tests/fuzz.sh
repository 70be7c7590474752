#!/bin/sh
# fuzz.sh [SECONDS [READER..]]: libFuzzer on every reader in turn, or on those named, with Clang's AddressSanitizer and
# UBSan in build-fuzz/: SECONDS each (600), or a million inputs where these are done before. It starts from
# tests/fuzz/corpus and what earlier runs added in build-fuzz/corpus. Ends with how many inputs each reader got; an input
# that breaks one is left in build-fuzz/found/, and the status is then 1.
set -eu
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages clang

seconds=${1:-600}
[ $# = 0 ] || shift
cmake --preset fuzz --log-level=WARNING
cmake --build --preset fuzz
mkdir -p build-fuzz/found
status=0
summary=
for target in ${*:-$(build-fuzz/tests/fuzz)}; do
  mkdir -p "build-fuzz/corpus/$target"
  log=build-fuzz/corpus/$target.log
  result=
  build-fuzz/tests/fuzz "$target" -max_total_time="$seconds" -runs=1000000 -max_len=8192 -timeout=25 -rss_limit_mb=2048 \
    -malloc_limit_mb=256 -print_final_stats=1 -artifact_prefix="build-fuzz/found/$target-" \
    "build-fuzz/corpus/$target" "tests/fuzz/corpus/$target" >"$log" 2>&1 || result="FAILED, see $log" status=1
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  summary="$summary$(printf '%-16s %12s  %s' "$target" "${inputs:-0}" "$result")
"
done
printf '%s' "$summary"
exit $status
