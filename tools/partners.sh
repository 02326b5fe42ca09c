#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Tests Gable with the large programs that its users work in: tools/partners.sh [PARTNER...], all of them
# where none is named. Each is installed where it is missing. tests/partners/PARTNER.sh holds one's steps;
# it gets the program gable and a folder for what it makes.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

gable=${GABLE:-$root/build/dev/gable}
[ -x "$gable" ] || build dev gable || die "gable is not built"

names=("$@")
[ "${#names[@]}" -gt 0 ] || mapfile -t names < <(cd tests/partners && ls -- *.sh | sed 's/\.sh$//')
failed=0
for name in "${names[@]}"; do
  script=tests/partners/$name.sh
  [ -f "$script" ] || die "There is no partner '$name'; there are: $(cd tests/partners && ls | sed 's/\.sh$//' | xargs)"
  out=$root/build/partners/$name
  rm -rf "$out" && mkdir -p "$out"
  start=$SECONDS status=0
  (. "$script") || status=$?
  if [ "$status" = 0 ]; then
    say "$name: passed, $(spell $((SECONDS - start))), what it made is in ${out#"$root"/}"
  else
    say "$name: failed, its output is above or in ${out#"$root"/}"
    failed=$((failed + 1))
  fi
done
say "$((${#names[@]} - failed)) passed, $failed failed"
[ "$failed" = 0 ]
