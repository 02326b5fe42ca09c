// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node examples.mjs GABLE: in every rule file of the examples the language server finds what `gable check`
// finds, and answers every question at every seventh word.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { Client, root, uri } from './client.mjs';

const program = process.argv[2];
function filesBelow(folder) {
  return readdirSync(folder)
    .sort()
    .flatMap((name) => {
      const path = join(folder, name);
      if (statSync(path).isDirectory()) return filesBelow(path);
      return /\.(cga|park|gbbg|grammar|pg3d)$/.test(name) ? [path] : [];
    });
}

/** What `gable check` says of a file itself: code and place in units of UTF-16, as the server counts. */
function checked(path, lines) {
  let out;
  try {
    out = execFileSync(program, ['check', '--json', path], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
  } catch (e) {
    out = e.stdout;
  }
  const all = JSON.parse(out);
  const name = path.split('/').at(-1);
  return all.diagnostics
    .filter((d) => !d.file || d.file.split('/').at(-1) === name)
    .map((d) => {
      const line = Buffer.from(lines[(d.line ?? 1) - 1] ?? '');
      return `${d.code} ${(d.line ?? 1) - 1}:${line.subarray(0, (d.column ?? 1) - 1).toString().length}`;
    });
}

const client = new Client(program);
await client.initialize(join(root, 'examples'));
let files = 0;
let questions = 0;
for (const path of filesBelow(join(root, 'examples'))) {
  const text = readFileSync(path, 'utf8');
  const lines = text.split('\n');
  const told = await client.open(path, text);
  const found = told.diagnostics.map((d) => `${d.code} ${d.range.start.line}:${d.range.start.character}`);
  assert.deepEqual(found, checked(path, lines), path);
  const doc = { textDocument: { uri: uri(path) } };
  const symbols = await client.request('textDocument/documentSymbol', doc);
  assert.ok(symbols.length > 0, `${path} has no outline`);
  await client.request('textDocument/semanticTokens/full', doc);
  await client.request('textDocument/foldingRange', doc);
  await client.request('textDocument/documentColor', doc);
  await client.request('textDocument/formatting', { ...doc, options: {} });
  const words = lines.flatMap((l, line) => [...l.matchAll(/\w+/g)].map((m) => ({ line, character: m.index + 1 })));
  const asked = words.filter((_, i) => i % 7 === 0).flatMap((position) =>
    ['completion', 'signatureHelp', 'hover', 'definition', 'documentHighlight', 'prepareRename'].map((m) =>
      client.request(`textDocument/${m}`, { ...doc, position }),
    ),
  );
  questions += (await Promise.all(asked)).length;
  ++files;
  await client.notify('textDocument/didClose', doc);
}
assert.equal(await client.end(), 0);
console.log(`${files} files, ${questions} questions`);
