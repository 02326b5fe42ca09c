#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/pictures.sh [EXAMPLE...]: makes the pictures of the examples anew, examples/NAME/NAME.png and, where
# street.args, side.args or above.args name a view, examples/NAME/NAME-street.png and so on. Each stays under 400 kB:
# tools/shrink_png.py brings it to a palette and, where that is not enough, to fewer colours. Look at them
# before committing them.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh
. tools/examples.sh

gable=build/release/gable
./run build
examples=("$@")
[ ${#examples[@]} -gt 0 ] || mapfile -t examples < <(place_names; example_names)
mkdir -p build/pictures

for name in "${examples[@]}"; do
  for view in picture street side above; do
    [ "$view" = picture ] || [ -f "examples/$name/$view.args" ] || continue
    drawn=$name
    [ "$view" = picture ] || drawn=$name-$view
    step "Drawing $drawn" "picture-$drawn.log" \
      render_example "$gable" "$name" "build/pictures/$drawn.png" "$view" \
      --size 1200x675 $(samples "$name" "$view") || exit 1
    # Without a file that is imported the picture lacks what lies around.
    ! grep -q import-not-found "build/log/picture-$drawn.log" || die "$drawn: an import is missing, see build/log/picture-$drawn.log"
    python3 -B tools/shrink_png.py "build/pictures/$drawn.png" "examples/$name/$drawn.png"
  done
done
