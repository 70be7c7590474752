#!/bin/sh
# sampling.sh FOLDER: how well samplers follow the measured materials (*.bsdf) of a folder. Writes docs/sampling.md; takes
# about ten seconds a material.
set -eu
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages libbenchmark-dev
cmake --preset release --log-level=WARNING
cmake --build build --target sklar_command brdf_bench
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
build/sklar brdf compare "$folder"/*.bsdf --mode paper --families independence --out "$scratch" >/dev/null

# The rows of efficiency.csv as a table, a line for each material and sampler, and the largest value of each sampler.
table() {
  awk -F, '
    NR == 1 { printf "| material | sampler |"; for (i = 3; i <= NF; ++i) { sub("theta_", "", $i); printf " %s |", $i } print "";
              printf "| --- | --- |"; for (i = 3; i <= NF; ++i) printf " ---: |"; print ""; next }
    { if (!($2 in seen)) { seen[$2] = 1; sampler[++samplers] = $2 }
      printf "| %s | %s |", $1, $2
      for (i = 3; i <= NF; ++i) { printf " %.3f |", $i; if ($i > most[$2, i]) most[$2, i] = $i }
      print ""; columns = NF }
    END { for (k = 1; k <= samplers; ++k) {
            printf "| largest | %s |", sampler[k]; for (i = 3; i <= columns; ++i) printf " %.3f |", most[sampler[k], i]; print "" } }' \
    "$scratch/efficiency.csv"
}

# Medians of ten repetitions on the last processor: a row for each quantity.
call_times() {
  pin=
  if command -v taskset >/dev/null; then pin="taskset -c $(($(nproc) - 1))"; fi
  $pin build/tests/brdf_bench "$1" --benchmark_format=csv --benchmark_min_time=0.02 --benchmark_repetitions=10 \
    --benchmark_report_aggregates_only=true 2>/dev/null | awk -F, '
    { gsub(/"/, "") }
    sub(/_median$/, "", $1) { split($1, part, "/"); if (part[2] == "one") name[++count] = part[1]; time[$1] = $4 / 4096 }
    END { for (i = 1; i <= count; ++i) {
            quantity = name[i]; gsub("_", " ", quantity); sub("sample pdf and", "sample, pdf and", quantity)
            batch = name[i] "/batch"
            printf "| %s | %.0f | %.0f | %s |\n", quantity, time[name[i] "/one"], time[name[i] "/waiting"],
              batch in time ? sprintf("%.0f", time[batch]) : "" } }'
}

# What stands behind the tables is written by hand.
kept=$(sed -n '/^## How fast pictures converge$/,$p' docs/sampling.md)
{
  cat <<'HEAD'
# Sampling

    build/sklar brdf sample MATERIAL --wo 60,0 -n 1000           # wi, pdf, weight f_r cos / pdf
    build/sklar brdf albedo MATERIAL --furnace 10000             # the albedo by quadrature, and by that sampler
    build/sklar brdf compare MATERIAL... --out out               # the table below among others, and out/efficiency.csv

`SampledBrdf` (`brdf/sampling/sampled_brdf.hpp`) gives any reflectance, a model, a measured table or a formula, a sampler
made for it: given theta_o a mixture of six densities, each the product of two margins, so that the mixture is what couples
them (`brdf/sampling/conditional_sampler.hpp`). Two are of wi, four of the half vector, in a disk whose rim is the horizon
whatever theta_o (`brdf/geometry/half_disk.hpp`): no draw is lost below it, and the density integrates to 1. The sampler
needs 16 KB and, on two cores, 0.2 seconds to make. Its density is continuous, and nowhere below 0.002 cos(theta_i) / pi.
Two uniforms make a draw; a lattice or a low-discrepancy sequence serves as well as random ones. Luminance is followed:
where the channels differ in shape, so do their weights. An anisotropic reflectance is followed as far as its mean over
phi_o goes, with an exact density all the same.

The paper's own sampler (`brdf/sampling/paper_sampler.hpp`) is one copula over wo and wi, conditional on wo; its Eqs. 26 and
27, which it solves by numerical techniques, have closed forms for Frank's copula: a quadratic and, in four coordinates, a
cubic (`copula/polylogarithm_root.hpp`). As printed it follows f_r alone, so that cos(theta_i) sin(theta_i) stays in the
weight.

This page, but for its last section, is the output of

```
sh tests/sampling.sh FOLDER
```

on a folder with RGL's measured materials (`.bsdf`).

## Relative standard deviation of one sample

In a white furnace, of the luminance of f_r cos(theta_i) / pdf, by theta_o in degrees; by quadrature, so that rare large
weights count in full. At 0.25 a sample is worth 94 % of one of a perfect sampler.

- `conditional`: the sampler above.
- `cosine`: the cosine hemisphere.
- `ggx`: visible normals of GGX mixed with the cosine; roughness and share are those of the least variance here.
- `paper`: Eq. 22 with the density of Eq. 23, Frank's copula of (theta_o, theta_i, phi_i - phi_o).
- `paper-cosine`: the same, corrected: cos(theta_i) sin(theta_i) in what the copula is fitted to.
- `paper-eq24`: Eq. 24, the weights K h cos(theta_i) sin(theta_i) of the draws of `paper`. Their mean is the albedo of the
  copula, which is not that of the material.

HEAD
  table
  cat <<'TIMES'

## How long a sample takes

Nanoseconds on one thread (`tests/bench/brdf_bench.cpp`), of the 4 KB refined model of chm_mint and its sampler, random wo;
the value is RGB. In the first column one call at a time, in the second each waits for what the last one gave, in the third
many in one call (`sample` of rows of wo and of uniforms, the same numbers to the last bit).

| call | ns | waiting | in a batch |
| --- | ---: | ---: | ---: |
TIMES
  call_times "$folder"/chm_mint_rgb.bsdf
  cat <<'TIMES'

A draw is a chain: the node of theta_o, the component, a search and a root for each coordinate, the direction; then its
density and the value, each a chain too. What a renderer waits for is their sum, little less: while one chain is under way,
there is room for few instructions of the next call. In a batch sixteen draws go from step to step together, and steps that
need no table are vectors.
TIMES
  printf '\n%s\n' "$kept"
} >docs/sampling.md
echo docs/sampling.md
