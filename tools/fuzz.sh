#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/fuzz.sh [SECONDS] [TARGET...]: runs every fuzz target, or those named (rules, region, ...), for
# so many seconds each (30). Seeds and earlier finds lie in fuzz/corpus/TARGET, words in fuzz/TARGET.dict;
# new inputs that reach new code are kept in build/fuzz/corpus. What stops a target is minimised into
# build/fuzz/found: copy it to fuzz/corpus/TARGET, mend the cause, and ctest replays it from then on.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

seconds=30
if [[ ${1:-} =~ ^[0-9]+$ ]]; then seconds=$1 && shift; fi
targets=("$@")
if [ ${#targets[@]} = 0 ]; then
  for source in fuzz/fuzz_*.cpp; do
    name=$(basename "$source" .cpp)
    targets+=("${name#fuzz_}")
  done
fi

mapfile -t needed < <(packages run fuzz)
install "${needed[@]}"
build fuzz "${targets[@]/#/fuzz_}" || exit 1

export ASAN_OPTIONS=detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1

# fuzz TARGET: returns the status of the fuzzer.
fuzz() {
  local target=$1 dictionary=()
  mkdir -p "build/fuzz/corpus/$target" "build/fuzz/found/$target"
  [ ! -f "fuzz/$target.dict" ] || dictionary=(-dict="fuzz/$target.dict")
  "build/fuzz/fuzz_$target" ${dictionary[@]+"${dictionary[@]}"} -max_total_time="$seconds" \
    -timeout=10 -rss_limit_mb=4096 -max_len="${FUZZ_MAX_LEN:-16384}" -print_final_stats=1 \
    -artifact_prefix="build/fuzz/found/$target/" \
    "build/fuzz/corpus/$target" "fuzz/corpus/$target"
}

found=0
for target in "${targets[@]}"; do
  if step "Fuzzing $target" "fuzz-$target.log" fuzz "$target"; then
    say "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "build/log/fuzz-$target.log") runs, nothing found"
    continue
  fi
  found=$((found + 1))
  find=$(ls -t "build/fuzz/found/$target" | grep -v '^smallest$' | head -n 1)
  if [ -n "$find" ]; then
    "build/fuzz/fuzz_$target" -minimize_crash=1 -max_total_time=60 \
      -timeout=10 -rss_limit_mb=4096 \
      -exact_artifact_path="build/fuzz/found/$target/smallest" "build/fuzz/found/$target/$find" \
      >"build/log/fuzz-$target-smallest.log" 2>&1 || true
    say "${red}$target: build/fuzz/found/$target/$find$plain"
  fi
done
[ "$found" = 0 ]
