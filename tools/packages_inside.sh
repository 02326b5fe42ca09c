#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# What tools/packages.sh does within the fresh root.
set -euo pipefail
cd /try
printf 'Lot --> extrude(9) comp(f) { all : X. }\n' >house.cga

derives() {
  "$1" generate house.cga --lot 24x18 -o "$2.glb"
  "$1" render house.cga --size 64x36 --samples 1 -o "$2.png"
  test -s "$2.glb" && test -s "$2.png"
}

echo "-- the archive, without any package"
apt-get purge -y -qq gable libgable-dev python3-gable >/dev/null 2>&1 || true
mkdir -p "some where"
tar xzf gable-*.tar.gz -C "some where"
mv "some where"/gable-* "some where/moved"
derives "/try/some where/moved/bin/gable" archive
"/try/some where/moved/bin/gable" --version

echo "-- the packages"
apt-get update -qq
apt-get install -y -qq --no-install-recommends ./*.deb g++ pkg-config >/dev/null
dpkg -l gable 'libgable*' python3-gable | sed -n 's/^ii *//p' | cut -c 1-60
derives gable package
cmp archive.glb package.glb
test "$(gable --version | sed -n 's/^examples: //p')" = /usr/share/gable/examples
test -s /usr/share/man/man1/gable-generate.1.gz || grep -q path-exclude /etc/dpkg/dpkg.cfg.d/* 2>/dev/null
bash -c 'source /usr/share/bash-completion/completions/gable
  COMP_WORDS=(gable rend); COMP_CWORD=1; _gable; test "${COMPREPLY[*]}" = render'
python3 - <<'PYTHON'
import gable

house = gable.derive(gable.Rules.load("house.cga"), gable.Shapes.lot(24, 18))
house.write("python.glb")
print("python:", len(house), "leaves")
PYTHON
cmp python.glb package.glb
echo "-- the studio's page"
gable studio . --port 0 >studio.url 2>studio.log &
studio=$!
for _ in $(seq 50); do [ ! -s studio.url ] && sleep 0.2; done
python3 - "$(head -n 1 studio.url)" <<'PYTHON'
import sys
from urllib.request import urlopen

with urlopen(sys.argv[1], timeout=20) as answer:
    page = answer.read().decode()
assert "<script" in page, page[:200]
print("page:", len(page), "characters")
PYTHON
kill "$studio"
cat >use.c <<'C'
#include <gable/c.h>
#include <stdio.h>
int main(void) { printf("library: %s\n", gable_library_version()); return 0; }
C
gcc use.c $(pkg-config --cflags --libs gable) -o use
./use
echo "-- all was used"
