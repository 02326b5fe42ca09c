// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Names over all rule files of the project, as the language server knows them: where they are
// defined and used, and renaming them as one step of the history.

import { Away } from '../language/connection';
import {
  edited,
  offsetIn,
  type Location,
  type Position,
  type Range,
  type WorkspaceEdit,
} from '../language/protocol';
import type { Studio } from '../lib/studio.svelte';

export interface Found {
  path: string;
  line: number;
  column: number;
  text: string;
  definition: boolean;
}

export interface Listing {
  name: string;
  found: Found[];
}

export interface Renaming {
  path: string;
  at: Position;
  name: string;
  uses: number;
  files: number;
  /** Why the name that is being written cannot be used. */
  trouble: string;
}

const CHECK_MS = 120;

export class References {
  listing = $state.raw<Listing | null>(null);
  renaming = $state<Renaming | null>(null);

  private timer = 0;

  constructor(private readonly studio: Studio) {}

  /** Where the name at a place is defined. */
  async definition(path: string, at: Position): Promise<Found | null> {
    const places = await this.places('textDocument/definition', path, at);
    const first = places[0];
    return first ? this.found(first, true) : null;
  }

  async list(path: string, at: Position): Promise<boolean> {
    const [all, defined] = await this.uses(path, at);
    if (!all.length) return false;
    const found = await Promise.all(all.map((l) => this.found(l, has(defined, l))));
    const first = all[0]!;
    const text = (await this.text(this.studio.language.path(first.uri) ?? path)) ?? '';
    this.listing = { name: slice(text, first.range), found };
    return true;
  }

  async beginRename(path: string, at: Position): Promise<boolean> {
    const { language } = this.studio;
    const range = await language.at<Range>('textDocument/prepareRename', path, at);
    if (!range) return false;
    const [all] = await this.uses(path, at);
    const text = (await this.text(path)) ?? '';
    this.renaming = {
      path,
      at,
      name: slice(text, range),
      uses: all.length,
      files: new Set(all.map((l) => l.uri)).size,
      trouble: '',
    };
    return true;
  }

  /** Finds out, a little later, whether the name that is being written can be used. */
  check(name: string): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      void this.edits(name).then((edits) => {
        if (this.renaming) this.renaming.trouble = typeof edits === 'string' ? edits : '';
      });
    }, CHECK_MS);
  }

  /** False where the name cannot be used. */
  async rename(name: string): Promise<boolean> {
    clearTimeout(this.timer);
    const { renaming, studio } = this;
    if (!renaming) return false;
    const edits = await this.edits(name);
    if (typeof edits === 'string') {
      renaming.trouble = edits;
      return false;
    }
    this.renaming = null;
    if (name === renaming.name) return true;
    await applyEdits(studio, edits, `Rename ${renaming.name}`);
    studio.say(`${renaming.name} is now ${name} in ${renaming.uses} places`, {
      label: 'Undo',
      run: () => studio.undo(),
    });
    return true;
  }

  /** What the new name changes, or why it cannot be. */
  private async edits(newName: string): Promise<WorkspaceEdit | string> {
    const { renaming } = this;
    if (!renaming || newName === renaming.name) return { changes: {} };
    try {
      return await this.studio.language.ask('textDocument/rename', renaming.path, {
        position: renaming.at,
        newName,
      });
    } catch (error) {
      return error instanceof Away ? 'There is no server now.' : (error as Error).message;
    }
  }

  private async places(
    method: string,
    path: string,
    position: Position,
    more: object = {},
  ): Promise<Location[]> {
    return ((await this.studio.language.at<Location[]>(method, path, position, more)) ?? []).filter(
      (l) => this.studio.language.path(l.uri) !== null,
    );
  }

  private uses(path: string, at: Position): Promise<[Location[], Location[]]> {
    return Promise.all([
      this.places('textDocument/references', path, at, { context: { includeDeclaration: true } }),
      this.places('textDocument/definition', path, at),
    ]);
  }

  private async text(path: string): Promise<string | null> {
    const { documents, client } = this.studio;
    const doc = documents.doc(path);
    if (doc) return doc.text;
    return client.read(path).then(
      (file) => file.text,
      () => null,
    );
  }

  private async found(place: Location, definition: boolean): Promise<Found> {
    const path = this.studio.language.path(place.uri)!;
    const lines = ((await this.text(path)) ?? '').split('\n');
    const { line, character } = place.range.start;
    return {
      path,
      line: line + 1,
      column: character + 1,
      text: (lines[line] ?? '').trim(),
      definition,
    };
  }
}

const has = (all: Location[], one: Location) =>
  all.some((l) => l.uri === one.uri && JSON.stringify(l.range) === JSON.stringify(one.range));

const slice = (text: string, range: Range) =>
  text.slice(offsetIn(text, range.start), offsetIn(text, range.end));

/** Carries out edits of the server over all files that they concern, as one step. */
export async function applyEdits(
  studio: Studio,
  edit: WorkspaceEdit,
  label: string,
  group = '',
): Promise<void> {
  const texts: [string, string][] = [];
  for (const [uri, edits] of Object.entries(edit.changes)) {
    const path = studio.language.path(uri);
    if (path === null) continue;
    await studio.documents.load(path);
    texts.push([path, edited(studio.documents.doc(path)!.text, edits)]);
  }
  studio.editAll(texts, label, group);
}
