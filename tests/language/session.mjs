// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node session.mjs GABLE FOLDER: a whole session with `gable lsp`, as an editor has it: opening,
// typing, all requests, and the end. FOLDER is made anew for the project.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Client, edited, positionIn, rpc, uri } from './client.mjs';

const [program, folder] = process.argv.slice(2);
rmSync(folder, { recursive: true, force: true });
mkdirSync(join(folder, 'rules'), { recursive: true });
mkdirSync(join(folder, 'assets'), { recursive: true });
const HOUSE = `import w : "rules/window.cga"
// How high it is.
@Range(min=3, max=30)
attr height = 9
Lot --> extrude(height) comp(f) { side : Facade | top : Roof }
Facade --> split(y) { ~3 : w.Window(2) }*
Roof --> color("#aa5533") roofGable(30) X.
`;
const WINDOW = 'Window(depth) --> offset(-0.2) Glass\nGlass --> X.\n';
const house = join(folder, 'rules/house.cga');
const window = join(folder, 'rules/window.cga');
writeFileSync(house, HOUSE);
writeFileSync(window, WINDOW);
writeFileSync(join(folder, 'assets/tree.obj'), 'v 0 0 0\n');
writeFileSync(join(folder, 'assets/wall.png'), '');
const stamps = [house, window].map((f) => statSync(f).mtimeMs);

const client = new Client(program);
const doc = { textDocument: { uri: uri(house) } };
let text = HOUSE;
const at = (part, offset = 0, nth = 0) => ({ ...doc, position: positionIn(text, part, offset, nth) });

async function type(part, offset, insert) {
  const p = positionIn(text, part, offset);
  await client.change(house, [{ range: { start: p, end: p }, text: insert }]);
  text = edited(text, [{ range: { start: p, end: p }, newText: insert }]);
}

// --- Hello ---
const hello = await client.initialize(folder);
assert.equal(hello.serverInfo.name, 'gable');
assert.equal(hello.capabilities.textDocumentSync.change, 2);
const legend = hello.capabilities.semanticTokensProvider.legend.tokenTypes;

// --- Mistakes while typing ---
assert.deepEqual((await client.open(house, HOUSE)).diagnostics, []);
let told = client.next(uri(house));
await type('extrude(height', 'extrude(heigh'.length, 'q');
told = await told;
assert.equal(told.diagnostics[0].code, 'unknown-name');
assert.equal(told.version, 2);
const actions = await client.request('textDocument/codeAction', {
  ...doc,
  range: told.diagnostics[0].range,
  context: { diagnostics: told.diagnostics },
});
assert.equal(actions[0].diagnostics.length, 1);
const mended = actions[0].edit.changes[uri(house)];
assert.equal(edited(text, mended), HOUSE);
told = client.next(uri(house));
await client.change(house, mended.map((e) => ({ range: e.range, text: e.newText })));
text = HOUSE;
assert.deepEqual((await told).diagnostics, []);

// --- Completion, signatures, hover ---
await type('Lot -->', 7, ' spl');
let items = (await client.request('textDocument/completion', at('spl', 3))).items;
const split = items.find((i) => i.label === 'split');
assert.match(split.textEdit.newText, /^split\(\$\{1\|x,y,z\|\}\)/);
const resolved = await client.request('completionItem/resolve', split);
assert.match(resolved.documentation.value, /divides a shape along an axis/);
const p = positionIn(text, ' spl');
await client.change(house, [{ range: { start: p, end: { ...p, character: p.character + 4 } }, text: '' }]);
text = HOUSE;
items = (await client.request('textDocument/completion', at('w.Window', 2))).items;
assert.ok(items.some((i) => i.label === 'w.Window'));
await type('Roof -->', 8, ' i("")');
items = (await client.request('textDocument/completion', at('i("', 3))).items;
assert.deepEqual(items.map((i) => i.label), ['tree.obj']);
await client.change(house, [{ text: HOUSE }]);
text = HOUSE;
await type('Roof -->', 8, ' texture("")');
items = (await client.request('textDocument/completion', at('texture("', 9))).items;
assert.deepEqual(items.map((i) => i.label), ['wall.png']);
const pictured = await client.request('completionItem/resolve', items[0]);
assert.equal(pictured.documentation.value, `![](${uri(join(folder, 'assets/wall.png'))})`);
await client.change(house, [{ text: HOUSE }]);
text = HOUSE;
const help = await client.request('textDocument/signatureHelp', at('w.Window(2', 9));
assert.equal(help.signatures[0].label, 'Window(depth)');
assert.match((await client.request('textDocument/hover', at('extrude', 2))).contents.value, /world\.up/);
assert.match((await client.request('textDocument/hover', at('(height', 3))).contents.value, /How high it is/);

// --- Names ---
const definition = await client.request('textDocument/definition', at('w.Window', 4));
assert.deepEqual(definition, [
  { uri: uri(window), range: { start: { line: 0, character: 0 }, end: { line: 0, character: 6 } } },
]);
const references = await client.request('textDocument/references', {
  ...at('height', 2),
  context: { includeDeclaration: true },
});
assert.equal(references.length, 2);
assert.ok(await client.request('textDocument/prepareRename', at('w.Window', 4)));
assert.equal(await client.request('textDocument/prepareRename', at('extrude', 2)), null);
const renaming = await client.request('textDocument/rename', { ...at('w.Window', 4), newName: 'Opening' });
assert.match(edited(text, renaming.changes[uri(house)]), /w\.Opening\(2\)/);
assert.match(edited(WINDOW, renaming.changes[uri(window)]), /^Opening\(depth\)/);
await assert.rejects(client.request('textDocument/rename', { ...at('w.Window', 4), newName: 'Glass' }), /already/);
assert.equal((await client.request('textDocument/documentHighlight', at('Roof', 1))).length, 2);

// --- The whole text ---
const symbols = await client.request('textDocument/documentSymbol', doc);
assert.deepEqual(symbols.map((s) => s.name), ['w', 'height', 'Lot', 'Facade', 'Roof']);
assert.equal(symbols[1].range.start.line, 2);
const found = await client.request('workspace/symbol', { query: 'glass' });
assert.deepEqual(found.map((s) => [s.name, s.location.uri]), [['Glass', uri(window)]]);
const { data } = await client.request('textDocument/semanticTokens/full', doc);
assert.equal(data.length % 5, 0);
assert.ok(data.some((kind, i) => i % 5 === 3 && legend[kind] === 'method'));
const colors = await client.request('textDocument/documentColor', doc);
assert.equal(colors.length, 1);
assert.equal(colors[0].color.red, 0xaa / 255);
const written = await client.request('textDocument/colorPresentation', { ...doc, color: { red: 1, green: 0, blue: 0, alpha: 1 }, range: colors[0].range });
assert.equal(written[0].label, '#ff0000');
assert.ok((await client.request('textDocument/foldingRange', doc)).length === 0);
const hints = await client.request('textDocument/inlayHint', {
  ...doc,
  range: { start: { line: 0, character: 0 }, end: { line: 99, character: 0 } },
});
assert.ok(Array.isArray(hints));
await type('Lot -->', 3, '    ');
const layout = await client.request('textDocument/formatting', { ...doc, options: { tabSize: 2, insertSpaces: true } });
assert.match(edited(text, layout), /^Lot -->/m);

// --- Beside the way ---
await assert.rejects(client.request('textDocument/nonsense', {}), (e) => e.code === -32601);
const source = new rpc.CancellationTokenSource();
const many = [];
for (let i = 0; i < 50; ++i) many.push(client.request('workspace/symbol', { query: '' }, source.token));
source.cancel();
const ends = await Promise.allSettled(many);
for (const e of ends) assert.ok(e.status === 'fulfilled' || e.reason.code === -32800);
const untitled = { uri: 'untitled:Untitled-1', languageId: 'cga', version: 1, text: 'A --> extrud(1) B.' };
told = client.next(untitled.uri);
await client.notify('textDocument/didOpen', { textDocument: untitled });
assert.equal((await told).diagnostics.length, 1);
// A mistake in a file that is not open is told of that file.
told = client.next(uri(window));
writeFileSync(window, 'Window(depth) --> offset() Glass\n');
await client.notify('workspace/didChangeWatchedFiles', { changes: [{ uri: uri(window), type: 2 }] });
assert.equal((await told).diagnostics[0].code, 'wrong-argument-count');

// --- The end: nothing was written ---
assert.equal(await client.end(), 0);
assert.equal(readFileSync(house, 'utf8'), HOUSE);
assert.equal(statSync(house).mtimeMs, stamps[0]);
console.log('a whole session: done');
