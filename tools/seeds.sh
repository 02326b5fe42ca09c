#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/seeds.sh [castle|park] [SEEDS]: the tests of an example that look at many seeds, on so many of them
# (castle, 200; park is the example gardens). The suite runs a short form. Needs a build in build/dev.
set -euo pipefail
cd "$(dirname "$0")/.."
example=${1:-castle} seeds=${2:-200}
program=build/dev/test_$example
[ -x "$program" ] || { echo "there is no $program: run ninja -C build/dev test_$example" >&2; exit 2; }
GABLE_SEEDS=$seeds exec "$program" --gtest_brief=1
