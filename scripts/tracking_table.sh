#!/usr/bin/env bash
# Tracking figures over seeds as a table: tracking_table.sh [--seeds "1 2 3 4 5"] [BENCHMARK [ARGS...]]
# BENCHMARK is the program tracking_benchmark (from PATH by default), ARGS go to each run. Each row:
# mean error averaged over the seeds, its worst seed, the largest error, the figure to hold.
set -euo pipefail
die() { echo "tracking_table.sh: $1" >&2; exit 2; }
seeds="1 2 3 4 5"
while [ $# -gt 0 ]; do
  case $1 in
    --seeds) [ $# -ge 2 ] || die "--seeds needs a value"; seeds=$2; shift 2 ;;
    -h|--help) sed -n '2,4s/^# //p' "$0"; exit 0 ;;
    -*) die "unknown option '$1'" ;;
    *) break ;;
  esac
done
[[ $seeds =~ ^\ *[0-9]+(\ +[0-9]+)*\ *$ ]] || die "--seeds must be whole numbers from 0, got '$seeds'"
benchmark=${1:-tracking_benchmark}
[ $# -eq 0 ] || shift
command -v "$benchmark" >/dev/null || die "BENCHMARK: no program '$benchmark'"
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

# vessel disturbance mean-to-hold
cases="otter_gazebo none 0.02
otter_gazebo force10 0.02
otter_gazebo paper 0.05
otter_gazebo hard 0.12
otter none 0.04
otter paper 0.10
otter hard 0.18"

echo "| case | mean error, m | worst seed, m | largest error, m | rate rms, N/s | to hold, m | |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
while read -r vessel disturbance hold; do
  for path in eight spiral; do
    rm -f "$out"/*.json
    for seed in $seeds; do
      "$benchmark" --vessel "$vessel" --disturbance "$disturbance" --path "$path" --seed "$seed" \
        --quiet --out "$out/$seed.json" "$@" > "$out/log" || [ $? -eq 2 ] || { cat "$out/log" >&2; exit 1; }
    done
    /usr/bin/python3 - "$vessel $disturbance $path" "$hold" "$out"/*.json <<'PY'
import json, sys
runs = [json.load(open(name)) for name in sys.argv[3:]]
mean = [run["mean_error_m"] for run in runs]
average, hold = sum(mean) / len(mean), float(sys.argv[2])
capsized = sum(run["capsized_at_s"] is not None for run in runs)
print("| %s | %.4f | %.4f | %.3f | %.0f | %.2f | %s |" % (
    sys.argv[1], average, max(mean), max(run["max_error_m"] for run in runs),
    sum(run["thrust_rate_rms_nps"] for run in runs) / len(runs), hold,
    "capsized in %d of %d" % (capsized, len(runs)) if capsized else
    "holds" if max(mean) <= hold else "holds on average" if average <= hold else "does not hold"))
PY
  done
done <<< "$cases"
