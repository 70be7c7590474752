#!/bin/sh
# check_complete.sh LOG: fails, naming them, when test cases of the sources do not occur in ctest's log. A test file
# missing from CMakeLists.txt, an empty instantiation and a disabled test all end here.
set -eu
log=$1
cd "$(dirname "$0")/../.."
grep -rhoE --include='*.cpp' '^(TYPED_)?TEST(_F|_P)?\([A-Za-z0-9_]+, *[A-Za-z0-9_]+\)' tests |
  sed -E 's/.*\((.*), *(.*)\)/\1 \2/' | sort -u |
  awk -v log_file="$log" '
    # ctest names: Suite.Name, Prefix/Suite.Name/parameter, Suite.Name<type>, Suite/type.Name
    BEGIN {
      while ((getline line < log_file) > 0) {
        if (line !~ /Test +#[0-9]+: / || line ~ /Not Run/) continue
        sub(/.*Test +#[0-9]+: /, "", line)
        sub(/ .*/, "", line)
        dot = index(line, ".")
        name = substr(line, dot + 1)
        sub(/[\/<].*/, "", name)
        parts = split(substr(line, 1, dot - 1), suite, "/")
        for (i = 1; i <= parts; ++i) ran[suite[i] "." name] = 1
      }
    }
    { ++cases }
    !(($1 "." $2) in ran) { ++missing; print "did not run: " $1 "." $2 }
    END {
      if (!cases) { print "found no test case in the sources"; exit 1 }
      if (missing) exit 1
      print "all " cases " test cases of the sources ran"
    }'
