#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Builds the playground: tools/playground.sh [FOLDER], build/playground where none is named. That is the
# studio's page with the engine as WebAssembly, as static files for any server of files. With --engine only the
# engine is built, build/wasm/gable.wasm. Installs what is missing: the compiler is emscripten, 840 MB.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

sources=build/wasm-sources

# The libraries of pictures are compiled from the sources of the very packages that the native program uses, so both
# write the same bytes.
fetch_sources() {
  local suite name archive
  local lists=$root/$sources/apt
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  mkdir -p "$lists/state/lists/partial" "$lists/cache/archives/partial"
  printf 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s main\n' \
    "http://deb.debian.org/debian $suite" "http://deb.debian.org/debian-security $suite-security" >"$lists/sources.list"
  local options=(-o "Dir::Etc::sourcelist=$lists/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::Cache=$lists/cache"
    -o "Dir::State::Lists=$lists/state/lists" -o APT::Sandbox::User="$(id -un)")
  apt-get "${options[@]}" update
  (cd "$lists" && apt-get "${options[@]}" source --tar-only --download-only zlib libpng1.6 libjpeg-turbo)
  for name in zlib libpng libjpeg-turbo; do
    archive=$(find "$lists" -maxdepth 1 -name "${name}*.orig.tar.*" | sort | tail -n 1)
    rm -rf "${sources:?}/$name" && mkdir -p "$sources/$name"
    tar xf "$archive" -C "$sources/$name" --strip-components=1
  done
  rm -rf "$lists"
}

build_engine() {
  local needed
  mapfile -t needed < <(packages playground)
  install "${needed[@]}"
  if [ ! -f "$sources/libjpeg-turbo/jpeglib.h" ]; then
    step "Fetching the sources of zlib, libpng and libjpeg" wasm-sources.log fetch_sources || exit 1
  fi
  build wasm gable_wasm || exit 1
}

pack_engine() { python3 -B tools/pack_bytes.py build/wasm/gable.wasm build/wasm/gable.wasm.lzma; }

build_pages() { (cd studio && npm run --silent playground -- --outDir "$1"); }

build_playground() {
  local folder
  folder=$(realpath -m "${1:-build/playground}")
  if [ -e "$folder" ] && [ ! -f "$folder/examples.pack" ] && [ -n "$(ls -A "$folder")" ]; then
    die "$folder has other files; name a folder that is empty or that has a playground"
  fi
  build_engine
  node_usable || install nodejs npm
  page_packages || exit 1
  step "Packing the engine" playground-pack.log pack_engine || exit 1
  step "Building the page" playground.log build_pages "$folder" || exit 1
  python3 -B tools/pack_examples.py "$folder/examples.pack"
  cp cmake/debian/copyright "$folder/LICENSES.txt"
  say "$folder/index.html, $(gzipped "$folder") bytes compressed"
}

case ${1:-} in
  -h | --help) sed -n '/^# Builds/,/^set/{s/^# //p}' "$0" ;;
  --engine) build_engine ;;
  *) build_playground "$@" ;;
esac
