#!/bin/sh
# quickstart.sh [FILE]: installs what is missing, builds the command and compares the copula families on a material, by
# default the built-in one, else a measured one (.binary, .bsdf). Ends with the table and the paths of the pictures,
# all in out/.
set -eu
material=
[ $# = 0 ] || material=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
cd "$(dirname "$0")/.."
. cmake/packages.sh
need_packages $build_packages

cmake --preset release --log-level=WARNING
cmake --build --preset release --target sklar_command
build/sklar brdf compare ${material:+"$material"} --out out
