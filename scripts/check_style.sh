#!/usr/bin/env bash
# Format of all sources, clang-tidy on some: check_style.sh [BUILD_WITH_COMPILE_COMMANDS [FOLDER...]]
# --fix formats in place instead of complaining.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
cd "$top"
mapfile -t files < <(git ls-files '*.hpp' '*.cpp')
if [ "${1:-}" = "--fix" ]; then
  clang-format -i "${files[@]}"
  exit 0
fi
clang-format --dry-run --Werror "${files[@]}"
echo "format: ${#files[@]} files are clean"

build=${1:-}
[ -n "$build" ] || exit 0
shift
mapfile -t sources < <(git ls-files "${@:-src}" | grep '\.cpp$')
# clang can't read what gcc compiled of the common headers: its commands do without.
commands=$(mktemp -d)
trap 'rm -r "$commands"' EXIT
mapfile -t known < <(/usr/bin/python3 - "$build/compile_commands.json" "$commands" "${sources[@]}" <<'PY'
import json, os, re, sys
entries = json.load(open(sys.argv[1]))
for entry in entries:
    entry["command"] = re.sub(r"-W(no-error=)?invalid-pch|-Wno-maybe-uninitialized|-include \S*cmake_pch\.hxx", "", entry["command"])
json.dump(entries, open(os.path.join(sys.argv[2], "compile_commands.json"), "w"))
compiled = {os.path.realpath(entry["file"]) for entry in entries}
print("\n".join(s for s in sys.argv[3:] if os.path.realpath(s) in compiled))
PY
)
printf '%s\n' "${known[@]}" |
  xargs -P "$(nproc)" -n 4 clang-tidy --quiet -p "$commands" 2>/dev/null
echo "clang-tidy: ${#known[@]} files are clean"
