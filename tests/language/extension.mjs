// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node extension.mjs OUT.vsix: the extension packs, twice to the same bytes; what is in the file is what its
// manifest names; the grammars colour a rule; its commands start the server and a studio. The editor itself
// is played: what the extension asks of it is written down.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { EventEmitter } from 'node:events';
import { mkdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire, Module } from 'node:module';
import { dirname, join } from 'node:path';
import { packages, root } from './client.mjs';

const target = process.argv[2];
const home = join(root, 'editors/vscode');
const folder = `${target}.unpacked`;

// --- The file ---
mkdirSync(dirname(target), { recursive: true });
const pack = () => {
  execFileSync(process.execPath, [join(home, 'pack.mjs'), target]);
  return readFileSync(target);
};
assert.ok(pack().equals(pack()));
rmSync(folder, { recursive: true, force: true });
execFileSync('python3', ['-B', '-c', 'import sys, zipfile\nz = zipfile.ZipFile(sys.argv[1])\nassert z.testzip() is None\nz.extractall(sys.argv[2])', target, folder]);
const types = readFileSync(join(folder, '[Content_Types].xml'), 'utf8');
const manifest = readFileSync(join(folder, 'extension.vsixmanifest'), 'utf8');
const own = JSON.parse(readFileSync(join(folder, 'extension/package.json'), 'utf8'));
for (const extension of ['.json', '.js', '.vsixmanifest']) assert.ok(types.includes(`Extension="${extension}"`));
assert.ok(manifest.includes(`Id="${own.name}" Version="${own.version}" Publisher="${own.publisher}"`));
for (const [, path] of manifest.matchAll(/Path="([^"]+)"/g)) readFileSync(join(folder, path));
for (const each of [...own.contributes.grammars, ...own.contributes.languages.map((l) => ({ path: l.configuration }))]) {
  JSON.parse(readFileSync(join(folder, 'extension', each.path), 'utf8'));
}
// The packages are those that the code asks for.
createRequire(join(folder, 'extension/extension.js')).resolve('vscode-languageclient/node');

// --- The grammars ---
function scopeOf(grammar, line, word) {
  const all = [...grammar.patterns, ...Object.values(grammar.repository ?? {}).flatMap((r) => [r, ...(r.patterns ?? [])])];
  for (const p of all) {
    if (!p.match) continue;
    for (const m of line.matchAll(new RegExp(p.match, 'gmd'))) {
      if (m[0] === word && p.name) return p.name;
      const group = m.indexOf(word, 1);
      if (group > 0 && p.captures?.[group]) return p.captures[group].name;
    }
  }
  return undefined;
}
const cga = JSON.parse(readFileSync(join(home, 'syntaxes/cga.tmLanguage.json'), 'utf8'));
const LINE = 'Lot(a) --> extrude(9.5) comp(f) { side : Facade | top : Roof. } // end';
for (const [word, scope] of [
  ['Lot', /rule/],
  ['extrude', /function/],
  ['9.5', /numeric/],
  ['Facade', /rule/],
  ['Roof', /terminal/],
  ['// end', /comment/],
]) {
  assert.match(scopeOf(cga, LINE, word) ?? '', scope, word);
}
assert.match(scopeOf(cga, 'attr height = 3', 'attr'), /storage/);
const other = JSON.parse(readFileSync(join(home, 'syntaxes/grammar.tmLanguage.json'), 'utf8'));
assert.match(scopeOf(other, 'START -> Repeat(X) {Wall}', 'START'), /rule/);

// --- The commands ---
const asked = { commands: new Map(), opened: [], clients: [], spawned: [], errors: [] };
const document = { languageId: 'cga', isUntitled: false, isDirty: true, save: async () => (asked.saved = true), uri: { scheme: 'file', fsPath: '/town/house.cga' } };
const vscode = {
  commands: { registerCommand: (name, run) => asked.commands.set(name, run), executeCommand() {} },
  workspace: {
    getConfiguration: () => ({ get: () => '/opt/gable' }),
    createFileSystemWatcher: () => ({}),
    getWorkspaceFolder: () => ({ uri: { fsPath: '/town' } }),
  },
  window: { activeTextEditor: { document }, showErrorMessage: async (text) => void asked.errors.push(text) },
  env: { openExternal: async (url) => asked.opened.push(url) },
  Uri: { file: (p) => ({ fsPath: p }), parse: (u) => u },
};
class LanguageClient {
  constructor(id, name, server, options) {
    asked.clients.push({ server, options });
  }
  async start() {}
  async stop() {
    asked.stopped = (asked.stopped ?? 0) + 1;
  }
}
function spawn(command, args) {
  const child = new EventEmitter();
  child.stdout = new EventEmitter();
  child.stderr = new EventEmitter();
  child.kill = () => (asked.killed = true);
  asked.spawned.push([command, ...args]);
  setImmediate(() => {
    child.stdout.emit('data', 'http://127.0.0.1:1/');
    child.stdout.emit('data', '?token=x\n');
  });
  return child;
}
const played = { vscode, 'vscode-languageclient/node': { LanguageClient }, 'node:child_process': { spawn } };
const load = Module._load;
Module._load = (name, ...rest) => played[name] ?? load(name, ...rest);
const extension = createRequire(join(folder, 'extension/extension.js'))('./extension.js');
Module._load = load;
const context = { subscriptions: [] };
await extension.activate(context);
assert.deepEqual(own.contributes.commands.map((c) => c.command).sort(), [...asked.commands.keys()].sort());
assert.deepEqual(asked.clients[0].server.run, { command: '/opt/gable', args: ['lsp'] });
assert.deepEqual(
  asked.clients[0].options.documentSelector.map((s) => s.language).sort(),
  own.contributes.languages.map((l) => l.id).sort(),
);
await asked.commands.get('gable.preview')();
await asked.commands.get('gable.preview')();
assert.ok(asked.saved);
assert.deepEqual(asked.spawned, [['/opt/gable', 'studio', '/town']], 'one studio a folder');
const page = 'http://127.0.0.1:1/?token=x#file=house.cga';
assert.deepEqual(asked.opened, [page, page]);
assert.deepEqual(asked.errors, []);
await asked.commands.get('gable.restart')();
assert.equal(asked.clients.length, 2);
await extension.deactivate();
assert.ok(asked.killed);
assert.equal(asked.stopped, 2);
assert.ok(packages);
console.log('the extension: done');
