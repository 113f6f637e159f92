#!/usr/bin/env bash
# Installs what is missing of the named groups in dependencies.txt: install_dependencies.sh build test
# As root, or with sudo. With everything there it asks nothing of the network.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
for argument in "$@"; do
  case $argument in
    -h|--help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
    -*) echo "install_dependencies: unknown option '$argument'" >&2; exit 2 ;;
  esac
done

packages_of() {
  local line
  for line in $(awk -v group="[$1]" '/^\[/ {on = ($0 == group); next} on && NF && !/^#/ {print $1}' \
      "$here/dependencies.txt"); do
    case $line in
      @*) packages_of "${line#@}" ;;
      *) echo "$line" ;;
    esac
  done
}

missing=()
for group in "${@:-build}"; do
  wanted=$(packages_of "$group")
  if [ -z "$wanted" ]; then
    echo "install_dependencies: unknown group '$group' (mission, build, test, lint, package, rviz)" >&2
    exit 2
  fi
  for package in $wanted; do
    if ! dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then
      missing+=("$package")
    fi
  done
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install_dependencies: run as root or install sudo" >&2; exit 1; }
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
