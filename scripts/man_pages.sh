#!/usr/bin/env bash
# Writes a manual page for each program of a folder from its --help: man_pages.sh PROGRAMS OUT
# Needs help2man. The pages are otter_nav-PROGRAM(1), and otter_nav(1) for what runs them.
set -euo pipefail
for argument in "$@"; do
  case $argument in
    -h|--help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
    -*) echo "man_pages.sh: unknown option '$argument'" >&2; exit 2 ;;
  esac
done
[ $# -eq 2 ] || { echo "Usage: man_pages.sh PROGRAMS OUT" >&2; exit 2; }
top=$(cd "$(dirname "$0")/.." && pwd)
programs=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
version=$(sed -n 's:.*<version>\(.*\)</version>.*:\1:p' "$top/package.xml")

page() { # name, command, what it is
  help2man --no-info --section 1 --source "otter_nav $version" --version-string "$version" \
    --manual "otter_nav" --name "$3" --output "$out/$1.1" "$2"
  # The command as it is typed, not the folder it was asked in; the page goes by its own name.
  local program=${1#otter_nav-}
  sed -i -e "s:$programs/::g" -e "s/^\.TH [^ ]*/.TH ${1^^}/" -e "s/^$program \\\\-/$1 \\\\-/" \
    -e "s/^\(\.B \|usage: \)$program\b/\1${1/-/ }/" "$out/$1.1"
}

for program in "$programs"/*; do
  name=${program##*/}
  case $name in *_node | *.py) continue ;; esac
  [ -f "$program" ] && [ -x "$program" ] || continue
  # CLI11 begins with the sentence about the program, argparse has it after the usage.
  what=$("$program" --help | awk '/^[A-Z]/ && !/^[Uu]sage/ {print; exit}')
  page "otter_nav-$name" "$program" "${what:-a program of otter_nav}"
done
page otter_nav "$top/scripts/otter_nav" "navigation of a small under-actuated vessel"
