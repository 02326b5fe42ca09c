#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/seeds.sh [castle|park|suburb|town] [SEEDS]: the tests of an example that look at many seeds, on so many of them
# (castle, 200; park is the example gardens). The suite runs a short form. Needs a build in build/dev.
# tools/seeds.sh solids SEEDS [EXAMPLE...]: what stands in the air, in one plane or in something else, of all examples
# or some. What the suite does not see on its one or two seeds fails.
set -euo pipefail
cd "$(dirname "$0")/.."
example=${1:-castle} seeds=${2:-200} filter='*'
case $example in
  castle | park) program=test_$example ;;
  suburb | town) program=test_worlds filter="*the${example^}*" ;;
  solids)
    program=test_solids
    if [ $# -gt 2 ]; then filter=$(printf '*/%s:' "${@:3}"); fi
    ;;
  *) echo "there is no example '$example' with many seeds: castle, park, suburb, town, solids" >&2 && exit 2 ;;
esac
[ -x "build/dev/$program" ] || { echo "there is no build/dev/$program: run ninja -C build/dev $program" >&2; exit 2; }
GABLE_SEEDS=$seeds exec "build/dev/$program" --gtest_brief=1 --gtest_filter="$filter"
