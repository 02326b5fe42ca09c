#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/packages.sh [BUILD]: makes the packages of Debian and the archive from a build folder (default:
# build/release, which is built where it is missing), and tries them: installed in a fresh Debian 12
# (debootstrap), the program derives, draws, completes and shows the studio's page, which is built where it is
# missing, a program is built against the library, and Python derives the same model; the archive runs in the
# same root without the packages. Needs root. Packages lie in out/packages. PACKAGES_ROOT is where the root lies (build/packages-root; one that is there is
# used again).
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

[ "$(id -u)" = 0 ] || die "tools/packages.sh has to chroot: run it as root."
build=${1:-build/release}
bare=$(realpath -m "${PACKAGES_ROOT:-build/packages-root}")
out=$root/out/packages
install debootstrap dpkg-dev gzip binutils
if [ $# = 0 ]; then build release all gable_python || exit 1; fi
if [ ! -s build/studio/index.html ]; then
  node_usable || install nodejs npm
  page_packages || exit 1
  step "Building the studio's page" page.log build_page || exit 1
fi
rm -rf "$out"
make_packages() {
  cpack --config "$build/CPackConfig.cmake" -G DEB -B "$out" -D CPACK_DEBIAN_COMPRESSION_TYPE="${PACKAGES_COMPRESSION:-xz}" &&
    cpack --config "$build/CPackConfig.cmake" -G TGZ -B "$out"
}
step "Making packages" packages.log make_packages || exit 1

make_root() { debootstrap --variant=minbase --include=ca-certificates bookworm "$bare" "${BARE_MIRROR:-http://deb.debian.org/debian}"; }
if [ ! -f "$bare/etc/debian_version" ]; then
  step "Making a bare Debian 12" packages-root.log make_root || exit 1
fi
cp -L /etc/resolv.conf "$bare/etc/resolv.conf"
cp -L /etc/ssl/certs/ca-certificates.crt "$bare/etc/ssl/certs/ca-certificates.crt"
for sources in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  if [ -f "$sources" ] && grep -q 'debian.org\|/debian' "$sources" && ! grep -q nodesource "$sources"; then
    command install -D -m 644 "$sources" "$bare$sources"
  fi
done
unmount() { if mountpoint -q "$bare/proc"; then umount -l "$bare/proc"; fi; }
trap unmount EXIT
mkdir -p "$bare/proc"
mountpoint -q "$bare/proc" || mount -t proc proc "$bare/proc"
rm -rf "$bare/try"
mkdir -p "$bare/try"
cp "$out"/*.deb "$out"/*.tar.gz tools/packages_inside.sh "$bare/try/"
# Nothing of this shell's environment goes in but the proxy.
mapfile -t keep < <(env | grep -iE '^(https?_proxy|no_proxy)=' || true)
chroot "$bare" /usr/bin/env -i HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin ${keep[@]+"${keep[@]}"} \
  bash /try/packages_inside.sh
say "packages: $(ls "$out"/*.deb "$out"/*.tar.gz | wc -l) tried, in ${out#"$root"/}"
