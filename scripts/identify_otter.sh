#!/usr/bin/env bash
# Finds config/vessels/otter.yaml again: sails the excitation manoeuvres on the plant, without ROS,
# and identifies the vessel: identify_otter.sh [BUILD] [OUT.yaml]
# BUILD holds the built programs (default: install/, else build/core, which is built if missing).
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
die() { echo "identify_otter.sh: $1" >&2; exit 2; }
for argument in "$@"; do
  case $argument in
    -h|--help) sed -n '2,4s/^# //p' "$0"; exit 0 ;;
    -*) die "unknown option '$argument'" ;;
  esac
done
[ $# -le 2 ] || die "takes BUILD and OUT.yaml, got '$3' too"
[ -z "${1:-}" ] || [ -d "$1" ] || die "BUILD: no folder '$1'"
# Absolute, for the work is done elsewhere.
build=${1:+$(realpath "$1")}
out=$(realpath -m "${2:-$top/config/vessels/otter.yaml}")
[ -d "$(dirname "$out")" ] && [ ! -d "$out" ] || die "OUT: '$out' is a folder, or in none"

if [ -z "$build" ]; then
  build=$top/install
  if ! find "$build" -name excitation_run -type f 2>/dev/null | grep -q .; then
    build=$top/build/core
    cmake -S "$top" -B "$build" -DOTTER_NAV_CORE_ONLY=ON -DBUILD_TESTING=OFF >/dev/null
    cmake --build "$build" --target excitation_run identify
  fi
fi
program() { find "$build" -name "$1" -type f -perm -u+x | head -n 1; }
for name in excitation_run identify; do
  [ -n "$(program $name)" ] || die "BUILD: no program $name in '$build'"
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OTTER_NAV_SHARE=$top
cd "$work"
"$(program excitation_run)" --vessel otter --out excitation.csv
"$(program identify)" --csv excitation.csv --vessel-guess otter_textbook --name otter \
  --out otter.yaml --report "$top/build/identification_otter" \
  --origin "the excitation manoeuvres on the plant otter (scripts/identify_otter.sh)"
cp otter.yaml "$out"
