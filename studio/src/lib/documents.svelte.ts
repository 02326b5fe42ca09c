// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Documents: the files that are open, as they are edited and as their files say. Text that is in no
// file is kept on the server, and in the browser while there is none.

import { Refusal, type EngineClient } from './client';
import { merge } from './merge';
import { Recovery } from './recovery';
import type { Unsent } from './unsent';

export interface Doc {
  path: string;
  text: string;
  /** What the file says, and which version that is; "none" for a file that is not there yet. */
  saved: string;
  version: string;
}

/** What documents need of the page around them. */
export interface DocumentsHost {
  readonly client: EngineClient;
  readonly main: string;
  say(text: string, action?: { label: string; run: () => void }): void;
  fail(text: string): void;
  edit(path: string, text: string, label?: string): void;
  /** The text of a document is another by now. */
  changed(): void;
}

export class Documents {
  open = $state<Doc[]>([]);
  active = $state('');
  /** Both sides changed the same lines. */
  conflictOf = $state<{ path: string; theirs: string; version: string } | null>(null);
  private readonly recovery: Recovery;

  constructor(
    private readonly host: DocumentsHost,
    unsent: Unsent,
  ) {
    this.recovery = new Recovery(host.client, host.client.tab, unsent);
  }

  doc(path: string): Doc | undefined {
    return this.open.find((d) => d.path === path);
  }

  dirty(path: string): boolean {
    const doc = this.doc(path);
    return !!doc && doc.text !== doc.saved;
  }

  /** Texts of edited files but one. */
  overlay(except: string): Record<string, string> {
    const edited = this.open.filter((d) => d.path !== except && d.text !== d.saved);
    return Object.fromEntries(edited.map((d) => [d.path, d.text]));
  }

  async show(path: string): Promise<void> {
    await this.load(path);
    this.active = path;
  }

  /** Opens a file without going there. */
  async load(path: string): Promise<void> {
    if (this.doc(path)) return;
    const file = await this.host.client.read(path);
    const { text, aside } = await this.recovery.recall(path, file.text);
    if (this.doc(path)) return;
    this.open.push({ path, text, saved: file.text, version: file.version });
    const other = aside[0];
    if (other === undefined) return;
    this.host.say(`Another page had other edits of ${path}`, {
      label: 'Take those',
      run: () => this.host.edit(path, other, 'Take the other edits'),
    });
  }

  close(path: string): void {
    if (path === this.host.main) return;
    this.open = this.open.filter((d) => d.path !== path);
    if (this.active === path) this.active = this.host.main;
  }

  async save(path = this.active): Promise<void> {
    const doc = this.doc(path);
    if (!doc) return;
    const text = doc.text;
    try {
      doc.version = await this.host.client.write(path, text, doc.version);
      doc.saved = text;
      await this.recovery.drop(path);
      this.host.say(`Saved ${path}`);
    } catch (error) {
      if (error instanceof Refusal && error.code === 'version-differs') await this.conflict(doc);
      else this.host.fail(`${path} could not be saved: ${(error as Error).message}`);
    }
  }

  async saveAll(): Promise<void> {
    for (const doc of this.open) if (doc.text !== doc.saved) await this.save(doc.path);
  }

  /** What would be lost with this page goes to the server. */
  async keep(): Promise<void> {
    for (const doc of this.open) await this.recovery.keep(doc.path, doc.text, doc.saved);
  }

  /** There is no server: what would be lost with this page stays in the browser. */
  keepHere(): void {
    for (const doc of this.open) this.recovery.keepHere(doc.path, doc.text, doc.saved);
  }

  /** The server is another by now, which may know nothing of what was kept before. */
  forgetKept(): void {
    this.recovery.forget();
  }

  /** Ends a conflict: with the text here or one of both, or with what the file says. */
  async resolve(mine: boolean, text?: string): Promise<void> {
    const conflict = this.conflictOf;
    const doc = conflict && this.doc(conflict.path);
    this.conflictOf = null;
    if (!conflict || !doc) return;
    doc.version = conflict.version;
    doc.saved = conflict.theirs;
    if (text !== undefined) this.host.edit(doc.path, text, 'Join both edits');
    if (mine) return this.save(doc.path);
    doc.text = conflict.theirs;
    await this.recovery.drop(doc.path);
    this.host.changed();
  }

  /** A file has another stamp: reads it, where it is open. */
  async changedElsewhere(path: string): Promise<void> {
    const doc = this.doc(path);
    if (!doc) return;
    const { text, version } = await this.host.client.read(path);
    if (version === doc.version) return;
    this.join(doc, text, version);
  }

  private async conflict(doc: Doc): Promise<void> {
    const { text, version } = await this.host.client.read(doc.path);
    if (this.join(doc, text, version)) await this.save(doc.path);
  }

  /** Takes what others wrote into what is edited here; asks where both changed the same lines. */
  private join(doc: Doc, theirs: string, version: string): boolean {
    const merged = merge(doc.saved, doc.text, theirs);
    if (merged.conflicts) {
      this.conflictOf = { path: doc.path, theirs, version };
      return false;
    }
    const edited = doc.text !== doc.saved;
    doc.text = merged.text;
    doc.saved = theirs;
    doc.version = version;
    this.host.say(
      edited
        ? `${doc.path} was changed elsewhere; both edits are in it now`
        : `${doc.path} was changed elsewhere and read again`,
    );
    this.host.changed();
    return true;
  }
}
