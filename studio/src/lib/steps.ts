// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Steps of a derivation: each replaces one shape by what its rule makes of it, in the order of the
// derivation. After the last step only leaves are left.

import { NONE, type Note } from './protocol';
import type { Shapes } from './tree';

export const RULE_CALL = 4;

export type Time = 'later' | 'now' | 'replaced';

/** What a step put in the place of its shape. */
export interface Made {
  name: string;
  count: number;
  /** The size of the first along the axis in which all of them lie; 0 where sizes differ. */
  extent: number;
}

export class Steps {
  /** The shape that each step replaces; step 1 is the first entry. */
  readonly nodes: number[] = [];
  /** The step that replaces a shape; 0 for leaves that nothing replaces. */
  readonly replacedIn: Uint32Array;
  private readonly notes = new Map<number, Note[]>();

  constructor(readonly shapes: Shapes) {
    const { tree } = shapes;
    this.replacedIn = new Uint32Array(tree.count);
    for (let i = 0; i < tree.count; ++i) {
      if (!(tree.flags[i]! & RULE_CALL)) continue;
      this.nodes.push(i);
      this.replacedIn[i] = this.nodes.length;
    }
    for (const note of tree.notes) {
      const known = this.notes.get(note.node);
      if (known) known.push(note);
      else this.notes.set(note.node, [note]);
    }
  }

  /** What a shape's rule drew and saw. */
  notesOf(node: number): Note[] {
    return this.notes.get(node) ?? [];
  }

  get count(): number {
    return this.nodes.length;
  }

  /** The step after which a shape exists; 0 for initial shapes. */
  born(node: number): number {
    const above = this.shapes.tree.parent[node]!;
    return above === NONE ? 0 : this.replacedIn[above]!;
  }

  time(node: number, step: number): Time {
    if (this.born(node) > step) return 'later';
    const end = this.replacedIn[node]!;
    return end > 0 && end <= step && !(this.shapes.tree.flags[node]! & 1) ? 'replaced' : 'now';
  }

  /** The shapes that a step made. */
  children(step: number): Uint32Array {
    const node = this.nodes[step - 1];
    return node === undefined ? new Uint32Array() : this.shapes.children(node);
  }

  made(step: number): Made[] {
    const found = new Map<string, number[]>();
    for (const child of this.children(step)) {
      const name = this.shapes.nameOf(child);
      found.set(name, [...(found.get(name) ?? []), child]);
    }
    return [...found].map(([name, nodes]) => ({
      name,
      count: nodes.length,
      extent: this.extent(nodes),
    }));
  }

  private extent(nodes: number[]): number {
    const { size } = this.shapes.tree;
    const of = (node: number, axis: number) => size[node * 3 + axis]!;
    const parent = this.shapes.tree.parent[nodes[0]!]!;
    if (parent === NONE) return 0;
    for (let axis = 0; axis < 3; ++axis) {
      const first = of(nodes[0]!, axis);
      const cut = first < of(parent, axis) * 0.999;
      if (cut && nodes.every((n) => Math.abs(of(n, axis) - first) < 1e-3 * Math.max(1, first)))
        return first;
    }
    return 0;
  }

  /** From and up to which step each leaf of the draw list of all steps is to be seen. */
  lives(leaves: number): Float32Array {
    const { tree } = this.shapes;
    const out = new Float32Array(leaves * 2);
    const set = (leaf: number, from: number, to: number) => {
      if (leaf === NONE || leaf >= leaves) return;
      out[leaf * 2] = from;
      out[leaf * 2 + 1] = to;
    };
    for (let i = 0; i < tree.count; ++i) {
      const end = this.replacedIn[i]!;
      set(tree.before[i]!, this.born(i), end > 0 ? end : 1e9);
      set(tree.after[i]!, end > 0 ? end : this.born(i), 1e9);
    }
    return out;
  }

  /**
   * The next step, forwards or backwards, that replaces a shape of a rule on which to stop; 0 for
   * none.
   */
  nextStop(step: number, forwards: boolean, stops: ReadonlySet<string>): number {
    const by = forwards ? 1 : -1;
    for (let s = step + by; s >= 1 && s <= this.count; s += by) {
      if (stops.has(this.shapes.nameOf(this.nodes[s - 1]!))) return s;
    }
    return 0;
  }
}
