// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Names over all rule files of the project: where they are defined and used, and renaming them as
// one step of the history.

import { notationOf } from '../lib/notation';
import type { Studio } from '../lib/studio.svelte';
import {
  applyChanges,
  definitionOf,
  definitions,
  nameTrouble,
  rename,
  targetAt,
  uses,
  type RuleFile,
  type Target,
} from './rules';
import { lineOf } from './tokens';

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
  target: Target;
  name: string;
  uses: number;
  files: number;
  trouble: string;
}

export class References {
  listing = $state.raw<Listing | null>(null);
  renaming = $state<Renaming | null>(null);

  private readonly read = new Map<string, { stamp: string; text: string }>();
  private files: RuleFile[] = [];

  constructor(private readonly studio: Studio) {}

  /** The rule files as they are being written: texts of the editor before those on disk. */
  async load(): Promise<RuleFile[]> {
    const { studio } = this;
    this.files = await Promise.all(
      studio.ruleFiles.map(async (f): Promise<RuleFile> => {
        const doc = studio.documents.doc(f.path);
        if (doc) return { path: f.path, text: doc.text };
        const known = this.read.get(f.path);
        if (known?.stamp === f.stamp) return { path: f.path, text: known.text };
        const { text } = await studio.client.read(f.path);
        this.read.set(f.path, { stamp: f.stamp, text });
        return { path: f.path, text };
      }),
    );
    return this.files;
  }

  /** Where the name at an offset is defined. */
  async definition(path: string, offset: number): Promise<Found | null> {
    const files = await this.load();
    const target = targetAt(files, path, offset);
    const found = target && definitionOf(files, target);
    if (!found) return null;
    return this.at(found.path, found.definition.nameSpan.from, true);
  }

  async list(path: string, offset: number): Promise<boolean> {
    const files = await this.load();
    const target = targetAt(files, path, offset);
    const all = target ? uses(files, target) : [];
    if (!target || !all.length) return false;
    this.listing = {
      name: target.name,
      found: all.map((u) => this.at(u.path, u.from, u.definition)),
    };
    return true;
  }

  async beginRename(path: string, offset: number): Promise<boolean> {
    const files = await this.load();
    const target = targetAt(files, path, offset);
    const all = target ? uses(files, target) : [];
    // What no file of the project defines is built in, or a leaf, whose name is free to change.
    if (
      !target ||
      !all.length ||
      this.studio.registry.some((e) => e.name === target.name && !all.some((u) => u.definition))
    )
      return false;
    this.renaming = {
      target,
      name: target.name,
      uses: all.length,
      files: new Set(all.map((u) => u.path)).size,
      trouble: '',
    };
    return true;
  }

  check(name: string): string {
    const renaming = this.renaming;
    if (!renaming || name === renaming.target.name) return '';
    const file = this.files.find((f) => f.path === renaming.target.path);
    const taken = file
      ? definitions(file.text, notationOf(file.path)).flatMap((d) => [
          d.name,
          ...(renaming.target.within ? d.parameters : []),
        ])
      : [];
    return nameTrouble(name, taken) ?? '';
  }

  async rename(name: string): Promise<void> {
    const renaming = this.renaming;
    if (!renaming) return;
    const trouble = this.check(name);
    if (trouble) {
      renaming.trouble = trouble;
      return;
    }
    this.renaming = null;
    if (name === renaming.target.name) return;
    const texts: [string, string][] = [];
    for (const [path, changes] of rename(await this.load(), renaming.target, name)) {
      await this.studio.documents.load(path);
      texts.push([path, applyChanges(this.studio.documents.doc(path)!.text, changes)]);
    }
    this.studio.editAll(texts, `Rename ${renaming.target.name}`);
    this.studio.say(`${renaming.target.name} is now ${name} in ${renaming.uses} places`, {
      label: 'Undo',
      run: () => this.studio.undo(),
    });
  }

  private at(path: string, offset: number, definition: boolean): Found {
    const text = this.files.find((f) => f.path === path)?.text ?? '';
    const from = text.lastIndexOf('\n', offset - 1) + 1;
    const end = text.indexOf('\n', offset);
    return {
      path,
      line: lineOf(text, offset),
      column: offset - from + 1,
      text: text.slice(from, end < 0 ? text.length : end).trim(),
      definition,
    };
  }
}
