#!/bin/sh
# counts.sh [QUANTITY]: what the vector kernels of d = 2 execute a row: instructions counted by single steps, and the
# cycles and the busiest unit of their loop by llvm-mca's model of a processor (Debian packages llvm-14, binutils).
# Prints rows of the table in docs/speed.md. Needs AVX-512.
set -eu
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages llvm-14 binutils
quantities=${1:-log_pdf h h_inv}
cmake --preset release --log-level=WARNING >&2
cmake --build build --target kernel_trace >/dev/null
program=build/tests/kernel_trace
rows=1024
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
objdump -d --no-show-raw-insn "$program" | sed -n 's/^ *\([0-9a-f]*\):\t/\1\t/p' | sed 's/ *#.*//; s/ *<.*//' >"$work/code"

# The text of the instructions in the order of execution.
executed() {
  "$program" "$1" "$2" "$3" $rows >"$work/trace"
  awk -F '\t' 'NR == FNR { text[$1] = $2; next } { print $1 "\t" ($1 in text ? text[$1] : "outside") }' \
    "$work/code" "$work/trace" >"$work/executed"
}

# One turn of the loop over packs of rows: from the first instruction executed as often as there are packs to the next
# time. Jumps left out, as is what llvm-mca does not know.
loop() {
  awk -F '\t' 'NR == FNR { ++count[$1]; next }
    head == "" && count[$1] >= 8 && count[$1] <= 64 && $1 != "-" { head = $1; print count[$1] }
    $1 == head { ++turn }
    turn == 4 && $2 !~ /^(j|call|ret|outside)/ { print $2 }' "$work/executed" "$work/executed" >"$work/loop"
  turns=$(head -n 1 "$work/loop")
  sed 1d "$work/loop" >"$work/loop.s"
}

for quantity in $quantities; do
  for family in frank clayton gumbel joe amh; do
    for level in standard fast; do
      executed $family "$quantity" $level
      loop
      llvm-mca-14 -mcpu=icelake-server -iterations=20 -all-stats=false -summary-view -resource-pressure \
        "$work/loop.s" >"$work/mca" 2>/dev/null
      awk -F '\t' -v name="$quantity | $family | $level" -v rows=$rows -v turns="$turns" '
        FILENAME ~ /executed$/ {
          ++all
          if ($2 ~ /^v/ && $2 !~ /^vmov/) ++arithmetic
          if ($2 ~ /^v(div|sqrt)/) ++divisions
          if ($2 ~ /\(/ && $2 !~ /^(lea|nop)/) { if ($2 ~ /\)[^,]*$/ && $2 ~ /mov/) ++stores; else ++loads }
          next
        }
        /^Total Cycles:/ { gsub(/[^0-9]/, ""); cycles = $0 / 20 * turns / rows }
        /^\[[0-9.]+\] +- / { split($0, part, " - "); unit[++units] = part[2] }
        /^Resource pressure per iteration:/ { getline; getline
          n = split($0, pressure, " ")
          for (i = 1; i <= n; ++i) if (pressure[i] + 0 > most) { most = pressure[i] + 0; busiest = unit[i] }
        }
        END {
          printf "| %s | %.1f | %.1f | %.2f | %.1f | %.1f | ", name, all / rows, arithmetic / rows, divisions / rows,
            loads / rows, stores / rows
          printf "%.1f | %s %.1f |\n", cycles, busiest, most * turns / rows
        }' "$work/executed" "$work/mca"
    done
  done
done
