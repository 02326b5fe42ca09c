// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parts: the tree of a model that has too many shapes for one answer. It holds the shapes that were
// derived on their own, and the leaves; what is below a shape is asked for when somebody looks.

import type { Far } from './far';
import type { Outlined } from './outline';
import type { PartsBelow } from './protocol';

interface Part {
  name: string;
  level: number;
  from: number;
  to: number;
  leaf: boolean;
  parent: number;
  children: number[];
}

export class Parts implements Outlined {
  roots: number[] = [];
  /** Grows whenever something more is known. */
  known = $state(0);
  /** Shapes that an answer had no room for. */
  more = 0;
  private readonly all: Part[] = [];
  private readonly asked = new Map<number, Promise<void>>();
  /** By level and first leaf, of which there is one. */
  private readonly places = new Map<string, number>();

  constructor(private readonly ask: (leaf: number, level: number) => Promise<PartsBelow>) {}

  private static readonly ROOT = -1;

  nameOf(node: number): string {
    return this.all[node]!.name;
  }

  children(node: number): ArrayLike<number> {
    return this.all[node]!.children;
  }

  isParent(node: number): boolean {
    return !this.all[node]!.leaf;
  }

  leavesOf(node: number): number {
    const { from, to } = this.all[node]!;
    return to - from;
  }

  /** Any leaf below it, and which of those above that leaf it is. */
  placeOf(node: number): { leaf: number; level: number } {
    const { from, level } = this.all[node]!;
    return { leaf: from, level };
  }

  /** The shapes above, from the initial one. */
  above(node: number): number[] {
    const path: number[] = [];
    for (let at = this.all[node]!.parent; at !== Parts.ROOT; at = this.all[at]!.parent)
      path.unshift(at);
    return path;
  }

  siblings(node: number): ArrayLike<number> {
    const { parent } = this.all[node]!;
    return parent === Parts.ROOT ? this.roots : this.children(parent);
  }

  /** The part that is selected, if it is known; -1 otherwise. */
  find(far: Far): number {
    return this.places.get(`${far.level} ${far.range.from}`) ?? -1;
  }

  /** Asks for what is below a part, or for the initial shapes. */
  load(node = Parts.ROOT): Promise<void> {
    const before = this.asked.get(node);
    if (before) return before;
    const now = this.loadNow(node).catch(() => void this.asked.delete(node));
    this.asked.set(node, now);
    return now;
  }

  /** Asks for all that is above a part, and gives it. */
  async reveal(far: Far): Promise<number> {
    await this.load();
    for (const each of far.path.slice(0, far.level)) {
      const node = this.find(each);
      if (node < 0) return -1;
      await this.load(node);
    }
    return this.find(far);
  }

  private async loadNow(node: number): Promise<void> {
    const part = this.all[node];
    if (part?.leaf) return;
    const level = part ? part.level + 1 : 0;
    const { parts, more } = await this.ask(part?.from ?? 0, level);
    const children = parts.map(([name, from, to, leaf]) => {
      const at = this.all.length;
      this.all.push({ name, level, from, to, leaf, parent: node, children: [] });
      this.places.set(`${level} ${from}`, at);
      return at;
    });
    if (part) part.children = children;
    else this.roots = children;
    this.more += more;
    this.known += 1;
  }
}
