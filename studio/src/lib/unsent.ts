// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Unsent: texts that no server has yet, in the browser's own store. A page that is opened when
// there is a server again finds them there.

/** A text, and what the file said that it was made from. */
export interface Kept {
  base: string;
  text: string;
}

/** What is used of the browser's store. */
export type BrowserStore = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

export class Unsent {
  constructor(
    private readonly store: BrowserStore,
    private readonly page: string,
    /** The folder of the project: several may be served at one address, one after the other. */
    private readonly project: () => string,
  ) {}

  put(path: string, kept: Kept): void {
    this.write(path, { ...this.read(path), [this.page]: kept });
  }

  /** Texts by page. */
  get(path: string): Map<string, Kept> {
    return new Map(Object.entries(this.read(path)));
  }

  /** The text of this page is elsewhere now; `all`: those of other pages as well. */
  drop(path: string, all = false): void {
    const left = all ? {} : this.read(path);
    delete left[this.page];
    this.write(path, left);
  }

  private read(path: string): Record<string, Kept> {
    try {
      const all = JSON.parse(this.store.getItem(this.key(path)) ?? '{}') as Record<string, Kept>;
      const good = (k: Kept) => typeof k?.text === 'string' && typeof k.base === 'string';
      return Object.fromEntries(Object.entries(all).filter(([, kept]) => good(kept)));
    } catch {
      return {};
    }
  }

  private write(path: string, all: Record<string, Kept>): void {
    try {
      if (Object.keys(all).length) this.store.setItem(this.key(path), JSON.stringify(all));
      else this.store.removeItem(this.key(path));
    } catch {
      // A full store: the page itself still has the text.
    }
  }

  private key(path: string): string {
    return `gable.unsent ${this.project()} ${path}`;
  }
}
