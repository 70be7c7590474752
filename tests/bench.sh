#!/bin/sh
# bench.sh [OUTPUT]: nanoseconds a row on one thread of the library, of textbook formulas and of formula families; writes
# docs/speed.md. Takes about six minutes on an idle machine.
set -eu
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages libbenchmark-dev
output=${1:-docs/speed.md}
cmake --preset release --log-level=WARNING
cmake --build build --target copula_bench
table=$(mktemp)
trap 'rm -f "$table"' EXIT
pin=
if command -v taskset >/dev/null; then pin="taskset -c $(($(nproc) - 1))"; fi
$pin build/tests/copula_bench --benchmark_format=csv --benchmark_min_time=0.02 --benchmark_repetitions=10 \
  --benchmark_report_aggregates_only=true >"$table"

# page PROGRAM: the awk program at the end of the table, with time[name] in nanoseconds of processor time, the median,
# label[name], names in order as name[1..count], and unit, the time of one exp and log.
page() {
  awk -F, '
    { gsub(/"/, "") }
    sub(/_median$/, "", $1) { name[++count] = $1; time[$1] = $4; label[$1] = $8 }
    # The part of a name: 1 quantity, 2 family; d and n as numbers.
    function part(text, which, parts) { split(text, parts, "/"); return parts[which] }
    function number(text, key) { return match(text, key "=[0-9]+") ? substr(text, RSTART + 2, RLENGTH - 2) : 0 }
    function row(text) { return time[text] / number(text, "n") }
    END { unit = time["baseline/exp_log"] / 65536; n = split("frank clayton gumbel joe amh", families, " ");'"$1"'}' "$table"
}

{
  cat <<'HEAD'
# Speed

Nanoseconds a row on one thread, tau = 1/2 (Ali-Mikhail-Haq: 1/4), points drawn from the copula, at full accuracy: the
median of ten repetitions. This page is the output of

```
sh tests/bench.sh
```

HEAD
  echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)."
  page 'printf "One scalar exp and one log of the C library: %.1f ns.\n", unit'
  cat <<'HEAD'

## Beside a textbook

d = 2, n = 65536. "fast" is single precision (`Accuracy::fast`, error below 1e-5). "textbook" is the formula of the
textbook in scalar code with the C library, without care of cancellation, and for the inverses of Gumbel and Joe Newton's
method in a bracket (`tests/bench/textbook.hpp`). Sampling includes the generator of uniforms.

| quantity | family | ns | in exp+log | fast ns | textbook ns | textbook / sklar |
| --- | --- | ---: | ---: | ---: | ---: | ---: |
HEAD
  page 'for (i = 1; i <= count; ++i) if (sub(/^textbook\//, "", name[i])) {
      ours = row(name[i]); theirs = row("textbook/" name[i])
      fast = ("fast/" name[i]) in time ? sprintf("%.1f", row("fast/" name[i])) : ""
      printf "| %s | %s | %.1f | %.2f | %s | ", part(name[i], 1), part(name[i], 2), ours, ours / unit, fast
      printf "%.1f | %.1f |\n", theirs, theirs / ours
    }'
  cat <<'HEAD'

## Fit

Maximum likelihood with standard errors, d = 2, n = 100000, milliseconds on one thread.

| family | ms |
| --- | ---: |
HEAD
  page 'for (i = 1; i <= count; ++i) if (name[i] ~ /^fit/) printf "| %s | %.0f |\n", part(name[i], 2), time[name[i]] / 1e6'
  cat <<'HEAD'

## Growth

The log density: nanoseconds a row and coordinate, by dimension at n = 4096 and by rows at d = 2. A cost linear in both
is a constant here; where it is not, the vector kernel left rows whose error estimate was above the tolerance to the
exact route, which takes tens of times as long or more.

| family | d = 2 | 5 | 10 | 20 | 50 | 100 | n = 10^3 | 10^4 | 10^5 | 10^6 |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
HEAD
  page 'for (f = 1; f <= n; ++f) {
      printf "| %s |", families[f]
      split("2 5 10 20 50 100", dims, " ")
      for (i = 1; i <= 6; ++i) printf " %.2f |", row("log_pdf/" families[f] "/d=" dims[i] "/n=4096") / dims[i]
      split("1000 10000 100000 1000000", rows, " ")
      for (i = 1; i <= 4; ++i) printf " %.2f |", row("log_pdf/" families[f] "/d=2/n=" rows[i]) / 2
      print ""
    }'
  cat <<'HEAD'

## All quantities, and formulas

"formula" is the same copula from nothing but the text of psi, as a [family of your own](families.md) would be: symbolic
derivatives on a tape, and no closed form of a density, a conditional or its inverse. The ratio is the price of
generality.

| quantity | family | d | ns | in exp+log | formula ns | formula / sklar |
| --- | --- | ---: | ---: | ---: | ---: | ---: |
HEAD
  page 'for (i = 1; i <= count; ++i) {
      d = number(name[i], "d") + 0
      if (name[i] !~ /^(log_pdf|h|h_inv|sample)\// || !(name[i] ~ (d < 10 ? "/n=65536$" : "/n=1024$"))) continue
      if (d != 2 && d != 3 && d != 10 && d != 100) continue
      printf "| %s | %s | %d | %.1f | %.1f |", part(name[i], 1), part(name[i], 2), d, row(name[i]), row(name[i]) / unit
      formula = "formula/" part(name[i], 1) "/" part(name[i], 2) "/d=" d "/n=1024"
      if (formula in time) printf " %.0f | %.0f |\n", row(formula), row(formula) / row(name[i])
      else print " | |"
    }'
  cat <<'HEAD'

## Derivatives of psi

Parsing psi, differentiating it so many times and compiling the last derivative to a tape: microseconds, nodes of the
expression with shared parts counted once, instructions of the tape.

| family | order | microseconds | nodes | instructions |
| --- | ---: | ---: | ---: | ---: |
HEAD
  page 'for (i = 1; i <= count; ++i) if (name[i] ~ /^derive/) {
      split(label[name[i]], size, " ")
      order = name[i]; sub(/.*order=/, "", order)
      printf "| %s | %s | %.0f | %s | %s |\n", part(name[i], 2), order, time[name[i]] / 1000, size[1], size[2]
    }'
} >"$output"
echo "$output"
