// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A client of `gable lsp` as editors have one: npm's vscode-jsonrpc over pipes. Its packages lie in
// build/editors, where ./test installs them; without them a test ends with 77, which counts as skipped.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
export const root = resolve(here, '../..');
export const packages = process.env.GABLE_EDITORS ?? join(root, 'build/editors');

if (!existsSync(join(packages, 'node_modules/vscode-jsonrpc'))) {
  console.log(`skipped: no packages in ${packages}; ./test installs them`);
  process.exit(77);
}
const rpc = createRequire(join(packages, 'package.json'))('vscode-jsonrpc/node');

export const uri = (path) => pathToFileURL(path).href;

/** The position of the nth `part` in a text, `offset` characters on. */
export function positionIn(text, part, offset = 0, nth = 0) {
  let at = -1;
  for (let i = 0; i <= nth; ++i) {
    at = text.indexOf(part, at + 1);
    if (at < 0) throw new Error(`no '${part}'`);
  }
  const before = text.slice(0, at + offset).split('\n');
  return { line: before.length - 1, character: before.at(-1).length };
}

/** The text with edits of the protocol carried out. */
export function edited(text, edits) {
  const lines = text.split('\n');
  const starts = [0];
  for (const l of lines) starts.push(starts.at(-1) + l.length + 1);
  const offset = (p) => starts[p.line] + p.character;
  let out = text;
  const sorted = [...edits].sort((a, b) => offset(b.range.start) - offset(a.range.start));
  for (const e of sorted) out = out.slice(0, offset(e.range.start)) + e.newText + out.slice(offset(e.range.end));
  return out;
}

export class Client {
  constructor(program) {
    this.process = spawn(program, ['lsp', '--stdio'], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.ended = new Promise((done) => this.process.on('exit', (code) => done(code)));
    this.rpc = rpc.createMessageConnection(
      new rpc.StreamMessageReader(this.process.stdout),
      new rpc.StreamMessageWriter(this.process.stdin),
    );
    /** What was last published, by address. */
    this.findings = new Map();
    this.waiting = [];
    this.rpc.onNotification('textDocument/publishDiagnostics', (p) => {
      this.findings.set(p.uri, p);
      this.waiting = this.waiting.filter((w) => !w(p));
    });
    this.rpc.listen();
    this.versions = new Map();
  }

  request(method, params, token) {
    return token ? this.rpc.sendRequest(method, params, token) : this.rpc.sendRequest(method, params);
  }
  notify(method, params) {
    return this.rpc.sendNotification(method, params);
  }

  async initialize(folder) {
    const hello = await this.request('initialize', {
      processId: process.pid,
      rootUri: uri(folder),
      workspaceFolders: [{ uri: uri(folder), name: 'test' }],
      capabilities: {
        textDocument: {
          completion: { completionItem: { snippetSupport: true } },
          documentSymbol: { hierarchicalDocumentSymbolSupport: true },
          codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ['quickfix'] } } },
          hover: { contentFormat: ['markdown', 'plaintext'] },
        },
      },
    });
    await this.notify('initialized', {});
    return hello;
  }

  async open(path, text) {
    const document = { uri: uri(path), languageId: path.split('.').at(-1), version: 1, text };
    this.versions.set(document.uri, 1);
    const told = this.next(document.uri);
    await this.notify('textDocument/didOpen', { textDocument: document });
    return told;
  }

  change(path, contentChanges) {
    const version = this.versions.get(uri(path)) + 1;
    this.versions.set(uri(path), version);
    return this.notify('textDocument/didChange', { textDocument: { uri: uri(path), version }, contentChanges });
  }

  /** The next findings of an address. */
  next(address) {
    return new Promise((done) => {
      this.waiting.push((p) => {
        if (p.uri !== address) return false;
        done(p);
        return true;
      });
    });
  }

  async end() {
    await this.request('shutdown');
    await this.notify('exit');
    const code = await this.ended;
    this.rpc.dispose();
    return code;
  }
}

export { rpc };
