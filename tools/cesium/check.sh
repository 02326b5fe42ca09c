#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Tiles in Cesium: check.sh TILES [PICTURE]. Installs Cesium into build/cesium, and runs check.mjs.
# Not part of ./test, as Cesium is large.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
tiles=$(realpath "$1")
picture=${2:+$(realpath "$2")}
home=$here/../../build/cesium
mkdir -p "$home"
if ! cmp -s "$here/package-lock.json" "$home/installed.json"; then
  cp "$here/package.json" "$here/package-lock.json" "$home/"
  (cd "$home" && npm ci --no-audit --no-fund --loglevel=error)
  cp "$home/package-lock.json" "$home/installed.json"
fi
cd "$home"
exec node "$here/check.mjs" "$tiles" ${picture:+"$picture"}
