#!/usr/bin/env bash
# Makes the paper's tables and the missions' figures again, with the scenarios that come with the
# package: reproduce.sh [--quick] [--build FOLDER] [OUT]
# --quick: one seed, the local missions only. FOLDER holds the built programs (default: install/, else
# build/core, which is built if missing); OUT gets the results (default: results/reproduced).
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
build="" seeds=3 kind=all tracking_seeds="1 2 3 4 5" quick=false
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) quick=true seeds=1 kind=local tracking_seeds=1; shift ;;
    --build) build=$(realpath "${2:?reproduce.sh: --build needs a folder}"); shift 2 ;;
    -h|--help) sed -n '2,5s/^# //p' "$0"; exit 0 ;;
    -*) echo "reproduce.sh: unknown option '$1'" >&2; exit 2 ;;
    *) break ;;
  esac
done
out=$(realpath -m "${1:-$top/results/reproduced}")
programs="planner_benchmark tracking_benchmark mission_benchmark"
if [ -z "$build" ]; then
  build=$top/install
  if ! find "$build" -name planner_benchmark -type f 2>/dev/null | grep -q .; then
    build=$top/build/core
    cmake -S "$top" -B "$build" -DOTTER_NAV_CORE_ONLY=ON -DBUILD_TESTING=OFF >/dev/null
    # shellcheck disable=SC2086
    cmake --build "$build" --target $programs
  fi
fi
program() {
  local found
  found=$(find -L "$build" -name "$1" -type f -perm -u+x | head -n 1)
  [ -n "$found" ] || { echo "reproduce.sh: no $1 in $build" >&2; exit 2; }
  echo "$found"
}
for name in $programs; do program "$name" >/dev/null; done
mkdir -p "$out"
export OTTER_NAV_SHARE=$top

echo "Table I: planning on scenarios/archipelago, seeds 1 to $seeds"
"$(program planner_benchmark)" --scenarios "$top/scenarios/archipelago" --map world --kind "$kind" \
  --seeds "$seeds" --budget-ms 1000 --clock cpu --methods baseline,local,global,proposed \
  --vessel otter_gazebo --out "$out/table_1.json" | tee "$out/table_1.txt"

echo "Table II: tracking, seeds $tracking_seeds"
"$top/scripts/tracking_table.sh" --seeds "$tracking_seeds" "$(program tracking_benchmark)" | tee "$out/table_2.txt"

if ! $quick; then
  echo "Whole missions, disturbance paper"
  "$(program mission_benchmark)" --scenarios "$top/scenarios/archipelago" --vessel otter_gazebo \
    --disturbance paper --out "$out/missions.json" --resume | tee "$out/missions.txt"
fi
echo "Results in $out"
