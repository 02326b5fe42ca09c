// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node figures.mjs FILE...: what readers of others find in .city.json and .ifc files, a JSON object a line.
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";

import { readCity, readIfc } from "./building_models.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const home = process.env.GABLE_VALIDATOR ?? resolve(here, "../../build/validate");
for (const path of process.argv.slice(2)) {
  console.log(JSON.stringify(await (path.endsWith(".ifc") ? readIfc(home, path) : readCity(home, path))));
}
