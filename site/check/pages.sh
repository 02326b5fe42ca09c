#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Makes the site with the model of one example, and looks at it: pages.sh GABLE FOLDER
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/examples.sh
gable=$1 folder=$2
mkdir -p "$folder/models"
generate_example "$gable" grove "$folder/models/grove.glb" --vertices compact --quiet
cd site
npm run --silent build -- --root .. --out "$folder/pages" --models "$folder/models"
npm run --silent check -- "$folder/pages"
