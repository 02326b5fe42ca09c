# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# The add-on in Blender: installed from its zip, enabled, used, saved and rendered without a screen; then with
# one, where the panel is drawn and Esc is pressed.
command -v blender >/dev/null || install blender
command -v xvfb-run >/dev/null || install xvfb xauth
python3 -B tools/pack_blender.py "$out/gable_blender.zip" >/dev/null
# Settings of its own: those of the person who runs this stay as they are.
export BLENDER_USER_CONFIG=$out/config BLENDER_USER_SCRIPTS=$out/scripts BLENDER_USER_EXTENSIONS=$out/extensions
mkdir -p "$BLENDER_USER_CONFIG" "$BLENDER_USER_SCRIPTS" "$BLENDER_USER_EXTENSIONS"
step "Blender without a screen" blender.log timeout 600 blender -b --factory-startup --python-exit-code 1 \
  --python tests/blender/blender_test.py -- "$out/gable_blender.zip" "$gable" "$out" || return 1
grep -h "triangles in" "$root/build/log/blender.log" || true
for profile in blender godot unity unreal; do
  "$gable" generate tests/partners/games/yard.cga --shapes tests/partners/games/lots.geojson -o "$out/$profile.glb" \
    --for "$profile" -q || return 1
done
step "Blender imports models for game engines" blender-games.log timeout 300 blender -b --factory-startup --python-exit-code 1 \
  --python tests/partners/games/import.py -- "$out" || return 1
grep -h "^import:" "$root/build/log/blender-games.log" || true
step "Blender with a screen" blender-window.log timeout 300 xvfb-run -a -s "-screen 0 1280x800x24" \
  blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 --python tests/blender/window_test.py -- \
  "$out/gable_blender.zip" "$gable" "$out" || return 1
grep -q "^window: passed" "$root/build/log/blender-window.log"
