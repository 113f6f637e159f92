#!/usr/bin/env bash
# Builds the Debian package of the committed state: package.sh [--try] [OUT, default build/package]
# With --try it is installed in a clean Debian 12 (debootstrap, as root), sails the demo mission there,
# and is purged; anything it leaves behind fails.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
try=false out=$top/build/package
for argument in "$@"; do
  case $argument in
    --try) try=true ;;
    -h|--help) sed -n '2,4s/^# //p' "$0"; exit 0 ;;
    -*) echo "package: unknown option '$argument'" >&2; exit 2 ;;
    *) out=$argument ;;
  esac
done
mkdir -p "$out"
out=$(cd "$out" && pwd)

"$top/scripts/install_dependencies.sh" build package
version=$(sed -n 's:.*<version>\(.*\)</version>.*:\1:p' "$top/package.xml")
grep -q "^otter-nav ($version)" "$top/debian/changelog" ||
  { echo "package: debian/changelog and package.xml name different versions" >&2; exit 1; }
source=$out/otter-nav-$version
rm -rf "$source"
mkdir "$source"
git -C "$top" archive HEAD | tar -x -C "$source"
(cd "$source" && DEB_BUILD_OPTIONS="parallel=$(nproc) noautodbgsym ${DEB_BUILD_OPTIONS:-}" \
  dpkg-buildpackage --build=binary --no-sign >"$out/build.log" 2>&1) ||
  { tail -n 40 "$out/build.log" >&2; echo "package: failed; $out/build.log has all of it" >&2; exit 1; }
package=$(find "$out" -maxdepth 1 -name "otter-nav_${version}_*.deb")
echo "Built $package"
$try || exit 0

root=$(mktemp -d)
trap 'umount "$root/proc" "$root/dev" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT
mirror=$(sed -n 's/^\(deb\|URIs:\) *\(http[^ ]*\).*/\2/p' /etc/apt/sources.list \
  /etc/apt/sources.list.d/* 2>/dev/null | head -n 1 || true)
debootstrap --variant=minbase bookworm "$root" ${mirror:+"$mirror"} >"$out/try.log"
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
for file in /etc/resolv.conf /etc/hosts /etc/apt/apt.conf.d/*proxy*; do
  [ -f "$file" ] && install -D -m 644 "$file" "$root$file"
done
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
  DEBIAN_FRONTEND=noninteractive ROS_HOSTNAME=localhost "$@"; }
listing() { (cd "$root" && find etc usr opt root home srv var/lib -xdev \
  \( -path var/lib/dpkg -o -path var/lib/apt -o -path root/.ros \) -prune -o -print | sort); }

cp "$package" "$root/tmp/"
inside apt-get update -qq
# What it depends on comes first, so that the purge shows what the package itself leaves.
inside sh -c 'apt-get install -y -qq --no-install-recommends $(dpkg-deb -f /tmp/otter-nav_*.deb Depends |
  sed "s/([^)]*)//g; s/|[^,]*//g; s/,/ /g")' >>"$out/try.log" 2>&1
listing >"$out/before.txt"
inside apt-get install -y -qq --no-install-recommends "/tmp/${package##*/}" >>"$out/try.log" 2>&1
inside otter_nav --help
for program in $(inside otter_nav --help | sed -n 's/^  //p'); do
  [ -s "$root/usr/share/man/man1/otter_nav-$program.1.gz" ] ||
    { echo "package: no manual page of $program" >&2; exit 1; }
done
for file in bash-completion/completions/otter_nav doc/otter-nav/README.md doc/otter-nav/docs/nodes.md; do
  [ -s "$root/usr/share/$file" ] || { echo "package: no /usr/share/$file" >&2; exit 1; }
done
inside roslaunch otter_nav mission.launch speed:=0 result:=/tmp/mission.json
inside sh -c 'grep -q "\"outcome\": *\"arrived\"" /tmp/mission.json' ||
  { echo "package: the mission did not arrive" >&2; exit 1; }
inside apt-get purge -y -qq otter-nav >>"$out/try.log" 2>&1
listing >"$out/after.txt"
diff "$out/before.txt" "$out/after.txt" || { echo "package: purge left the files above" >&2; exit 1; }
echo "The package sails its demo mission in a clean Debian 12 and leaves nothing behind"
