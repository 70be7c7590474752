# Debian 12 packages and how they are installed; sourced by examples/quickstart.sh, tests/run.sh and .ci/run.

build_packages="cmake ninja-build g++ pkg-config libeigen3-dev libboost-dev libmpfr-dev libhwy-dev libnlopt-dev libnlopt-cxx-dev libopenexr-dev
  libpng-dev libcairo2-dev libtbb-dev libembree-dev nlohmann-json3-dev libjs-chart.js libcli11-dev libgtest-dev
  glslang-tools"
ci_packages="$build_packages chromium git clang clang-format clang-tidy doxygen dpkg-dev file mandoc libopenmpi-dev
  openmpi-bin zsh fish"

# need_packages NAME...: installs those that are missing, as root or through sudo; where that cannot be, says what is
# missing and ends the script with status 1.
need_packages() {
  if ! command -v apt-get >/dev/null; then
    command -v cmake >/dev/null && command -v ninja >/dev/null && return # CMake names the library that it does not find
    echo "$0: no apt-get here. Install what these Debian packages hold: $(echo "$@")" >&2
    exit 1
  fi
  missing=
  for package in "$@"; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || true
    [ "$status" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  as_root=
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "$0: missing packages; as root: apt-get install$missing" >&2
      exit 1
    fi
    as_root=sudo
  fi
  echo "installing$missing"
  $as_root apt-get -qq update || true # what the lists lack, the next line reports
  if ! $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install $missing >/dev/null; then
    echo "$0: apt-get could not install$missing" >&2
    exit 1
  fi
}
