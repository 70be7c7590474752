#!/bin/sh
# bench.sh [OUTPUT]: nanoseconds a row on one thread, closed forms beside formulas; writes docs/speed.md. Takes about five
# minutes on an idle machine.
set -eu
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages libbenchmark-dev
output=${1:-docs/speed.md}
cmake --preset release --log-level=WARNING
cmake --build build --target copula_bench
table=$(mktemp)
trap 'rm -f "$table"' EXIT
build/tests/copula_bench --benchmark_format=csv --benchmark_min_time=0.1 >"$table"

{
  cat <<'HEAD'
# Speed

Nanoseconds a row on one thread, tau = 1/2 (Ali-Mikhail-Haq: theta = 0.9), points drawn from the copula, in full
accuracy. "formula" is the same copula from nothing but the text of psi, as a [family of your own](families.md) would
be: symbolic derivatives on a tape, and no closed form of a density, a conditional or its inverse. The ratio is the price
of generality. This page is the output of

```
sh tests/bench.sh
```

HEAD
  echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)."
  awk -F, '
    { gsub(/"/, "") }
    $1 == "baseline/exp_log" { unit = $4 / 4096; printf "One scalar exp and log of the C library: %.1f ns.\n\n", unit
      print "| quantity | family | d | closed form | in exp+log | formula | formula / closed |"
      print "| --- | --- | --- | --- | --- | --- | --- |" }
    $1 ~ /\/n=/ {
      name = $1; rows = name; sub(/.*n=/, "", rows); sub(/\/n=.*/, "", name)
      formula = sub(/^formula\//, "", name)
      ns = $4 / rows
      if (formula) by_formula[name] = ns
      else { closed[name] = ns; order[++count] = name }
    }
    END {
      for (i = 1; i <= count; ++i) {
        name = order[i]; split(name, part, "/"); sub(/d=/, "", part[3])
        printf "| %s | %s | %s | %.0f | %.1f |", part[1], part[2], part[3], closed[name], closed[name] / unit
        if (name in by_formula) printf " %.0f | %.1f |\n", by_formula[name], by_formula[name] / closed[name]
        else print " | |"
      }
    }' "$table"
  cat <<'HEAD'

## Derivatives of psi

Parsing psi, differentiating it so many times and compiling the last derivative to a tape: microseconds, nodes of the
expression with shared parts counted once, instructions of the tape.

| family | order | microseconds | nodes | instructions |
| --- | --- | --- | --- | --- |
HEAD
  awk -F, '
    { gsub(/"/, "") }
    $1 ~ /^derive/ {
      split($1, part, "/"); sub(/order=/, "", part[3]); split($8, size, " ")
      printf "| %s | %s | %.0f | %s | %s |\n", part[2], part[3], $4 / 1000, size[1], size[2]
    }' "$table"
} >"$output"
echo "$output"
