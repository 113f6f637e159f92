#!/usr/bin/env bash
# Format of all sources, clang-tidy on some: check_style.sh [BUILD_WITH_COMPILE_COMMANDS [FOLDER...]]
# --fix formats in place instead of complaining.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
case ${1:-} in
  -h|--help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
  --fix) ;;
  -*) echo "check_style.sh: unknown option '$1'" >&2; exit 2 ;;
esac
cd "$top"
mapfile -t files < <(git ls-files '*.hpp' '*.cpp')
if [ "${1:-}" = "--fix" ]; then
  clang-format -i "${files[@]}"
  exit 0
fi
clang-format --dry-run --Werror "${files[@]}"
echo "format: ${#files[@]} files are clean"

# A merge that was not finished.
if git grep -nE '^(<<<<<<<|>>>>>>>|\|\|\|\|\|\|\|)( |$)'; then exit 1; fi

# A name taken over by `using a::b;` must be used: where sources are compiled together clang-tidy
# can't tell whose use it was.
/usr/bin/python3 - $(git ls-files '*.?pp') <<'PY'
import re, sys
unused = []
for name in sys.argv[1:]:
    text = re.sub(r"//.*", "", open(name).read())
    for using in re.finditer(r"^ *using (?:\w+::)+(\w+);", text, re.M):
        rest = text[:using.start()] + text[using.end():]
        if not re.search(r"(?<!::)\b%s\b" % using.group(1), rest):
            unused.append("%s: %s is unused" % (name, using.group(0)))
sys.exit("\n".join(unused) or None)
PY

# Sources of a room are compiled together: a file's own constant must not have the name of another's,
# nor of one within a function there.
/usr/bin/python3 - $(git ls-files 'src/*.cpp') <<'PY'
import collections, re, sys
alone = ("src/identification/", "src/nodes/", "src/plant/")  # not compiled together, or not all
own, within = (collections.defaultdict(set) for _ in range(2))
for name in sys.argv[1:]:
    room = "/".join(name.split("/")[:2]) + "/"
    if room not in alone:
        for found in re.finditer(r"^( *)constexpr [\w:<>, ]+? (k\w+)\b", open(name).read(), re.M):
            (within if found[1] else own)[room, found[2]].add(name)
shared = []
for key, files in own.items():
    every = files | within[key]
    if len(every) > 1:
        shared.append("%s stands in %s" % (key[1], ", ".join(sorted(every))))
sys.exit("\n".join(shared) or None)
PY

# Headers beside the sources are their room's own, those of a folder with a door are that folder's;
# of the others a room includes those of the rooms that it links, and of theirs.
/usr/bin/python3 - $(git ls-files 'src/*.?pp' 'include/*.hpp') <<'PY'
import glob, os, re, sys
links = {}
for lists in glob.glob("src/*/CMakeLists.txt"):
    room = re.search(r"otter_nav_room\((\w+)[^)]*?\bROOMS\s+([a-z\s]+)", open(lists).read())
    if room:
        links[room[1]] = set(room[2].split())
for _ in links:
    for room in links:
        links[room] = links[room].union(*(links.get(other, set()) for other in links[room]))
doors = {"optimizer/ends": "otter_nav/optimizer/ends.hpp"}
inside = []
for name in sys.argv[1:]:
    home = re.sub(r"^(src|include/otter_nav)/", "", os.path.dirname(name))
    for header in re.findall(r'^#include "(?!otter_nav/)(\w+/.*)"', open(name).read(), re.M):
        folder = os.path.dirname(header)
        if os.path.exists("src/" + header) and home.split("/")[0] != folder.split("/")[0]:
            inside.append("%s: %s is another room's own" % (name, header))
        elif folder in doors and home != folder:
            inside.append("%s: %s lies behind %s" % (name, header, doors[folder]))
    room = home.split("/")[0]
    for used in re.findall(r'^#include "otter_nav/(\w+)/', open(name).read(), re.M):
        if room in links and used not in links[room] | {room, "base"}:
            inside.append("%s: room %s doesn't link %s" % (name, room, used))
sys.exit("\n".join(inside) or None)
PY

build=${1:-}
[ -n "$build" ] || exit 0
shift
mapfile -t sources < <(git ls-files "${@:-src}" | grep '\.cpp$')
# clang can't read what gcc compiled of the common headers: its commands do without. What the build
# compiles together is checked together, with the headers beside it, which are then read once.
commands=$(mktemp -d)
trap 'rm -r "$commands"' EXIT
mapfile -t known < <(/usr/bin/python3 - "$build/compile_commands.json" "$commands" "${sources[@]}" <<'PY'
import json, os, re, sys
entries = json.load(open(sys.argv[1]))
wanted = {os.path.realpath(s) for s in sys.argv[3:]}
checked = {}
for entry in entries:
    entry["command"] = re.sub(r"-W(no-error=)?invalid-pch|-Wno-(maybe-uninitialized|subobject-linkage)|"
                              r"-include \S*cmake_pch\.hxx", "", entry["command"])
    together = [entry["file"]]
    if "/Unity/unity_" in entry["file"]:
        together = re.findall(r'#include "(.*)"', open(entry["file"]).read())
    new = wanted.intersection(map(os.path.realpath, together)).difference(*checked.values())
    if new:
        checked[entry["file"]] = new
json.dump(entries, open(os.path.join(sys.argv[2], "compile_commands.json"), "w"))
print(sum(map(len, checked.values())), *checked, sep="\n")
PY
)
printf '%s\n' "${known[@]:1}" |
  xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p "$commands" --config-file=.clang-tidy \
    --header-filter="^$PWD/(include|src|tools|benchmark)/" 2>/dev/null
echo "clang-tidy: ${known[0]} files are clean"
