# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# What an example is: examples/NAME/NAME.cga, on the shapes of examples/NAME/buildings.geojson where
# there is such a file. generate.args and picture.args beside them hold further arguments of
# `gable generate` and `gable render`; # starts a comment in them. Sourced from the repository's root.

example_names() {
  local rules name
  for rules in examples/*/*.cga; do
    name=$(basename "$rules" .cga)
    if [ -f "$rules" ] && [ "$rules" = "examples/$name/$name.cga" ]; then echo "$name"; fi
  done
}

# words FILE: the words of a file without its comments, one a line; none where there is no file.
words() { [ ! -f "$1" ] || sed 's/#.*//' "$1" | xargs -n 1; }

# generate_example GABLE NAME MODEL ARGUMENT...
generate_example() {
  local gable=$1 name=$2 model=$3 folder=examples/$2 arguments
  shift 3
  mapfile -t arguments < <(words "$folder/generate.args")
  [ ! -f "$folder/buildings.geojson" ] || arguments+=(--shapes "$folder/buildings.geojson")
  "$gable" generate "$folder/$name.cga" ${arguments[@]+"${arguments[@]}"} "$@" -o "$model"
}

# render_example GABLE NAME MODEL PICTURE ARGUMENT...
render_example() {
  local gable=$1 name=$2 model=$3 picture=$4 arguments
  shift 4
  mapfile -t arguments < <(words "examples/$name/picture.args")
  "$gable" render "$model" ${arguments[@]+"${arguments[@]}"} "$@" -o "$picture"
}
