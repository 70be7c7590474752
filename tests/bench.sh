#!/bin/sh
# bench.sh [OUTPUT]: nanoseconds a row on one thread of the library, of textbook formulas and of formula families; writes
# docs/speed.md. Takes about eight minutes on an idle machine.
set -eu
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages libbenchmark-dev llvm-14 binutils
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

d = 2, n = 65536. "textbook" is the formula of the textbook in scalar code with the C library, without care of
cancellation, and for the inverses of Gumbel and Joe Newton's method in a bracket (`tests/bench/textbook.hpp`). Sampling
includes the generator of uniforms.

| quantity | family | ns | in exp+log | textbook ns | textbook / sklar |
| --- | --- | ---: | ---: | ---: | ---: |
HEAD
  page 'for (i = 1; i <= count; ++i) if (sub(/^textbook\//, "", name[i])) {
      ours = row(name[i]); theirs = row("textbook/" name[i])
      printf "| %s | %s | %.1f | %.2f | ", part(name[i], 1), part(name[i], 2), ours, ours / unit
      printf "%.1f | %.1f |\n", theirs, theirs / ours
    }'
  cat <<'HEAD'

## Single precision

d = 2, n = 65536: `Accuracy::fast`, whose error is at most 1e-5. The values of independence are copies: what
memory takes.

| quantity | family | standard ns | fast ns | standard / fast |
| --- | --- | ---: | ---: | ---: |
HEAD
  page 'for (i = 1; i <= count; ++i) if (sub(/^fast\//, "", name[i])) {
      standard = row(name[i]); fast = row("fast/" name[i])
      printf "| %s | %s | %.2f | %.2f | %.2f |\n", part(name[i], 1), part(name[i], 2), standard, fast, standard / fast
    }
    else if (name[i] ~ /^(log_pdf|h|h_inv)\/independence\/d=2\/n=65536$/) {
      printf "| %s | %s | %.2f | | |\n", part(name[i], 1), part(name[i], 2), row(name[i])
    }'
  cat <<'HEAD'

## Fit

Maximum likelihood with standard errors, d = 2, on one thread. The rows are read in chunks: the last column is what the
fit of 10^7 of them, 153 MiB, adds to the peak of memory.

| family | n = 10^5, ms | n = 10^7, s | MiB |
| --- | ---: | ---: | ---: |
HEAD
  page 'for (i = 1; i <= count; ++i) if (name[i] ~ /^fit/) {
      large = "large_" name[i]; sub(/100000$/, "10000000", large)
      sub(/$/, "/iterations:1/repeats:3", large)
      printf "| %s | %.1f | %.2f | %d |\n", part(name[i], 2), time[name[i]] / 1e6, time[large] / 1e9, label[large]
    }'
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

## Limits

What the kernels of d = 2 execute a row with AVX-512, from `sh tests/counts.sh`: instructions counted one by one as the
processor takes them, of them arithmetic on vectors, divisions and square roots (eight rows each, sixteen in single
precision), loads and stores (the constants of the formulas, registers spilt, 2 and 1 vectors of data); and of the loop
over rows, in llvm-mca's model of an Ice Lake server, the cycles and its busiest unit. Ports 0 and 5 do all arithmetic on
vectors of 64 bytes: where one of them is the busiest, the number of vector instructions is the limit, not loads (ports 2
and 3) nor memory. The inverses of Joe, by a division a step of Newton's method, and of Ali-Mikhail-Haq, by a root, wait
for the divider. Memory is the limit of the shortest alone, h of Ali-Mikhail-Haq: at 24 bytes a row the caches deliver a
row in 0.4 to 0.9 ns, as the copies of the copula of independence show above.

| quantity | family | accuracy | instructions | arithmetic | divisions | loads | stores | cycles | busiest unit |
| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |
HEAD
  sh tests/counts.sh
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
