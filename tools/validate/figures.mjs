// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node figures.mjs FILE...: what readers of others find in .city.json, .ifc and .usda files, a JSON object
// a line.
import { readFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

import { readCity, readIfc } from "./building_models.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const home = process.env.GABLE_VALIDATOR ?? resolve(here, "../../build/validate");

/** What three.js shows of a layer: meshes and their triangles. */
async function readUsd(path) {
  const loader = pathToFileURL(resolve(home, "node_modules/three/examples/jsm/loaders/USDLoader.js"));
  const { USDLoader } = await import(loader);
  const out = { meshes: 0, triangles: 0, wrong: [] };
  new USDLoader().parse(readFileSync(path, "utf8")).traverse((o) => {
    if (!o.isMesh) return;
    ++out.meshes;
    out.triangles += (o.geometry.index ?? o.geometry.attributes.position).count / 3;
  });
  return out;
}

function read(path) {
  if (path.endsWith(".ifc")) return readIfc(home, path);
  return path.endsWith(".usda") ? readUsd(path) : readCity(home, path);
}

for (const path of process.argv.slice(2)) console.log(JSON.stringify(await read(path)));
