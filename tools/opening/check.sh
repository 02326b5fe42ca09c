#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# How long other programs take to open models: check.sh MODEL.glb... Opens each in Blender, without a window,
# and in a page with three.js in a headless Chromium, and prints a line for each. What is not installed
# is passed over. Fails where a program fails, or takes longer than a file may: 60 s in Blender, 10 s in
# the page (GABLE_BLENDER_SECONDS, GABLE_THREE_SECONDS). Not part of ./test: these programs are large.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
home=$here/../../build/opening
failed=0

install_three() {
  mkdir -p "$home"
  if ! cmp -s "$here/package-lock.json" "$home/installed.json"; then
    cp "$here/package.json" "$here/package-lock.json" "$home/"
    (cd "$home" && npm ci --no-audit --no-fund --loglevel=error)
    cp "$home/package-lock.json" "$home/installed.json"
  fi
}

# judge FILE MOST LINE: the third word of the line is the seconds.
judge() {
  local seconds=${3#* }
  echo "$1: $3"
  if ! awk -v s="${seconds%% *}" -v most="$2" 'BEGIN { exit !(s ~ /^[0-9.]+$/ && s + 0 <= most + 0) }'; then
    echo "$1: more than $2 s, or not opened" >&2
    failed=1
  fi
}

in_blender() {
  local line
  line=$(timeout 600 blender -b --factory-startup --python-exit-code 1 -P "$here/blender.py" -- "$1" 2>&1 |
    grep '^blender ' | tail -1) || true
  judge "$1" "${GABLE_BLENDER_SECONDS:-60}" "${line:-blender none}"
}

in_three() {
  local line
  line=$(cd "$home" && timeout 600 node "$here/three.mjs" "$1" 2>&1 | tail -1) || true
  judge "$1" "${GABLE_THREE_SECONDS:-10}" "${line:-three.js none}"
}

[ $# -gt 0 ] || { echo "usage: check.sh MODEL.glb..." >&2; exit 2; }
if command -v node >/dev/null && command -v "${CHROMIUM:-chromium}" >/dev/null; then install_three; fi
for model in "$@"; do
  model=$(realpath "$model")
  if command -v blender >/dev/null; then in_blender "$model"; fi
  if [ -d "$home/node_modules" ]; then in_three "$model"; fi
done
exit $failed
