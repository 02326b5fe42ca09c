#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/park_pictures.sh: makes the pictures of the park grammars anew, docs/guide/park/NAME.png. Look at them
# before committing them.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

gable=${GABLE:-build/release/gable}
[ -x "$gable" ] || ./run build
mkdir -p build/pictures docs/guide/park

# picture NAME GRAMMAR ARGUMENT...: the shapes, the seed and the view are the arguments.
picture() {
  local name=$1 grammar=$2
  local size=480x360
  shift 2
  case $name in promenade*) size=1000x560 ;; esac
  step "Drawing $name" "park-$name.log" "$gable" render "examples/park/$grammar.park" --size "$size" \
    "$@" --samples "${SAMPLES:-32}" -o "build/pictures/park-$name.png" || exit 1
  python3 -B tools/shrink_png.py "build/pictures/park-$name.png" "docs/guide/park/$name.png"
}

picture square square --lot 20x20 --eye=0,15,11 --target=10,0,-9 --fov 50
picture circular circular --lot 40x40 --seed 4 --eye=2,28,26 --target=20,0,-18 --fov 48
picture circular-c circular --shapes examples/park/plot.obj --seed 2 --view iso
picture freeform freeform --lot 60x60 --seed 2 --eye=4,42,36 --target=30,0,-27 --fov 48
picture recursive recursive --lot 40x30 --eye=4,24,22 --target=20,0,-14 --fov 48
picture irregular irregular --lot 40x40 --seed 3 --eye=4,26,24 --target=20,0,-18 --fov 48
picture cells cells --lot 51x27 --eye=6,26,26 --target=25,0,-13 --fov 48
picture metric metric --lot 40x40 --seed 1 --eye=2,28,26 --target=20,0,-18 --fov 48
picture promenade promenade --lot 44x36 --eye=4,30,28 --target=22,0,-16 --fov 46
picture promenade-street promenade --lot 44x36 --eye=14,1.7,-15.8 --target=26,1.2,-20 --fov 65
picture freeform-c freeform --shapes examples/park/plot.obj --seed 3 --view iso
