#!/usr/bin/env bash
# The core alone, without catkin, in Debug with address and undefined-behaviour sanitizers: builds
# it and runs its unit and closed-loop suites. test_sanitized.sh [--build-only] [BUILD_FOLDER]
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
testing=ON build=$top/build-sanitized
for argument in "$@"; do
  case $argument in
    --build-only) testing=OFF ;;
    -h|--help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
    -*) echo "test_sanitized.sh: unknown option '$argument'" >&2; exit 2 ;;
    *) build=$argument ;;
  esac
done
# clang takes half of gcc's time for what it instruments, and is a second opinion.
# Line tables are all that the sanitizers' reports need; full debug information doubles the time.
cmake -S "$top" -B "$build" -G Ninja -DOTTER_NAV_CORE_ONLY=ON -DOTTER_NAV_UNITY=ON -DOTTER_NAV_SANITIZE=ON -DOTTER_NAV_WERROR=ON \
  -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-g1 >"$build.configure.log" 2>&1 || { cat "$build.configure.log"; exit 1; }
cmake --build "$build" --parallel "$(nproc)" --target unit_tests loop_tests >"$build.build.log" 2>&1 ||
  { tail -n 60 "$build.build.log"; exit 1; }
[ "$testing" = ON ] || exit 0
# Tests that count allocations replace the operators the sanitizer watches: they run in test.sh alone.
ASAN_OPTIONS=detect_leaks=1 ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -R '^(unit|loop)_' \
  -E allocation
