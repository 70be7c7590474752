#!/bin/sh
# check_api.sh: writes the API documentation, build/api/html/index.html. Every warning of Doxygen is an error but one: a
# member of a class whose name and type say all may go without a comment.
set -eu
cd "$(dirname "$0")/../.."
mkdir -p build
log=$(doxygen docs/Doxyfile 2>&1) || { echo "$log"; exit 1; }
found=$(echo "$log" | grep -vE 'Member .* of (class|struct) .* is not documented' || true)
[ -z "$found" ] || { echo "$found"; exit 1; }
