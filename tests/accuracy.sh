#!/bin/sh
# accuracy.sh [CELLS [SEED [OUTPUT]]]: random cells of every family, 100000 each by default, against the textbook psi in
# as many digits as it takes; writes docs/accuracy.md. Needs a built tree in build/; takes about 10 minutes a family.
set -eu
cd "$(dirname "$0")/.."
cells=${1:-100000}
seed=${2:-1}
output=${3:-docs/accuracy.md}
cmake --build build --target accuracy_sweep sklar_command
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

families=$(build/sklar families | sed 1d | cut -d ' ' -f 1)
echo "$families" | xargs -P "$(nproc)" -I {} sh -c \
  "build/tests/accuracy_sweep {} $cells $seed >'$scratch/{}' || { rm -f '$scratch/{}'; exit 255; }"

{
  cat <<HEAD
# Accuracy

Random questions to every family, answered in double and judged against the textbook psi of [families.md](families.md),
differentiated symbolically and evaluated in as many digits (100, 200, ... 6400, each with a second width half as large
again) as it takes for two widths to agree to 30 digits. theta is log-uniform over the domain up to 1e4, each
coordinate uniform, log-uniform from 1e-300 or from 1e-16 to either end, or next to another coordinate.

Bounds: log density and log cdf |v - e| <= 1e-13 max(1, |e|); h and 1 - h |ln v - ln e| <= 1e-13 max(1, |ln e| / 20), below
the normal range to one step of a double; inverses a relative error of 1e-12, or the best double there is. A share of 1 is
an error equal to the bound. Regions: "ordinary" has |tau| from 0.01 to 0.95 and all u at least 1e-6 from both ends, else it
says what is extreme. This page is the output of

\`\`\`
sh tests/accuracy.sh $cells $seed
\`\`\`

HEAD
  for family in $families; do cat "$scratch/$family"; done
} >"$scratch/page"
sed '$ d' "$scratch/page" >"$output"
echo "$output"
