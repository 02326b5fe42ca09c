#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# make_assets.sh [GABLE]: derives each model of models.cga on a lot and prepares it as an asset. The volume is what a scope
# shows: width, height and depth of the lot, from its north-western corner. What stands out beyond it stays out.
set -euo pipefail
cd "$(dirname "$0")"
gable=${1:-../../build/release/gable}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# prepare RULE LOT PIVOT SIZE ARGUMENT...
prepare() {
  local rule=$1 lot=$2 pivot=$3 size=$4
  shift 4
  [ -f "$work/$rule.glb" ] || "$gable" generate models.cga --start "$rule" --lot "$lot" --seed 3 -o "$work/$rule.glb"
  "$gable" asset prepare "$work/$rule.glb" --pivot "$pivot" --size "$size" --name "$rule" "$@"
}

# The facades' fronts are their lots' southern edges, a metre before the northern ones.
while read -r rule width height; do
  prepare "$rule" "${width}x1" 0,0,-1 "$width,$height,1" -o "assets/$rule.glb"
done <<'LIST'
Quoin 1.2 0.7
Window 3.3 3.6
Balcony 3.3 3.6
GroundWindow 3.3 4.6
GroundDoor 3.3 4.6
Arcade 2 3
LIST

# What lies on top or around looks to the north.
prepare Stone 1x1 0,0,-1 1,1,1 -o assets/Stone.glb
prepare Floor 2x2 0,0,-2 2,0.1,2 -o assets/Floor.glb
prepare Plinth 2.5x1.2 0,0,-1.2 2.5,1,1.2 -o assets/Plinth.glb
prepare PlinthCorner 1.2x1.2 0,0,-1.2 1.2,1,1.2 -o assets/PlinthCorner.glb
prepare Cornice 0.7x1 0,0,-1 0.7,0.8,1 -o assets/Cornice.glb
prepare CorniceCorner 1x1 0,0,-1 1,0.8,1 -o assets/CorniceCorner.glb
prepare RoofEdge 2.4x4 0,0,-4 2.4,2.5,4 -o assets/RoofEdge.glb
# A quarter of a hipped roof.
prepare RoofCorner 8x8 4,0,-8 4,2.5,4 -o assets/RoofCorner.glb
prepare Post 0.5x0.5 0,0,-0.5 0.5,1.15,0.5 -o assets/Post.glb
prepare Balustrade 2x0.3 0,0,-0.3 2,0.9,0.3 -o assets/Balustrade.glb
# The same turned by a quarter, for what runs along z.
prepare Balustrade 2x0.3 2,0,-0.3 0.3,0.9,2 --rotate 0,90,0 -o assets/BalustradeSide.glb
