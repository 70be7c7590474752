#!/bin/sh
# check_pages.sh BUILD [--write] PAGE...: what the Markdown pages show is what there is.
#
#   ```sh          commands, run in the order of the page in a folder of its own, where examples/ and build/ are those of
#                  the repository and `sklar` is found
#   ```text        what the commands before it print: the same words and whole numbers, other numbers to the last place
#                  shown and a relative 1e-7 (an estimate found by values of the likelihood is known to 1e-8, and its
#                  last places differ between processors); with ```text 2% all numbers to 2 %
#   <!-- file: PATH -->   the next block is that file
#   <!-- from: PATH -->   the next block is lines of that file, without regard to how far they are indented
#
# Blocks of C++ and JSON have one of the two; links lead to files that there are. Commands that take minutes or a file
# that is not in the repository stand in indented blocks, which are not run; that their options exist is checked. --write
# puts files and output that differ into the pages.
set -eu
cd "$(dirname "$0")/../.."
root=$(pwd)
build=$(cd "$1" && pwd)
shift
write=
if [ "$1" = --write ]; then
  write=yes
  shift
fi
PATH=$build:$PATH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bad=0

for page in "$@"; do
  rm -rf "$scratch/work"
  mkdir "$scratch/work"
  ln -s "$root/examples" "$scratch/work/examples"
  ln -s "$build" "$scratch/work/build"
  if ! awk -v root="$root" -v work="$scratch/work" -f tests/support/pages.awk "$page" >"$scratch/page"; then
    bad=1
  elif [ -n "$write" ]; then
    cp "$scratch/page" "$page"
  else
    diff -u "$page" "$scratch/page" || { echo "$page is not what it should be; check_pages.sh --write mends it"; bad=1; }
  fi
done
exit $bad
