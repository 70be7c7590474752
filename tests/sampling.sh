#!/bin/sh
# sampling.sh FOLDER: how well samplers follow the measured materials (*.bsdf) of a folder. Writes docs/sampling.md; takes
# about ten seconds a material.
set -eu
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
cmake --build build --target sklar_command
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

# What stands behind the table is written by hand.
kept=$(sed -n '/^## How fast pictures converge$/,$p' docs/sampling.md)
{
  cat <<'HEAD'
# Sampling

    build/sklar brdf sample MATERIAL --wo 60,0 -n 1000           # wi, pdf, weight f_r cos / pdf
    build/sklar brdf albedo MATERIAL --furnace 10000             # the albedo by quadrature, and by that sampler
    build/sklar brdf compare MATERIAL... --out out               # the table below among others, and out/efficiency.csv

`SampledBrdf` (`brdf/sampling/sampled_brdf.hpp`) gives any reflectance, a model, a measured table or a formula, a sampler
made for it: given theta_o a mixture of four densities, one of wi and three of the half vector, each of two margins and an
Ali-Mikhail-Haq copula (`brdf/sampling/conditional_sampler.hpp`). It needs 16 KB and about a second to make. The density
integrates to 1: the polar coordinate is truncated where wi would meet the horizon, so that no draw is lost below it. It is
continuous, and nowhere below 0.002 cos(theta_i) / pi. Two uniforms make a draw; a lattice or a low-discrepancy sequence
serves as well as random ones. Luminance is followed: where the channels differ in shape, so do their weights. An anisotropic
reflectance is followed as far as its mean over phi_o goes, with an exact density all the same.

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
  printf '\n%s\n' "$kept"
} >docs/sampling.md
echo docs/sampling.md
