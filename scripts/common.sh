# shellcheck shell=bash
# Sourced by the scripts beside it: the one place for paths, installing, building and the ROS environment.
set -euo pipefail
export PATH=/usr/bin:$PATH  # ROS is built for the system's Python; another one in front breaks it
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$repository/build

say() { printf '== %s\n' "$*"; }

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

asRoot() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    fail "needs root for: $* (run as root, or install sudo)"
  fi
}

# ROS setup files read variables that may be unset.
sourceSetup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

ros_folder=/opt/ros  # where Ubuntu keeps every ROS

# The folder of the first ROS 1 in there: Noetic, or ROS One. Nothing on Debian, whose packages need no setup file.
systemRos() {
  local ros
  for ros in "$ros_folder"/*; do
    if [ -f "$ros/setup.bash" ] && [ -d "$ros/share/roscpp" ]; then  # ROS 2 has no roscpp
      echo "$ros"
      return
    fi
  done
}

sourceSystemRos() {
  local ros
  ros=$(systemRos)
  if [ -n "$ros" ]; then sourceSetup "$ros/setup.bash"; fi
}

jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}  # how many compilers at once

# buildPackage [TARGET]...: configures and builds in build/. "all" is what a user runs: nothing that only tests need.
buildPackage() {
  local cache=$build/CMakeCache.txt
  sourceSystemRos
  if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$repository" "$cache"; then
    say "build/ was made for another place of this folder: starting it anew"
    rm -rf "$build"
  fi
  mkdir -p "$build"
  say "building in $build with $jobs jobs"
  local options=(-DWARNINGS_AS_ERRORS=ON -DCATKIN_ENABLE_TESTING=ON)
  if [ "${*:-all}" = all ]; then options+=(-DCATKIN_ENABLE_TESTING=OFF); fi
  [ -z "${SANITIZE:-}" ] || options+=(-DSANITIZE="$SANITIZE" -DBUILD_BENCHMARKS=OFF)
  cmake -S "$repository" -B "$build" "${options[@]}" > "$build/configure.log" 2>&1 ||
    { cat "$build/configure.log"; fail "cmake failed"; }
  cmake --build "$build" --parallel "$jobs" --target "${@:-all}"
}

# A bare container may not know its own name, and then no ROS master starts.
ensureLocalhost() {
  if getent hosts localhost > /dev/null; then return; fi
  [ "$(id -u)" = 0 ] || fail "localhost does not resolve: add '127.0.0.1 localhost' to /etc/hosts"
  say "adding localhost to /etc/hosts"
  printf '127.0.0.1 localhost\n' >> /etc/hosts
}

# The built package on the ROS path, on this machine only, with logs inside build/.
enterEnvironment() {
  ensureLocalhost
  sourceSetup "$repository/devel/setup.bash"
  unset ROS_IP
  export ROS_HOSTNAME=localhost ROS_HOME=$build/ros_home ROSCONSOLE_STDOUT_LINE_BUFFERED=1
}
