#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# editors/vscode/build.sh [OUT.vsix]: installs the packages of package-lock.json into build/editors and
# packs the extension; build/editors/gable.vsix without an argument.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/lib.sh
root=$PWD
editor_packages
node editors/vscode/pack.mjs "${1:-build/editors/gable.vsix}"
