#!/bin/sh
# deb.sh [BUILD]: what a user of the Debian package does, as root. Builds the package from a build folder (build),
# installs it, runs the quickstart's job by the installed command and a project that uses the library, removes it and
# checks that nothing is left.
set -eu
cd "$(dirname "$0")/../.."
build=$(cd "${1:-build}" && pwd)
source=$(pwd)

fail() {
  echo "$0: $1" >&2
  exit 1
}
installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' sklar 2>/dev/null)" = installed ]; }
traces() { find /usr /etc /var/lib/dpkg/info -iname '*sklar*' -not -path "$source/*"; }

[ "$(id -u)" = 0 ] || fail 'dpkg needs root'
! installed || fail 'the package sklar is installed already; remove it first'
before=$(traces)

scratch=$(mktemp -d)
trap 'if installed; then dpkg --purge sklar >/dev/null; fi; rm -rf "$scratch"' EXIT
cd "$scratch"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch" >cpack.log 2>&1 || { cat cpack.log; fail 'cpack failed'; }
package=$(echo "$scratch"/*.deb)
dpkg-deb --info "$package" | sed -n 's/^ //p'
dpkg-deb --contents "$package" >contents
for file in bin/sklar man/man1/sklar.1 bash-completion/completions/sklar \
  zsh/vendor-completions/_sklar fish/vendor_completions.d/sklar.fish doc/sklar/copyright \
  include/sklar/families/registry.hpp cmake/sklar/sklarConfig.cmake; do
  grep -q "/$file\$" contents || fail "the package has no $file"
done
if command -v lintian >/dev/null; then lintian --no-tag-display-limit "$package" || true; fi

dpkg --install "$package"
[ "$(command -v sklar)" = /usr/bin/sklar ] || fail "sklar is $(command -v sklar)"
env -u LD_LIBRARY_PATH sklar --version
env -u LD_LIBRARY_PATH sklar brdf compare --out out
for file in results.json results.csv report.html; do [ -s "out/$file" ] || fail "no out/$file"; done
cmake -S "$source/tests/install" -B consumer --log-level=WARNING
cmake --build consumer >consumer.log 2>&1 || { cat consumer.log; fail 'a project does not build against the package'; }
env -u LD_LIBRARY_PATH consumer/consumer

dpkg --purge sklar
[ "$(traces)" = "$before" ] || fail "left behind: $(traces)"
echo 'installed, used, removed'
