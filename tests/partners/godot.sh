# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Godot 3: its editor imports models without a screen, rays and balls fall on the bodies that it makes of collision
# nodes, and what it draws is a picture.
command -v godot3-server >/dev/null || install godot3-server
command -v godot3-runner >/dev/null || install godot3-runner
command -v xvfb-run >/dev/null || install xvfb xauth
games=$root/tests/partners/games
# Settings of its own: those of the person who runs this stay as they are.
export HOME=$out/home LANG=en_US.UTF-8
mkdir -p "$HOME"

# project NAME: a folder with the project of the tests.
project() {
  mkdir -p "$out/$1"
  cp tests/partners/godot/* "$out/$1/"
}

# imported NAME: whether the editor has read model.glb. It may wait for itself when it is to quit, so it is ended.
imported() {
  godot3-server --path "$out/$1" --editor &
  local editor=$! tries=0
  until compgen -G "$out/$1/.import/model.glb-*.md5" >/dev/null || [ $((tries++)) = 240 ]; do sleep 0.5; done
  kill "$editor"
  wait "$editor" || true
  compgen -G "$out/$1/.import/model.glb-*.scn" >/dev/null
}

# stops NAME NEAR RAYS OPTION...: the yard and its houses, imported and asked by rays.
stops() {
  local name=$1 near=$2 rays=$3
  shift 3
  project "$name"
  "$gable" generate "$games/yard.cga" --shapes "$games/lots.geojson" -o "$out/$name/model.glb" --for godot "$@" || return 1
  step "Godot imports: $name" "godot-$name-import.log" imported "$name" || return 1
  GABLE_RAYS=$rays GABLE_NEAR=$near step "Godot stops rays: $name" "godot-$name.log" timeout 120 \
    godot3-server --path "$out/$name" -s check.gd || return 1
  grep -h "^check:" "$root/build/log/godot-$name.log"
}

# The ridges of the houses, the lawn of the yard, its wall, and beside all of them.
stops mesh 0.01 "10,-5,11.887;50,-5,11.887;95,-15,0;80.5,-15,4;70,-5,-100" || return 1
# A hull covers the yard, and a house up to its ridge; a box its eaves as well. Bullet's rays are not nearer than this on
# large convex shapes.
stops hull 0.4 "10,-5,11.887;1,-5,9.6;95,-15,4;70,-5,-100" --collision hull || return 1
stops box 0.4 "10,-5,11.887;1,-1,11.887;95,-15,4;70,-5,-100" --collision box || return 1

project picture
"$gable" generate examples/castle/castle.cga $(sed '/^#/d' examples/castle/generate.args 2>/dev/null) \
  -o "$out/picture/model.glb" --for godot || return 1
step "Godot imports the castle" godot-picture-import.log imported picture || return 1
GABLE_SHOT=$out/castle.png GABLE_EYE=${GABLE_EYE:-207,50,-108} GABLE_TARGET=${GABLE_TARGET:-229,9,-205} \
  step "Godot draws the castle" godot-picture.log timeout 300 xvfb-run -a -s "-screen 0 1280x720x24" \
  godot3-runner --path "$out/picture" --audio-driver Dummy --resolution 1280x720 || return 1
[ -s "$out/castle.png" ]
