// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Recovery: text that is in no file yet, kept on the server for each page by itself, so that two
// pages on one file do not write over each other. A page that is loaded again finds its own; a new
// one finds what others had, joined where they edited different lines.

import type { EngineClient } from './client';
import { merge } from './merge';
import type { Kept, Unsent } from './unsent';

/** What is kept of the server's store; a tab keeps its name when it is loaded again. */
export type Store = Pick<EngineClient, 'recovery' | 'keepRecovery' | 'dropRecovery'>;

const PAGES = 'pages.json';
/** Pages that are long gone are forgotten. */
const MOST_PAGES = 12;

export interface Recovered {
  text: string;
  /** Texts of other pages that change the same lines. */
  aside: string[];
}

export class Recovery {
  private listed = false;
  /** Files whose text here has in it what other pages never sent. */
  private readonly opened = new Set<string>();
  private readonly kept = new Map<string, string>();
  /** Pages whose edits a file was opened with: they go with the next saving. */
  private readonly joined = new Map<string, string[]>();

  constructor(
    private readonly store: Store,
    private readonly page: string,
    private readonly unsent: Unsent,
  ) {}

  /** Keeps a text that is not what the file says; one that is again needs no keeping. */
  async keep(path: string, text: string, base: string): Promise<void> {
    if (text === base) this.unsent.drop(path);
    if (text === base) return this.kept.has(path) ? this.drop(path) : undefined;
    if (this.kept.get(path) === text) return;
    if (!this.listed) {
      const pages = (await this.pages()).filter((p) => p !== this.page);
      await this.store.keepRecovery(
        PAGES,
        JSON.stringify([...pages, this.page].slice(-MOST_PAGES)),
      );
      this.listed = true;
    }
    const kept: Kept = { base, text };
    await this.store.keepRecovery(own(this.page, path), JSON.stringify(kept));
    this.kept.set(path, text);
    this.unsent.drop(path, this.opened.has(path));
  }

  /** Keeps a text in the browser that the server cannot take now. */
  keepHere(path: string, text: string, base: string): void {
    if (text !== base && this.kept.get(path) !== text) this.unsent.put(path, { base, text });
  }

  /** What was kept may be gone: all of it is kept anew. */
  forget(): void {
    this.kept.clear();
    this.listed = false;
  }

  /** The file says so by now. */
  async drop(path: string): Promise<void> {
    this.kept.delete(path);
    this.unsent.drop(path, true);
    const pages = [this.page, ...(this.joined.get(path) ?? [])];
    this.joined.delete(path);
    for (const page of pages) await this.store.dropRecovery(own(page, path));
  }

  /** What a file that says `saved` is to be opened with. */
  async recall(path: string, saved: string): Promise<Recovered> {
    // What never reached a server is the latest there is.
    const unsent = this.unsent.get(path);
    const mine = unsent.get(this.page) ?? (await this.read(this.page, path));
    if (mine) {
      // Meanwhile others may have saved.
      const now = merge(mine.base, mine.text, saved);
      return { text: now.text, aside: now.conflicts ? [saved] : [] };
    }
    const out: Recovered = { text: saved, aside: [] };
    const take = (other: Kept) => {
      const now = merge(other.base, out.text, other.text);
      if (now.conflicts) out.aside.push(other.text);
      else out.text = now.text;
      return !now.conflicts;
    };
    for (const other of unsent.values()) if (take(other)) this.opened.add(path);
    // The latest page first: where lines differ, it counts.
    for (const page of (await this.pages()).reverse()) {
      const other = unsent.has(page) ? null : await this.read(page, path);
      if (other && take(other)) this.joined.set(path, [...(this.joined.get(path) ?? []), page]);
    }
    return out;
  }

  private async read(page: string, path: string): Promise<Kept | null> {
    try {
      return JSON.parse((await this.store.recovery(own(page, path))) ?? 'null') as Kept | null;
    } catch {
      return null;
    }
  }

  private async pages(): Promise<string[]> {
    try {
      const list: unknown = JSON.parse((await this.store.recovery(PAGES)) ?? '[]');
      return Array.isArray(list) ? list.filter((p): p is string => typeof p === 'string') : [];
    } catch {
      return [];
    }
  }
}

function own(page: string, path: string): string {
  return `pages/${page}/${path}`;
}
