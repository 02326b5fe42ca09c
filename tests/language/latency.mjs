// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node latency.mjs GABLE FOLDER: how long answers take while one types in a rule file of 5000 lines with
// 40 imports, which tools/large_rules.py makes in FOLDER. Prints the median and the worst of each kind of
// request; fails where the median of all is far above 20 ms, the bound that is meant for a free machine.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Client, edited, positionIn, root, uri } from './client.mjs';

const [program, folder] = process.argv.slice(2);
const LIMIT = Number(process.env.GABLE_LATENCY_LIMIT ?? 150);
execFileSync('python3', ['-B', join(root, 'tools/large_rules.py'), folder]);
const path = join(folder, 'rules/main.cga');
let text = readFileSync(path, 'utf8');
const doc = { textDocument: { uri: uri(path) } };
const client = new Client(program);
await client.initialize(folder);
await client.open(path, text);

const times = new Map();
async function timed(name, method, params) {
  const begin = performance.now();
  const out = await client.request(method, params);
  const list = times.get(name) ?? [];
  list.push(performance.now() - begin);
  times.set(name, list);
  return out;
}

// A rule is written, letter by letter, in the middle of the file; after each letter an editor asks.
const WRITTEN = '\nNewPart(size) --> extrude(size) split(y) { ~3 : xPart3 | 1 : p7.xDetail(2) }\n';
let place = positionIn(text, '\n\n', 1, 400);
for (const letter of WRITTEN) {
  await client.change(path, [{ range: { start: place, end: place }, text: letter }]);
  text = edited(text, [{ range: { start: place, end: place }, newText: letter }]);
  place = letter === '\n' ? { line: place.line + 1, character: 0 } : { ...place, character: place.character + 1 };
  await timed('completion', 'textDocument/completion', { ...doc, position: place });
  await timed('signatures', 'textDocument/signatureHelp', { ...doc, position: place });
}
// Then it is looked at, after the pause.
const begin = performance.now();
await client.next(uri(path));
const pause = performance.now() - begin;
for (let i = 0; i < 12; ++i) {
  const position = positionIn(text, 'extrude(', 3, i * 20);
  const name = positionIn(text, 'xPart', 3, i * 50);
  const inside = { start: { line: i * 300, character: 0 }, end: { line: i * 300 + 60, character: 0 } };
  await timed('hover', 'textDocument/hover', { ...doc, position });
  await timed('definition', 'textDocument/definition', { ...doc, position: name });
  await timed('references', 'textDocument/references', { ...doc, position: name, context: { includeDeclaration: true } });
  await timed('outline', 'textDocument/documentSymbol', doc);
  await timed('folds', 'textDocument/foldingRange', doc);
  await timed('inlay hints', 'textDocument/inlayHint', { ...doc, range: inside });
  await timed('tokens', 'textDocument/semanticTokens/range', { ...doc, range: inside });
  await timed('actions', 'textDocument/codeAction', { ...doc, range: inside, context: { diagnostics: [] } });
  await timed('symbols', 'workspace/symbol', { query: `Part${i}` });
}
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
const all = [...times.values()].flat();
for (const [name, list] of times) {
  console.log(`${name.padEnd(12)} ${median(list).toFixed(1).padStart(7)} ms, worst ${Math.max(...list).toFixed(1)} ms`);
}
console.log(`all          ${median(all).toFixed(1).padStart(7)} ms; mistakes ${pause.toFixed(0)} ms after the last letter`);
assert.equal(await client.end(), 0);
assert.ok(median(all) < LIMIT, `the median is above ${LIMIT} ms`);
