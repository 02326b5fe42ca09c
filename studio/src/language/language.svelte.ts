// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Language: the page as a client of the language server. It knows the texts that are open here, as
// they are written; what it learns of them by itself are their mistakes.
//
// A text goes to the server when something is asked of it, or when it has rested: so a key costs
// what it asks, and nothing else.

import { difference } from '../lib/history';
import { Away, Connection, type Wire } from './connection';
import {
  pathOf,
  positionIn,
  uriOf,
  type CodeAction,
  type Diagnostic,
  type Position,
  type Range,
} from './protocol';

/** What it needs of the page around it. */
export interface LanguageHost {
  /** The folder of the project. */
  readonly root: string;
  /** The texts that are open, by path. */
  texts(): { path: string; text: string }[];
  wire(): Wire;
}

interface Sent {
  text: string;
  version: number;
}

/** A mistake with what mends it. */
export interface Mistake extends Diagnostic {
  actions: CodeAction[];
}

type Timer = ReturnType<typeof setTimeout> | undefined;

const REST_MS = 120;
const AGAIN_MS = 400;

export class Language {
  /** The mistakes of files, by path. Files without any are not in it. */
  mistakes = $state.raw<ReadonlyMap<string, Mistake[]>>(new Map());
  /** Counts connections: what was asked of one before is to be asked anew. */
  session = $state(0);

  private connection: Connection | null = null;
  private ready = false;
  private readonly sent = new Map<string, Sent>();
  private restTimer: Timer;
  private againTimer: Timer;

  constructor(private readonly host: LanguageHost) {}

  /** Connects where there is no connection. */
  connect(): void {
    clearTimeout(this.againTimer);
    if (this.connection || !this.host.root) return;
    const connection = new Connection(this.host.wire(), () => void this.begin(connection));
    connection.onnotification = (method, params) => this.told(method, params);
    connection.onend = () => {
      const worked = this.ready;
      this.connection = null;
      this.ready = false;
      this.sent.clear();
      // One that worked is looked for at once; else somebody else says when there is a server.
      if (worked) this.againTimer = setTimeout(() => this.connect(), AGAIN_MS);
    };
    this.connection = connection;
  }

  /** A text is another by now. */
  touched(): void {
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => this.flush(), REST_MS);
  }

  /** Files have changed on disk. */
  filesChanged(): void {
    if (this.ready) this.connection?.notify('workspace/didChangeWatchedFiles', { changes: [] });
  }

  /** Asks about a text as it is now. */
  async ask<T>(
    method: string,
    path: string,
    params: object = {},
    signal?: AbortSignal,
  ): Promise<T> {
    this.flush();
    const { connection } = this;
    if (!connection || !this.ready) throw new Away('there is no server');
    const textDocument = { uri: this.uri(path) };
    return connection.request<T>(method, { textDocument, ...params }, signal);
  }

  /** The same, where an answer that does not come is none. */
  async tell<T>(
    method: string,
    path: string,
    params: object = {},
    signal?: AbortSignal,
  ): Promise<T | null> {
    try {
      return await this.ask<T>(method, path, params, signal);
    } catch {
      return null;
    }
  }

  at<T>(method: string, path: string, position: Position, more: object = {}): Promise<T | null> {
    return this.tell<T>(method, path, { position, ...more });
  }

  /** What the attributes of a text are in the shape that was derived last. */
  setValues(path: string, values: Record<string, string>): void {
    if (!this.ready) return;
    this.flush();
    this.connection?.notify('gable/values', { textDocument: { uri: this.uri(path) }, values });
  }

  uri(path: string): string {
    return uriOf(this.host.root, path);
  }

  path(uri: string): string | null {
    return pathOf(this.host.root, uri);
  }

  /** Messages that were sent over the connection of now. */
  get messages(): number {
    return this.connection?.sent ?? 0;
  }

  private async begin(connection: Connection): Promise<void> {
    const uri = uriOf(this.host.root, '').replace(/\/$/, '');
    try {
      await connection.request('initialize', {
        processId: null,
        rootUri: uri,
        workspaceFolders: [{ uri, name: 'project' }],
        capabilities: {
          textDocument: {
            completion: { completionItem: { snippetSupport: true } },
            documentSymbol: { hierarchicalDocumentSymbolSupport: true },
            codeAction: { codeActionLiteralSupport: {} },
            hover: { contentFormat: ['markdown'] },
          },
        },
      });
    } catch {
      return;
    }
    connection.notify('initialized', {});
    this.ready = true;
    this.flush();
    ++this.session;
  }

  /** The server knows the open texts as they are. */
  private flush(): void {
    clearTimeout(this.restTimer);
    const { connection } = this;
    if (!connection || !this.ready) return;
    const open = this.host.texts();
    for (const path of [...this.sent.keys()]) {
      if (open.some((t) => t.path === path)) continue;
      connection.notify('textDocument/didClose', { textDocument: { uri: this.uri(path) } });
      this.sent.delete(path);
    }
    for (const { path, text } of open) {
      const uri = this.uri(path);
      const known = this.sent.get(path);
      if (!known) {
        const textDocument = { uri, languageId: 'gable', version: 1, text };
        connection.notify('textDocument/didOpen', { textDocument });
        this.sent.set(path, { text, version: 1 });
        continue;
      }
      const change = difference(path, known.text, text);
      if (!change) continue;
      const range: Range = {
        start: positionIn(known.text, change.at),
        end: positionIn(known.text, change.at + change.removed.length),
      };
      known.text = text;
      connection.notify('textDocument/didChange', {
        textDocument: { uri, version: ++known.version },
        contentChanges: [{ range, text: change.inserted }],
      });
    }
  }

  private told(method: string, params: unknown): void {
    if (method !== 'textDocument/publishDiagnostics') return;
    const { uri, diagnostics, version } = params as {
      uri: string;
      diagnostics: Diagnostic[];
      version?: number;
    };
    const path = this.path(uri);
    if (path !== null) void this.found(path, diagnostics, version);
  }

  private async found(path: string, diagnostics: Diagnostic[], version?: number): Promise<void> {
    // What is said of a text that is another by now is said anew.
    if (version !== undefined && version !== this.sent.get(path)?.version) return;
    let actions: CodeAction[] = [];
    if (diagnostics.length && this.sent.has(path) && this.connection) {
      const range = { start: { line: 0, character: 0 }, end: { line: 1e9, character: 0 } };
      const context = { diagnostics };
      const textDocument = { uri: this.uri(path) };
      const asked = { textDocument, range, context };
      actions = await this.connection
        .request<CodeAction[]>('textDocument/codeAction', asked)
        .catch(() => []);
      if (version !== undefined && version !== this.sent.get(path)?.version) return;
    }
    const same = (a: Diagnostic, b: Diagnostic) =>
      a.code === b.code && JSON.stringify(a.range) === JSON.stringify(b.range);
    const next = new Map(this.mistakes);
    next.delete(path);
    const list = diagnostics.map((d) => ({
      ...d,
      actions: actions.filter((a) => a.diagnostics.some((other) => same(other, d))),
    }));
    if (list.length) next.set(path, list);
    this.mistakes = next;
  }
}
