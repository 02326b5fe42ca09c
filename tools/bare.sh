#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/bare.sh [COMMAND...]: proves the two commands on a bare machine. Makes a Debian 12 root with
# nothing but git in it (debootstrap), clones the last commit into it and runs ./run and ./test there, each
# twice: the second time must be quick. With a COMMAND, runs that in the clone instead. Needs root.
# BARE_ROOT is where the root lies (build/bare), BARE_MIRROR the Debian mirror; BARE_FRESH=1 makes it anew,
# otherwise a root that is there is used again, with a new clone.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

[ "$(id -u)" = 0 ] || die "tools/bare.sh has to mount and chroot: run it as root."
bare=$(realpath -m "${BARE_ROOT:-build/bare}")
mirror=${BARE_MIRROR:-http://deb.debian.org/debian}
install debootstrap git

unmount() {
  local at
  for at in dev/shm dev proc sys; do
    if mountpoint -q "$bare/$at"; then umount -l "$bare/$at"; fi
  done
}
trap unmount EXIT

if [ -n "${BARE_FRESH:-}" ]; then
  unmount
  rm -rf --one-file-system "$bare"
fi
make_root() { debootstrap --variant=minbase --include=git,ca-certificates bookworm "$bare" "$mirror"; }
if [ ! -f "$bare/etc/debian_version" ]; then
  step "Making a bare Debian 12" debootstrap.log make_root || exit 1
fi

# The host's way to the network: its Debian sources, its name server, its certificates. Sources of other
# projects stay out, so that what gets installed is Debian's.
rm -f "$bare"/etc/apt/sources.list.d/*
for sources in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  if [ -f "$sources" ] && grep -q 'debian.org\|/debian' "$sources" && ! grep -q nodesource "$sources"; then
    command install -D -m 644 "$sources" "$bare$sources"
  fi
done
cp -L /etc/resolv.conf "$bare/etc/resolv.conf"
cp -L /etc/ssl/certs/ca-certificates.crt "$bare/etc/ssl/certs/ca-certificates.crt"
mkdir -p "$bare"/{dev,proc,sys}
mountpoint -q "$bare/proc" || mount -t proc proc "$bare/proc"
mountpoint -q "$bare/dev" || mount --bind /dev "$bare/dev"
mountpoint -q "$bare/sys" || mount --bind /sys "$bare/sys"

rm -rf "$bare/src/gable"
git clone --quiet --no-hardlinks "$root" "$bare/src/gable"

# Nothing of this shell's environment goes in but the proxy and the certificates.
inside() {
  local keep
  mapfile -t keep < <(env | grep -iE '^(https?_proxy|no_proxy|NODE_EXTRA_CA_CERTS|SSL_CERT_FILE)=')
  chroot "$bare" /usr/bin/env -i HOME=/root TERM="${TERM:-dumb}" LANG=C.UTF-8 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    ${keep[@]+"${keep[@]}"} bash -c 'cd /src/gable && "$@"' bash "$@"
}

if [ $# -gt 0 ]; then
  inside "$@"
  exit
fi
for command in ./run ./run ./test ./test; do
  start=$SECONDS
  inside "$command" || die "$command failed in the bare root"
  say "${bold}bare: $command took $(spell $((SECONDS - start)))$plain"
done
