#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/worlds.sh [SEEDS]: derives the example worlds with many seeds (200) and looks for crashes, for
# buildings that reach into streets or into each other, and for houses that no street leads to. Takes
# minutes; `./test` does the same with three seeds.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset dev > /dev/null
ninja -C build/dev test_worlds
GABLE_SEEDS=${1:-200} build/dev/test_worlds
