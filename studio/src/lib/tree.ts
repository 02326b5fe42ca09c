// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The derivation tree for people: children, paths that survive a new derivation, the shape that a
// click means.

import type { Outlined } from './outline';
import { NONE, type Tree } from './protocol';

export class Shapes implements Outlined {
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

  isParent(node: number): boolean {
    return this.childStart[node + 1]! > this.childStart[node]!;
  }

  leavesOf(node: number): number {
    return this.leaves[node]!;
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
