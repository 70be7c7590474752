#!/bin/sh
# comparison.sh FOLDER [OUT]: models of every kind on the materials of a folder: measured ones (*.bsdf) and
# reconstructions of MERL (*.binary). Writes docs/comparison.md and docs/images/models_*.png. Takes about three minutes
# a material on two idle cores (fourteen took 72 minutes on busy ones); goes on where it was interrupted if OUT is the same.
set -eu
folder=$(cd "$1" && pwd)
out=${2:-}
if [ -z "$out" ]; then
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
fi
cd "$(dirname "$0")/.."
cmake --build build --target sklar_command
set --
for file in "$folder"/*.bsdf "$folder"/*.binary; do
  if [ -e "$file" ]; then set -- "$@" "$file"; fi
done
begin=$(date +%s)
build/sklar brdf compare "$@" --provenance reconstruction --models all --out "$out" >/dev/null
seconds=$(($(date +%s) - begin))

# What stands behind this line is written by hand.
kept=$(sed -n '/^## What it says$/,/^## Every model$/p' docs/comparison.md 2>/dev/null | sed '$d')

# The parts of models.md: a row for each material and model; the means; what is not compared.
part() { awk -v part="$1" '/^\| (material|kind|not compared) \|/ { ++n } n == part' "$out/models.md"; }

# Of each material by one measure: the refined models, the best analytic and the best basis model at each budget.
best() {
  awk -F, -v column="$1" -v format="$2" -v sign="$3" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == column) at = i; next }
    $NF != "" || $4 == "table" { next }
    !($1 in seen) { seen[$1] = 1; material[++materials] = $1; provenance[$1] = $2 }
    {
      what = $4 == "refined" ? "refined " $5 : $4 == "paper" ? "paper" : $3 == "analytic" ? "analytic" : "basis " $5
      if (!(what in known)) { known[what] = 1; kind[++kinds] = what }
      if (!(($1, what) in least) || sign * $at < sign * least[$1, what]) { least[$1, what] = $at; name[$1, what] = $4 }
    }
    END {
      printf "| material |"; for (k = 1; k <= kinds; ++k) printf " %s |", kind[k]; print ""
      printf "| --- |"; for (k = 1; k <= kinds; ++k) printf " ---: |"; print ""
      for (m = 1; m <= materials; ++m) {
        printf "| %s (%s) |", material[m], provenance[material[m]]
        for (k = 1; k <= kinds; ++k) {
          which = kind[k]; plain = which ~ /^(refined|paper)/
          printf " " format "%s |", least[material[m], which], plain ? "" : ", " name[material[m], which]
        }
        print ""
      }
    }' "$out/models.csv"
}

shown="acrylic_felt_green cc_ibiza_sunset aurora_white green-metallic-paint"
for name in $shown; do cp "$out/models_$name.png" docs/images/; done
{
  cat <<'HEAD'
# Models of every kind

    build/sklar brdf compare MATERIAL... --models all --out out                       # this page's tables, and more
    build/sklar brdf compare MATERIAL... --models refined,ggx_two_lobes,nmf --budgets 1024,4096

Every model is fitted to the same tables and judged by the same code: the refined copula model (Frank, the largest
structure within each budget), the paper's (Frank), every analytic model (`brdf/analytic/`, one search with many starts on
a fixed subset of the cells) and every basis model (`brdf/basis/`, within each budget, in the space its source fits it in).
Errors are over all valid cells with both angles at most 80 degrees; docs/conventions.md defines the measures. This page,
but for what it says, is the output of

```
sh tests/comparison.sh FOLDER
```

on a folder with RGL's measured materials (`.bsdf`) and reconstructions of MERL (`.binary`).

HEAD
  printf '%s\n\n' "$kept"
  printf '## Error by material\n\nlog1p_mae; of the analytic and of the basis models at each budget the best.\n\n'
  best log1p_mae %.4f 1
  printf '\nPSNR of the sphere, linear, in dB.\n\n'
  best sphere_psnr_linear_db %.1f -1
  cat <<'PICTURES'

## Pictures

Columns: the refined model at 1, 4 and 16 KB, the best analytic model, the best basis model by log1p_mae. Rows: the
reference, the model, the difference times five.

PICTURES
  for name in $shown; do printf '![%s](images/models_%s.png)\n\n' "$name" "$name"; done
  cat <<'MEANS'
## Every model

Means over the materials; `rank` is the mean rank among all models over the eight measures of error, 1 is best. `ns` is an
RGB value in a batch, one thread; `efficiency` the mean of 1 / (1 + relative variance of a sample's weight) in a white
furnace, by the model's own sampler or, where its source has none, the cosine; `reciprocity` the mean difference when both
directions change places over the mean value; `albedo` the largest. Of models that can be negative (`Traits::non_negative`)
a value below 0 counts as 0 in the logarithmic errors.

MEANS
  part 2
  printf '\n'
  part 3
} >docs/comparison.md
echo "docs/comparison.md, after $seconds seconds"
