#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/pictures.sh [EXAMPLE...]: makes the pictures of the examples anew, examples/NAME/NAME.png and, from
# street height, examples/NAME/street.png where street.args names a view. Each stays under 400 kB:
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
[ ${#examples[@]} -gt 0 ] || mapfile -t examples < <(example_names)
mkdir -p build/pictures

for name in "${examples[@]}"; do
  model=build/pictures/$name.glb
  step "Generating $name" "picture-$name.log" generate_example "$gable" "$name" "$model" || exit 1
  step "Drawing $name" "picture-$name.log" \
    render_example "$gable" "$name" "$model" "build/pictures/$name.png" --size 1280x720 || exit 1
  python3 -B tools/shrink_png.py "build/pictures/$name.png" "examples/$name/$name.png"
  if [ -f "examples/$name/street.args" ]; then
    mapfile -t arguments < <(words "examples/$name/street.args")
    step "Drawing $name from the street" "picture-$name.log" \
      "$gable" render "$model" "${arguments[@]}" --size 1280x720 -o "build/pictures/$name-street.png" || exit 1
    python3 -B tools/shrink_png.py "build/pictures/$name-street.png" "examples/$name/street.png"
  fi
done
