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
    *) echo "build: unknown option '$option'" >&2; exit 2 ;;
  esac
done

# On a terminal: make's percentage on one refreshed line, so a newcomer sees that it goes on.
show_progress() {
  if [ -t 1 ]; then
    awk '/^\[ *[0-9]+%\]/ {printf "\r%.78s\033[K", $0; fflush()} END {printf "\r\033[K"}'
  else
    cat >/dev/null
  fi
}

cd "$top"
mkdir -p build
if grep -qs '^OTTER_NAV_PROGRAMS:BOOL=ON' build/otter_nav/CMakeCache.txt; then
  programs=ON
fi
# Left to itself colcon also bounds the load, and what else runs here would halve the build's pace.
export MAKEFLAGS=${MAKEFLAGS:--j$(nproc)}
if ! colcon --log-base log build --base-paths "$top" --build-base build --install-base install \
  --merge-install --cmake-args -DCMAKE_BUILD_TYPE=Release \
  -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_ENABLE_TESTING=$testing -DOTTER_NAV_PROGRAMS=$programs "${strict[@]}" 2>&1 |
  tee build/build.log | show_progress; then
  tail -n 60 build/build.log >&2
  echo "build: failed; build/build.log has all of it" >&2
  exit 1
fi
