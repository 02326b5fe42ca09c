# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Tiles in Cesium: those of the Haussmann example, plain and compressed, or those in the folder GABLE_TILES, load without
# a complaint, and what is picked tells its attributes.
node_usable || install nodejs npm
install chromium
install_cesium() {
  mkdir -p "$root/build/cesium"
  cp tests/partners/cesium/package.json tests/partners/cesium/package-lock.json "$root/build/cesium/"
  (cd "$root/build/cesium" && npm ci --no-audit --no-fund --loglevel=error) &&
    cp "$root/build/cesium/package-lock.json" "$root/build/cesium/installed.json"
}
cmp -s tests/partners/cesium/package-lock.json build/cesium/installed.json ||
  step "Installing Cesium" cesium-packages.log install_cesium || return 1

# shown FOLDER NAME: loads tiles and draws them.
shown() {
  (cd build/cesium && step "Tiles in Cesium: $2" "cesium-$2.log" timeout 600 node "$root/tests/partners/cesium/check.mjs" \
    "$1" "$out/$2.png") || return 1
  cat "$root/build/log/cesium-$2.log"
}

if [ -n "${GABLE_TILES:-}" ]; then
  shown "$(realpath "$GABLE_TILES")" tiles || return 1
else
  for kind in plain compressed; do
    options=()
    [ "$kind" = plain ] || options=(--compress)
    "$gable" tiles examples/haussmann/haussmann.cga --shapes examples/haussmann/buildings.geojson -o "$out/$kind/" \
      -q ${options[@]+"${options[@]}"} || return 1
    shown "$out/$kind" "$kind" || return 1
  done
fi
