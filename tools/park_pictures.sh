#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/park_pictures.sh: makes the pictures of the park grammars anew, docs/guide/park/NAME.png, seen from
# above, but for the one that is built in volume. Look at them before committing them.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

gable=${GABLE:-build/release/gable}
[ -x "$gable" ] || ./run build
mkdir -p build/pictures docs/guide/park

# picture NAME GRAMMAR ARGUMENT...: the shapes and the seed are the arguments.
picture() {
  local name=$1 grammar=$2
  local view=(--view top --size 480x480)
  shift 2
  case " $* " in *" --view "*) view=() ;; esac
  step "Drawing $name" "park-$name.log" "$gable" render "examples/park/$grammar.park" "${view[@]}" \
    "$@" --samples "${SAMPLES:-32}" -o "build/pictures/park-$name.png" || exit 1
  python3 -B tools/shrink_png.py "build/pictures/park-$name.png" "docs/guide/park/$name.png"
}

picture square square --lot 20x20
picture circular circular --lot 40x40 --seed 4
picture circular-c circular --shapes examples/park/plot.obj --seed 2
picture freeform freeform --lot 60x60 --seed 2
picture recursive recursive --lot 40x30
picture irregular irregular --lot 40x40 --seed 3
picture cells cells --lot 51x27
picture metric metric --lot 40x40 --seed 1
picture promenade promenade --lot 44x36 --view iso --size 1000x560
picture freeform-c freeform --shapes examples/park/plot.obj --seed 3
