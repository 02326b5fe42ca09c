// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node tests/wasm/same_bytes.mjs GABLE OUT [NAME...]: derives every example in the module for pages and
// by the program GABLE, and compares the models to the byte. Models that differ stay in OUT.
//
// The words of an example come from tools/examples.sh. A request of a page has no --cut-nested, so
// neither side gets it; places from maps are for the program alone, which reads maps in a process
// of its own.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { openEngine } from '../../apps/gable_wasm/engine.mjs';

const [gable, out, ...wanted] = process.argv.slice(2);
if (!gable || !out) throw new Error('usage: same_bytes.mjs GABLE OUT [NAME...]');
const root = join(import.meta.dirname, '../..');
const built = join(root, 'build/wasm');

const lines = (script, ...words) =>
  execFileSync('bash', ['-c', `. tools/examples.sh; ${script}`, 'bash', ...words], {
    cwd: root,
    encoding: 'utf8',
  })
    .split('\n')
    .filter(Boolean);

function* filesBelow(folder) {
  for (const name of readdirSync(folder)) {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) yield* filesBelow(path);
    else yield path;
  }
}

/** What a page asks for an example, of the words that the program gets. */
function requestOf(words) {
  const rest = words.filter((word) => word !== '--cut-nested');
  const after = (name) => (rest.includes(name) ? rest[rest.indexOf(name) + 1] : undefined);
  const file = rest[0].replace(/^examples\//, '');
  const lot = after('--lot')?.split('x').map(Number);
  const shapes = after('--shapes')?.replace(/^examples\//, '');
  return {
    words: rest,
    request: {
      page: 'test',
      file,
      text: readFileSync(join(root, rest[0]), 'utf8'),
      overlay: {},
      start: '',
      seed: Number(after('--seed') ?? 0),
      attributes: {},
      shapes: shapes ? { file: shapes } : { lot: lot ?? [20, 20] },
      limits: { seconds: 600, shapes: 1e9 },
    },
  };
}

/** The JSON behind the mark of an answer to /api/derive. */
function toldBy(body) {
  const size = new DataView(body.buffer).getUint32(4, true);
  return JSON.parse(new TextDecoder().decode(body.subarray(8, 8 + size)));
}

function deriveIn(engine, request) {
  const start = performance.now();
  const bytes = new TextEncoder().encode(JSON.stringify(request));
  const derived = engine.ask('POST', '/api/derive', [], bytes);
  const seconds = (performance.now() - start) / 1000;
  const told = toldBy(derived.body);
  if (told.end !== 'done') throw new Error(`${request.file}: it ended as '${told.end}'`);
  const model = engine.ask('GET', '/api/export', [
    ['derivation', String(told.derivation)],
    ['format', 'glb'],
    ['page', 'test'],
  ]);
  if (model.status !== 200) throw new Error(new TextDecoder().decode(model.body));
  return { model: model.body, seconds, shapes: told.stats.shapes };
}

const { default: makeGable } = await import(join(built, 'gable.mjs'));
const wasm = readFileSync(join(built, 'gable.wasm'));
const project = [...filesBelow(join(root, 'examples'))]
  .filter((path) => !/-\w+\.png$|\.osm/.test(path))
  .map((path) => [`/project/${relative(join(root, 'examples'), path)}`, readFileSync(path)]);
const names = wanted.length ? wanted : lines('example_names; park_names');
mkdirSync(out, { recursive: true });

let differ = 0;
for (const name of names) {
  const { words, request } = requestOf(lines('derive_arguments "$1"', name));
  const stem = join(out, name.replaceAll('/', '-'));
  const start = performance.now();
  execFileSync(gable, ['generate', ...words, '-o', `${stem}.glb`], { cwd: root, stdio: 'pipe' });
  const natively = (performance.now() - start) / 1000;
  // A module for each: its memory does not shrink.
  const engine = await openEngine(makeGable, wasm, project);
  const { model, seconds, shapes } = deriveIn(engine, request);
  const same = readFileSync(`${stem}.glb`).equals(model);
  if (same) rmSync(`${stem}.glb`);
  else writeFileSync(`${stem}.wasm.glb`, model);
  if (!same) ++differ;
  console.log(
    `${same ? 'same' : 'DIFFERS'}  ${name}: ${model.length} bytes, ${shapes} shapes, derived in ` +
      `${seconds.toFixed(2)} s; the program takes ${natively.toFixed(2)} s with writing`,
  );
}
console.log(`${names.length - differ} of ${names.length} examples give the bytes of the program`);
process.exit(differ ? 1 : 0);
