#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/language_edits.sh [EDITS [SEEDS]]: random edits in every notation, after each of which the language service that
# has seen them all must say what a fresh one says. 10000 edits of three seeds without arguments.
set -euo pipefail
cd "$(dirname "$0")/.."
edits=${1:-10000}
for seed in $(seq 1 "${2:-3}"); do
  GABLE_EDITS=$edits GABLE_EDITS_SEED=$seed build/dev/test_lsp --gtest_filter='*Edits*' --gtest_brief=1
done
