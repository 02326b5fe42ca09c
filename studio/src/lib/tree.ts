// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The derivation tree for people: children, paths that survive a new derivation, rows of an outline
// in which equal siblings are folded, the shape that a click means.

import { NONE, type Tree } from './protocol';

export class Shapes {
  private readonly childStart: Uint32Array;
  private readonly childList: Uint32Array;
  readonly roots: number[] = [];
  /** Leaves with geometry below each shape, itself included. */
  readonly leaves: Uint32Array;

  constructor(readonly tree: Tree) {
    const n = tree.count;
    this.childStart = new Uint32Array(n + 1);
    for (let i = 0; i < n; ++i) {
      const parent = tree.parent[i]!;
      if (parent === NONE) this.roots.push(i);
      else this.childStart[parent + 1]!++;
    }
    for (let i = 0; i < n; ++i) this.childStart[i + 1]! += this.childStart[i]!;
    this.childList = new Uint32Array(this.childStart[n]!);
    const next = this.childStart.slice();
    this.leaves = new Uint32Array(n);
    for (let i = 0; i < n; ++i) {
      const parent = tree.parent[i]!;
      if (parent !== NONE) this.childList[next[parent]!++] = i;
    }
    for (let i = n - 1; i >= 0; --i) {
      const own = tree.flags[i]! & 1 && tree.firstLeaf[i] !== NONE ? 1 : 0;
      this.leaves[i]! += own;
      const parent = tree.parent[i]!;
      if (parent !== NONE) this.leaves[parent]! += this.leaves[i]!;
    }
  }

  children(node: number): Uint32Array {
    return this.childList.subarray(this.childStart[node]!, this.childStart[node + 1]!);
  }

  nameOf(node: number): string {
    return this.tree.names[this.tree.name[node]!] ?? '';
  }

  /** From the initial shape down to the node itself. */
  pathTo(node: number): number[] {
    const path: number[] = [];
    for (let i = node; i !== NONE && i >= 0; i = this.tree.parent[i]!) path.unshift(i);
    return path;
  }

  /** A path by name and place among siblings of that name. */
  address(node: number): string[] {
    return this.pathTo(node).map((each, depth) => {
      const above = this.tree.parent[each]!;
      const siblings = depth === 0 ? this.roots : [...this.children(above)];
      const name = this.nameOf(each);
      return `${name}#${siblings.filter((s) => s < each && this.nameOf(s) === name).length}`;
    });
  }

  /** The shape at an address, or the nearest one above; -1 without any. */
  find(address: string[]): number {
    let at = -1;
    for (const step of address) {
      const [name, ordinal] = [
        step.slice(0, step.lastIndexOf('#')),
        Number(step.slice(step.lastIndexOf('#') + 1)),
      ];
      const siblings = at < 0 ? this.roots : [...this.children(at)];
      const found = siblings.filter((s) => this.nameOf(s) === name)[ordinal];
      if (found === undefined) break;
      at = found;
    }
    return at;
  }

  range(node: number): { from: number; to: number } | null {
    const from = this.tree.firstLeaf[node]!;
    return node < 0 || from === NONE ? null : { from, to: this.tree.endLeaf[node]! };
  }

  /** The shape of a leaf with geometry. */
  ofLeaf(leaf: number): number {
    const { tree } = this;
    let at = this.roots.find((r) => this.contains(r, leaf)) ?? -1;
    while (at >= 0) {
      const inner = [...this.children(at)].find((c) => this.contains(c, leaf));
      if (inner === undefined) return tree.firstLeaf[at] === NONE ? -1 : at;
      at = inner;
    }
    return at;
  }

  private contains(node: number, leaf: number): boolean {
    const from = this.tree.firstLeaf[node]!;
    return from !== NONE && from <= leaf && leaf < this.tree.endLeaf[node]!;
  }

  /** What a click on a leaf selects: the lot first, then one level deeper than what is selected. */
  clicked(leaf: number, selected: number, leafAtOnce: boolean): number {
    const shape = this.ofLeaf(leaf);
    if (shape < 0 || leafAtOnce) return shape;
    const path = this.pathTo(shape);
    if (selected < 0) return path[0]!;
    const level = path.indexOf(selected);
    if (level >= 0) return path[Math.min(level + 1, path.length - 1)]!;
    const above = this.pathTo(selected);
    let common = 0;
    while (common < path.length && path[common] === above[common]) ++common;
    return path[Math.min(common, path.length - 1)]!;
  }
}

export interface Row {
  node: number;
  depth: number;
  name: string;
  /** How many equal siblings the row stands for. */
  times: number;
  leaves: number;
  open: boolean;
  parent: boolean;
}

/** The rows of an outline: siblings with one name that follow each other fold to one row. */
export function outline(
  shapes: Shapes,
  open: ReadonlySet<number>,
  unfolded: ReadonlySet<number>,
): Row[] {
  const rows: Row[] = [];
  const visit = (nodes: ArrayLike<number>, depth: number) => {
    for (let i = 0; i < nodes.length;) {
      const node = nodes[i]!;
      const name = shapes.nameOf(node);
      let end = i + 1;
      while (end < nodes.length && shapes.nameOf(nodes[end]!) === name) ++end;
      const folds = end - i > 2 && !unfolded.has(node) && depth > 0;
      const last = folds ? i + 1 : end;
      for (let k = i; k < last; ++k) {
        const each = nodes[k]!;
        const times = folds ? end - i : 1;
        let leaves = 0;
        for (let j = k; j < (folds ? end : k + 1); ++j) leaves += shapes.leaves[nodes[j]!]!;
        const isParent = shapes.children(each).length > 0;
        const isOpen = isParent && open.has(each) && !folds;
        rows.push({
          node: each,
          depth,
          name,
          times,
          leaves,
          open: isOpen,
          parent: isParent || folds,
        });
        if (isOpen) visit(shapes.children(each), depth + 1);
      }
      i = end;
    }
  };
  visit(shapes.roots, 0);
  return rows;
}
