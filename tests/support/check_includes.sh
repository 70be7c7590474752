#!/bin/sh
# The direction of dependence, read from the includes: a part includes itself and the parts before it, no other.
# Also: the core names no family, and each third-party library is included by one source of the library.
set -eu
cd "$(dirname "$0")/../.."
bad=0

complain() {
  echo "$1"
  bad=1
}

# The project headers that the sources directly in a folder may include, as a regular expression.
allowed() {
  core='copula/[^/]*'
  root='copula/.*|families/.*|brdf/[^/]*'
  data="$root|brdf/(geometry|data)/.*"
  render="$data|brdf/(model|analytic|basis|sampling|render)/.*"
  case $1 in
    copula) echo "$core" ;;
    copula/symbolic | copula/simd) echo "$core|$1/.*" ;;
    copula/inference | copula/study) echo "$core|copula/symbolic/.*|$1/.*" ;;
    copula/plot) echo "$core|$1/.*" ;;
    families) echo 'copula/.*|families/.*' ;;
    brdf) echo "$root" ;;
    brdf/geometry) echo "$root|$1/.*" ;;
    brdf/data) echo "$data" ;;
    brdf/model | brdf/analytic | brdf/basis) echo "$data|$1/.*" ;;
    brdf/sampling) echo "$data|$1/.*" ;;
    brdf/code) echo "$data|brdf/(model|sampling|code)/.*" ;;
    brdf/render) echo "$render" ;;
    brdf/study | brdf/study/report) echo "$render|brdf/(code|study)/.*" ;;
    *) complain "$1: no rule says what it may include" >&2 ;;
  esac
}

for folder in $(find copula families brdf -type d); do
  pattern=$(allowed "$folder")
  [ -n "$pattern" ] || bad=1
  for file in $(find "$folder" -maxdepth 1 -name '*.[ch]pp'); do
    found=$(grep -nE '^ *#include "(copula|families|brdf|examples|tests)/' "$file" | grep -vE "\"($pattern)\"" || true)
    [ -z "$found" ] || complain "$file may not include $found"
  done
done

# Comments may say for which family a limit is taken.
for family in $(sed -n '/^set(families/,/^)/p' families/CMakeLists.txt | grep -oE '^  [a-z_]+'); do
  for file in $(find copula -name '*.[ch]pp'); do
    found=$(sed 's|//.*||' "$file" | grep -niw "$family" || true)
    [ -z "$found" ] || complain "$file names the family $family: $found"
  done
done

for library in nlopt 'OpenEXR|Imf|Imath' 'png\.h' cairo embree; do
  files=$(grep -rlE --include='*.[ch]pp' "^ *#include [<\"]($library)" copula families brdf || true)
  [ "$(echo "$files" | wc -w)" -le 1 ] || complain "more than one file includes $library: $files"
  case $files in *.hpp) complain "a header includes $library: $files" ;; esac
done
# json_fields.hpp is for the library's own sources.
found=$(grep -rlE --include='*.hpp' '^ *#include [<"](nlohmann|tbb|CLI)/' copula families brdf | grep -v /json_fields.hpp || true)
[ -z "$found" ] || complain "a header shows its users a private dependency: $found"

exit $bad
