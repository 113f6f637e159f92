#!/usr/bin/env bash
# Builds the package with colcon into build/ and install/ beside the sources:
# build.sh [--tests] [--strict] [--mission]; --strict takes warnings as errors, from then on in this
# build/; --mission makes the nodes alone, unless this build/ has the programs already.
# The compiler's output goes to build/build.log; its end is shown if the build fails.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
testing=OFF
programs=ON
strict=()
for option in "$@"; do
  case $option in
    --tests) testing=ON ;;
    --mission) programs=OFF ;;
    --strict) strict=(-DOTTER_NAV_WERROR=ON) ;;
    -h|--help) sed -n '2,5s/^# //p' "$0"; exit 0 ;;
    *) echo "build: unknown option '$option'" >&2; exit 2 ;;
  esac
done

# On a terminal: how much is done on one refreshed line, so a newcomer sees that it goes on.
show_progress() {
  if [ -t 1 ]; then
    awk '/^\[ *[0-9]+(%|\/[0-9]+)\]/ {printf "\r%.78s\033[K", $0; fflush()} END {printf "\r\033[K"}'
  else
    cat >/dev/null
  fi
}

cd "$top"
mkdir -p build
if grep -qs '^OTTER_NAV_PROGRAMS:BOOL=ON' build/otter_nav/CMakeCache.txt; then
  programs=ON
fi
# Ninja starts what can be started; a build/ that make began stays make's.
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' build/otter_nav/CMakeCache.txt 2>/dev/null || true)
# Left to itself colcon also bounds the load, and what else runs here would halve the build's pace.
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export MAKEFLAGS=${MAKEFLAGS:--j$CMAKE_BUILD_PARALLEL_LEVEL}
# Nobody here speaks Lisp.
export ROS_LANG_DISABLE=${ROS_LANG_DISABLE:-genlisp}
if ! colcon --log-base log build --base-paths "$top" --build-base build --install-base install \
  --merge-install --cmake-args -G "${generator:-Ninja}" -DCMAKE_BUILD_TYPE=Release -DOTTER_NAV_UNITY=ON \
  -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_ENABLE_TESTING=$testing -DOTTER_NAV_PROGRAMS=$programs "${strict[@]}" 2>&1 |
  tee build/build.log | show_progress; then
  tail -n 60 build/build.log >&2
  echo "build: failed; build/build.log has all of it" >&2
  exit 1
fi
