// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node validate.mjs FILE-OR-FOLDER...: runs the Khronos validator over .glb and .gltf files, tinyusdz over .usda and
// .usdz files, a parser of CityJSON over .city.json files, and web-ifc over .ifc files. Exit status 0 when none has an
// error or a warning, 1 when one has, 3 when nothing was there to look at. Infos and hints are counted only. All are
// read from build/validate, where ./test installs them, or from the folder that GABLE_VALIDATOR names.
import { createRequire } from "node:module";
import { readFileSync, readdirSync, statSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

import { readCity, readIfc } from "./building_models.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const home = process.env.GABLE_VALIDATOR ?? resolve(here, "../../build/validate");
const validator = createRequire(join(home, "package.json"))("gltf-validator");

/** All model files at or below a path, sorted. */
function modelsAt(path) {
  if (!statSync(path).isDirectory()) return [path];
  return readdirSync(path)
    .sort()
    .flatMap((name) => {
      const child = join(path, name);
      if (statSync(child).isDirectory()) return modelsAt(child);
      return /\.(glb|gltf|usda|usdz|city\.json|ifc)$/.test(name) ? [child] : [];
    });
}

const kSeverity = ["error", "warning", "info", "hint"];

/** Prints what is wrong with one file; returns whether it is clean. */
async function isClean(path) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), {
    uri: path,
    maxIssues: 100,
    // Compact files leave tangents to readers, for which the specification names a method (MikkTSpace).
    severityOverrides: { MESH_PRIMITIVE_GENERATED_TANGENT_SPACE: 2 },
    externalResourceFunction: async (uri) =>
      new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
  for (const m of messages.filter((each) => each.severity < 2).slice(0, 20)) {
    console.log(`  ${kSeverity[m.severity]}: ${m.code} ${m.pointer ?? ""} ${m.message}`);
  }
  return numErrors === 0 && numWarnings === 0;
}

let usd = null;
/** tinyusdz, which is made for pages of a browser. */
async function usdReader() {
  if (usd) return usd;
  const folder = join(home, "node_modules/tinyusdz");
  process.type = "renderer";
  globalThis.window = globalThis;
  const { default: make } = await import(pathToFileURL(join(folder, "tinyusdz.js")));
  usd = await make({ wasmBinary: readFileSync(join(folder, "tinyusdz.wasm")) });
  return usd;
}

/** Whether tinyusdz reads a layer or an archive: every mesh has whole triangles of vertices that are there. */
async function isCleanUsd(path) {
  const reader = new (await usdReader()).TinyUSDZLoaderNative();
  const read = reader.loadFromBinary(new Uint8Array(readFileSync(path)), path);
  let wrong = read ? "" : reader.error();
  const meshes = read ? reader.numMeshes() : 0;
  for (let n = 0; n < meshes && !wrong; n++) {
    const { faceVertexIndices: corners, points, primName } = reader.getMesh(n);
    const isWhole = corners.length % 3 === 0 && corners.every((c) => 3 * c < points.length);
    if (!isWhole || !points.every(Number.isFinite)) wrong = `the mesh ${primName} is broken`;
  }
  console.log(`${path}: ${wrong || `${meshes} meshes`}`);
  reader.delete();
  return !wrong;
}

/** Whether a city model or a building model is read, and holds together. */
async function isCleanBuilding(path) {
  const read = await (path.endsWith(".ifc") ? readIfc : readCity)(home, path);
  const kinds = Object.entries(read.elements ?? read.objects).map(([kind, count]) => `${count} ${kind}`);
  console.log(`${path}: ${read.wrong.join("; ") || `${read.triangles} triangles, ${kinds.join(", ")}`}`);
  return read.wrong.length === 0;
}

/** Of any of the formats. */
function isCleanFile(path) {
  if (/\.usd[az]$/.test(path)) return isCleanUsd(path);
  return /\.(city\.json|ifc)$/.test(path) ? isCleanBuilding(path) : isClean(path);
}

const files = process.argv.slice(2).flatMap(modelsAt);
if (files.length === 0) {
  console.error("validate.mjs: no .glb, .gltf, .usda, .usdz, .city.json or .ifc file was given");
  process.exit(3);
}
// tinyusdz is told that it is in a browser, which web-ifc must not believe: it comes last.
files.sort((a, b) => Number(/\.usd[az]$/.test(a)) - Number(/\.usd[az]$/.test(b)));
let clean = true;
for (const file of files) {
  clean = (await isCleanFile(file)) && clean;
}
process.exit(clean ? 0 : 1);
