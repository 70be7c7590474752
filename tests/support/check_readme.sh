#!/bin/sh
# check_readme.sh BUILD: what README.md shows is what there is. The fenced block after `<!-- file: PATH -->` must equal
# the file, the one after `<!-- output: COMMAND -->` what the command prints when run in the build folder.
set -eu
cd "$(dirname "$0")/../.."
root=$(pwd)
build=$1
shown=$(mktemp)
actual=$(mktemp)
trap 'rm -f "$shown" "$actual"' EXIT
bad=0

markers=$(grep -E '^<!-- (file|output): .* -->$' README.md)
[ -n "$markers" ] || { echo "README.md has no marked block"; exit 1; }
echo "$markers" | {
  while read -r marker; do
    awk -v marker="$marker" '
      $0 == marker { found = 1; next }
      found && /^```/ { if (inside) exit; inside = 1; next }
      inside { print }' README.md >"$shown"
    what=${marker#<!-- *: }
    what=${what% -->}
    case $marker in
      '<!-- file:'*) cat "$root/$what" >"$actual" ;;
      *) (cd "$build" && sh -c "$what") >"$actual" ;;
    esac
    diff -u "$shown" "$actual" || { echo "README.md differs from $what"; bad=1; }
  done
  exit $bad
}
