#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/determinism.sh [EXAMPLE...]: generates every example with g++ and clang++, as `dev` and as
# `release`, with 1, 2 and 4 threads, and compares the bytes of the models and the statistics.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh
. tools/examples.sh

home=build/determinism
command -v clang++ >/dev/null || install clang
examples=("$@")
[ ${#examples[@]} -gt 0 ] || mapfile -t examples < <(example_names)
[ ${#examples[@]} -gt 0 ] || die "There are no examples."

configurations=()
for compiler in g++ clang++; do
  for preset in dev release; do
    name=$compiler-$preset
    configurations+=("$name")
    if [ ! -f "$home/$name/build.ninja" ]; then
      step "Configuring $name" "configure-$name.log" cmake --preset "$preset" -S . -B "$home/$name" \
        -D CMAKE_CXX_COMPILER="$compiler" -D GABLE_TESTS=OFF || exit 1
    fi
    step "Building $name" "build-$name.log" ninja -C "$home/$name" -j "$(jobs)" gable || exit 1
  done
done

# Statistics without what may differ: times and memory.
timeless() {
  python3 -c 'import json, sys
stats = json.load(open(sys.argv[1]))
stats.pop("seconds", None), stats.pop("peakBytes", None)
print(json.dumps(stats, sort_keys=True))' "$1"
}

status=0
for example in "${examples[@]}"; do
  sums=()
  for name in "${configurations[@]}"; do
    for threads in 1 2 4; do
      made=$home/models/$name-$threads
      mkdir -p "$made"
      generate_example "$home/$name/gable" "$example" "$made/$example.glb" --jobs "$threads" \
        --stats "$made/$example.json" >"$made/$example.log" 2>&1 || {
        tail -n 20 "$made/$example.log" >&2
        die "$name could not generate $example"
      }
      sum=$(cat "$made/$example.glb" <(timeless "$made/$example.json") | sha256sum | cut -c 1-16)
      sums+=("$sum $name, $threads threads")
    done
  done
  distinct=$(printf '%s\n' "${sums[@]}" | cut -d ' ' -f 1 | sort -u | wc -l)
  if [ "$distinct" = 1 ]; then
    say "$example: ${#sums[@]} runs, one result (${sums[0]%% *})"
  else
    say "${red}$example: $distinct different results$plain"
    printf '  %s\n' "${sums[@]}"
    status=1
  fi
done
exit $status
