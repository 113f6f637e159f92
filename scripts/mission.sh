#!/usr/bin/env bash
# Installs, builds and sails a mission: see --help.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)

usage() {
  cat <<'TEXT'
Usage: scripts/mission.sh [options]
Installs what is missing (root or sudo), builds, and sails a mission from its start to its goal.
Exits with 0 only if the vessel arrived without touching anything.
  --scenario FILE.yaml     scenario to sail (default: the demo archipelago)
  --mission K              mission of the scenario, counted from 0 (default 0)
  --vessel NAME            a name of config/vessels, or a file (default otter_gazebo)
  --disturbance NAME       none, force10, paper or hard (default paper)
  --speed X                times real time (default 1; 0: as fast as it goes)
  --seed N                 seed of sea, sensors and planner (default 1)
  --rviz / --no-rviz       show it in rviz (default: if there is a display)
  --result FILE.json       write the result here (default: results/mission.json)
  --record FILE.bag        record the run, for replay and reports
  --no-build               use what was built last
TEXT
}

die() { echo "mission.sh: $1" >&2; exit 2; }
absolute() { case "$1" in /*) echo "$1" ;; *) echo "$PWD/$1" ;; esac; }

scenario="$top/maps/demo/demo.yaml" mission=0 vessel=otter_gazebo disturbance=paper speed=1 seed=1
rviz=$([ -n "${DISPLAY:-}" ] && echo true || echo false)
result="$top/results/mission.json" record="" build=true
while [ $# -gt 0 ]; do
  case "$1" in
    --rviz) rviz=true; shift; continue ;;
    --no-rviz) rviz=false; shift; continue ;;
    --no-build) build=false; shift; continue ;;
    -h|--help) usage; exit 0 ;;
    --scenario|--mission|--vessel|--disturbance|--speed|--seed|--result|--record)
      [ $# -ge 2 ] || die "$1 needs a value" ;;
    *) usage >&2; die "unknown option '$1'" ;;
  esac
  case "$1" in
    --scenario) scenario=$(absolute "$2") ;;
    --mission) mission=$2 ;;
    --vessel) if [ -f "$2" ]; then vessel=$(absolute "$2"); else vessel=$2; fi ;;
    --disturbance) disturbance=$2 ;;
    --speed) speed=$2 ;;
    --seed) seed=$2 ;;
    --result) result=$(absolute "$2") ;;
    --record) record=$(absolute "$2") ;;
  esac
  shift 2
done

to_1000='^0*([0-9]{1,3}([.][0-9]+)?|1000([.]0+)?)$'
[[ $mission =~ ^[0-9]{1,9}$ ]] || die "--mission must be a whole number from 0, got '$mission'"
[[ $seed =~ ^[0-9]{1,10}$ && $((10#$seed)) -le 2147483647 ]] ||
  die "--seed must be a whole number from 0 to 2147483647, got '$seed'"
[[ $speed =~ $to_1000 ]] || die "--speed must be a number from 0 to 1000, got '$speed'"
[ -f "$scenario" ] || die "--scenario: no file '$scenario'"
# What reads YAML may not be installed yet: then the nodes say it.
missions=$(/usr/bin/python3 -c 'import sys, yaml; print(len(yaml.safe_load(open(sys.argv[1]))["missions"]))' \
  "$scenario" 2>/dev/null) || missions=1000000000
[ "$missions" -gt 0 ] || die "--scenario: no missions in '$scenario'"
[ "$((10#$mission))" -lt "$missions" ] ||
  die "--mission must be from 0 to $((missions - 1)) in '$scenario', got '$mission'"
[ -f "$vessel" ] || [ -f "$top/config/vessels/$vessel.yaml" ] ||
  die "--vessel must be a name of config/vessels, or a file, got '$vessel'"
[ -f "$top/config/disturbances/$disturbance.yaml" ] ||
  die "--disturbance must be none, force10, paper or hard, got '$disturbance'"
if [ -n "$record" ]; then
  [ -d "$(dirname "$record")" ] || die "--record: no folder '$(dirname "$record")'"
  [ ! -d "$record" ] || die "--record must be a file, got the folder '$record'"
  [ ! -e "$record.active" ] ||
    die "--record: '$record.active' is there, perhaps of a recording that was cut off: move it away"
fi
[ ! -d "$result" ] && [ "${result%/}" = "$result" ] || die "--result must be a file, got the folder '$result'"
[ "${result%.csv}" = "$result" ] ||
  die "--result must not end in .csv, where its track will be written, got '$result'"
mkdir -p "$(dirname "$result")" || die "--result: can't make '$(dirname "$result")'"

if $build; then
  groups=(mission)
  if $rviz; then groups+=(rviz); fi
  "$top/scripts/install_dependencies.sh" "${groups[@]}"
  echo "Building (build/build.log has the details)"
  "$top/scripts/build.sh" --mission
fi
[ -f "$top/install/setup.bash" ] || die "nothing is built yet: run without --no-build"
set +u
# shellcheck disable=SC1091
. "$top/install/setup.bash"
set -u

# The usual port if it is free, so that rosnode and rviz find the mission; else any free one. Until a
# mission's master listens its port looks free to the next, so a lock says who has the usual one.
usual=11311
if { exec 9>>"/tmp/otter_nav_mission_$(id -u).lock"; } 2>/dev/null && ! flock -n 9; then usual=0; fi
port=$(/usr/bin/python3 - "$usual" <<'PY'
import socket, sys
for port in (int(sys.argv[1]), 0):
    with socket.socket() as s:
        s.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            s.bind(("", port))
        except OSError:
            continue
        print(s.getsockname()[1])
        break
PY
)
export ROS_MASTER_URI="http://localhost:$port"
# A machine whose own name leads nowhere can still sail for itself.
if [ -z "${ROS_HOSTNAME:-}${ROS_IP:-}" ] && ! getent hosts "$(uname -n)" >/dev/null; then
  export ROS_HOSTNAME=localhost
fi
[ "$port" = 11311 ] || echo "ROS master at $ROS_MASTER_URI"

# What an earlier mission left stays until this one's is written in its place.
written() { stat -c '%i %y' "$result" 2>/dev/null || true; }
before=$(written)
launch_pid=""
stop() { [ -n "$launch_pid" ] && kill -INT "$launch_pid" 2>/dev/null; wait "$launch_pid" 2>/dev/null || true; }
trap stop INT TERM
roslaunch -p "$port" otter_nav mission.launch scenario:="$scenario" mission:="$mission" \
  vessel:="$vessel" disturbance:="$disturbance" speed:="$speed" seed:="$seed" rviz:="$rviz" \
  result:="$result" record:="$record" &
launch_pid=$!
wait "$launch_pid" || true
trap - INT TERM

if [ ! -f "$result" ] || [ "$(written)" = "$before" ]; then
  echo "mission.sh: the mission ended without a result${before:+; $result is of an earlier one}" >&2
  exit 1
fi
/usr/bin/python3 - "$result" <<'PY'
import json, sys
missions = json.load(open(sys.argv[1]))["missions"]
# Once more, below what roslaunch says when it ends.
for m in missions:
    print("%s mission %d: %s%s, %.1f s, %.1f m, %.2f m clear, tracking error %.3f m mean" % (
        m["scenario"], m["mission"], m["outcome"], ": " + m["reason"] if m.get("reason") else "", m["duration_s"],
        m["distance_m"], m["min_clearance_m"], m["tracking_error_mean_m"]))
sys.exit(0 if missions and all(m["outcome"] == "arrived" for m in missions) else 1)
PY
