#!/usr/bin/env bash
# Makes the paper's tables and the figures of missions and encounters again, with scenarios that come
# with the package or that its generator makes: reproduce.sh [--quick] [--build FOLDER] [OUT]
# --quick: one seed, the local missions and a few encounters only. FOLDER holds the built programs
# (default: install/, else build/core, which is built if missing); OUT gets the results (default:
# results/reproduced). The exit code is 0 if every mission arrived.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
build="" out="" seeds=3 kind=all tracking_seeds="1 2 3 4 5" cases="[0-9]*" quick=false
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) quick=true seeds=1 kind=local tracking_seeds=1 cases="0[124]"; shift ;;
    --build)
      [ -d "${2:-}" ] || { echo "reproduce.sh: --build needs a folder, got '${2:-}'" >&2; exit 2; }
      build=$(realpath "$2"); shift 2 ;;
    -h|--help) sed -n '2,6s/^# //p' "$0"; exit 0 ;;
    -*) echo "reproduce.sh: unknown option '$1'" >&2; exit 2 ;;
    *)
      [ -z "$out" ] || { echo "reproduce.sh: one OUT, got '$out' and '$1'" >&2; exit 2; }
      out=$1; shift ;;
  esac
done
out=$(realpath -m "${out:-$top/results/reproduced}")
programs="planner_benchmark tracking_benchmark mission_benchmark scenario_generator"
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

# Keeps what a command says in a file of OUT. A mission that fails doesn't end the others.
status=0
kept() {
  local file=$out/$1
  shift
  "$@" | tee "$file" || status=1
}
encounters() { # SET SEED
  local scenario folder=$out/encounters
  "$(program scenario_generator)" --encounters "$1" --out "$folder"
  for scenario in "$folder/$1"_*$cases.yaml; do
    "$(program mission_benchmark)" --scenarios "$scenario" --vessel otter_gazebo --seed "$2" \
      --out "${scenario%.yaml}.json" --tracks "$folder/tracks" || status=1
  done
  kept "$1.txt" "$top/scripts/judge_encounters.py" --scenarios "$folder" --json "$folder/$1"_*.json --verbose
}

echo "Table I: planning on scenarios/archipelago, seeds 1 to $seeds"
kept table_1.txt "$(program planner_benchmark)" --scenarios "$top/scenarios/archipelago" --map world \
  --kind "$kind" --seeds "$seeds" --budget-ms 1000 --clock cpu --methods baseline,local,global,proposed \
  --vessel otter_gazebo --out "$out/table_1.json"

echo "Table II: tracking, seeds $tracking_seeds"
kept table_2.txt "$top/scripts/tracking_table.sh" --seeds "$tracking_seeds" "$(program tracking_benchmark)"

echo "Encounters: Imazu's cases, captains who never give way, moving fields; disturbance paper"
# Those of a run with more cases would be judged too; what else lies there is not this script's.
rm -f "$out"/encounters/{imazu,captains,moving}_*.{yaml,json}
mkdir -p "$out/encounters/tracks"
encounters imazu 41
encounters captains 1
encounters moving 1

if ! $quick; then
  echo "Whole missions, disturbance paper"
  kept missions.txt "$(program mission_benchmark)" --scenarios "$top/scenarios/archipelago" \
    --vessel otter_gazebo --disturbance paper --out "$out/missions.json" --resume
fi
echo "Results in $out$([ $status -eq 0 ] || echo "; not every mission arrived, or a judge found contacts")"
exit $status
