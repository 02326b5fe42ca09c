# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# What an example is: examples/NAME/NAME.cga, or a grammar of that name in another notation, on the
# shapes of examples/NAME/buildings.geojson where there is such a file. generate.args beside them holds further arguments of
# `gable generate`, pictures.args those of all its pictures, picture.args, street.args, side.args and above.args those of
# one each; examples/pictures.args has those of all pictures of all examples. # starts a comment in them. An example of
# a place is a map instead, examples/NAME/NAME.osm or NAME.osm.pbf, for `gable city`. Sourced from the repository's root.

# The park grammars share a folder: examples/park/NAME.park is the example park/NAME.

# Those with a folder of their own.
example_names() {
  local folder name
  for folder in examples/*/; do
    name=$(basename "$folder")
    if [ -n "$(example_rules "$name")" ]; then echo "$name"; fi
  done
}

# example_map NAME: the map of a place; nothing where the example is none.
example_map() {
  local extension
  for extension in osm.pbf osm; do
    [ ! -f "examples/$1/$1.$extension" ] || { echo "examples/$1/$1.$extension" && return; }
  done
}

place_names() {
  local folder name
  for folder in examples/*/; do
    name=$(basename "$folder")
    if [ -n "$(example_map "$name")" ]; then echo "$name"; fi
  done
}

park_names() {
  local file
  for file in examples/park/*.park; do echo "park/$(basename "$file" .park)"; done
}

# park_arguments NAME: the lot, and the seed, that a park grammar is shown on.
park_arguments() {
  case $1 in
    park/circular) echo --lot 40x40 --seed 4 ;;
    park/freeform) echo --lot 60x60 --seed 2 ;;
    park/recursive) echo --lot 40x30 ;;
    park/irregular) echo --lot 40x40 --seed 3 ;;
    park/cells) echo --lot 51x27 ;;
    park/metric) echo --lot 40x40 --seed 1 ;;
    park/promenade) echo --lot 44x36 ;;
    park/*) echo --lot 20x20 ;;
  esac
}

# example_rules NAME: its rule file; nothing when there is no such example.
example_rules() {
  local extension
  case $1 in park/*) [ ! -f "examples/$1.park" ] || echo "examples/$1.park" && return ;; esac
  for extension in cga gbbg grammar pg3d park; do
    [ ! -f "examples/$1/$1.$extension" ] || { echo "examples/$1/$1.$extension" && return; }
  done
}

# words FILE: the words of a file without its lines of comment, one a line; none where there is no file.
words() { [ ! -f "$1" ] || sed 's/^#.*//' "$1" | xargs -n 1; }

# derive_arguments NAME: what `gable generate` and `gable render` are told about an example.
derive_arguments() {
  example_rules "$1"
  park_arguments "$1" | xargs -r -n 1
  words "examples/$1/generate.args"
  [ ! -f "examples/$1/buildings.geojson" ] || printf '%s\n' --shapes "examples/$1/buildings.geojson"
}

# generate_example GABLE NAME MODEL ARGUMENT...
generate_example() {
  local gable=$1 name=$2 model=$3 map arguments
  shift 3
  map=$(example_map "$name")
  if [ -n "$map" ]; then
    mapfile -t arguments < <(words "examples/$name/generate.args")
    "$gable" city "$map" "${arguments[@]}" "$@" -o "$model"
    return
  fi
  mapfile -t arguments < <(derive_arguments "$name")
  "$gable" generate "${arguments[@]}" "$@" -o "$model"
}

# picture_arguments NAME VIEW: what all pictures of all examples are told, those of one, and one picture: its camera.
picture_arguments() { words examples/pictures.args; words "examples/$1/pictures.args"; words "examples/$1/$2.args"; }

# samples NAME VIEW: how many a pixel has, where the picture's own arguments do not say it.
samples() { picture_arguments "$1" "$2" | grep -qx -e --samples || echo --samples 24; }

# render_example GABLE NAME PICTURE VIEW ARGUMENT...
# Drawn from the rules, not from the model: parts that occur often are held in memory once. Where there is
# examples/NAME/pictures.cga, it is drawn in place of the rules: it calls them and what lies around.
render_example() {
  local gable=$1 name=$2 picture=$3 view=$4 map arguments
  shift 4
  map=$(example_map "$name")
  if [ -n "$map" ]; then
    mapfile -t arguments < <(words "examples/$name/generate.args"; picture_arguments "$name" "$view")
    "$gable" city "$map" "${arguments[@]}" "$@" --picture "$picture"
    return
  fi
  mapfile -t arguments < <(derive_arguments "$name"; picture_arguments "$name" "$view")
  [ ! -f "examples/$name/pictures.cga" ] || arguments[0]=examples/$name/pictures.cga
  "$gable" render "${arguments[@]}" "$@" -o "$picture"
}
