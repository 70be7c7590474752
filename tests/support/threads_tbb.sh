#!/bin/sh
# threads_tbb.sh FOLDER: the oneTBB of this Debian, built from its source package for ThreadSanitizer and installed in
# FOLDER, unless it is there. A oneTBB that is not built so shows ThreadSanitizer no order between a task and who spawns
# it or waits for it. The package lists and the sources are fetched beside FOLDER, the system's stay as they are.
set -eu
prefix=$1
[ ! -d "$prefix" ] || exit 0
. cmake/packages.sh
need_packages dpkg-dev

work=$prefix.work
rm -rf "$work"
mkdir -p "$work/lists"
cd "$work"
apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' |
  sort -u >sources.list
here="-o Dir::Etc::SourceList=$work/sources.list -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists=$work/lists
  -o Dir::Cache=$work -o APT::Sandbox::User=root"
apt-get -qq $here update
apt-get -qq $here source onetbb
# Without tbbmalloc it takes its memory from malloc, which ThreadSanitizer sees. It does not see fences (-Wno-tsan):
# oneTBB has a few, for threads that go to sleep.
cmake -S onetbb-* -B build -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread \
  -DTBBMALLOC_BUILD=OFF -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBB_ENABLE_IPO=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON \
  -DCMAKE_CXX_FLAGS=-Wno-tsan -DCMAKE_INSTALL_PREFIX="$work/installed"
cmake --build build
cmake --install build >/dev/null
mv installed "$prefix"
cd ..
rm -rf "$work"
