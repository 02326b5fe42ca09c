// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Selection: the one shape that all panels show. In a model with too many shapes for a tree it is
// one that a picked leaf is below, Far.

import type { EngineClient } from './client';
import { Far } from './far';
import type { Model } from './model.svelte';
import type { Shapes } from './tree';

export type Reveal = (file: string, line: number, column?: number, focus?: boolean) => void;

/** What the selection needs of the page around it. */
export interface SelectionHost {
  readonly client: EngineClient;
  readonly model: Model;
  /** Set by the editor. */
  readonly reveal: Reveal | null;
  /** A shape of the tree was chosen. */
  chosen(node: number): void;
}

export class Selection {
  /** A node of the tree; -1 for none. */
  node = $state(-1);
  hovered = $state(-1);
  far = $state.raw<Far | null>(null);
  /** Where the node is in the derivation: it is found again in the next one. */
  private address: string[] = [];

  constructor(private readonly host: SelectionHost) {}

  clear(): void {
    this.node = -1;
    this.far = null;
    this.address = [];
  }

  /** The tree is another. */
  findAgain(shapes: Shapes): void {
    this.far = null;
    this.node = this.address.length ? shapes.find(this.address) : -1;
    this.hovered = -1;
  }

  select(node: number, reveal = true): void {
    const { shapes } = this.host.model;
    this.node = node;
    this.host.chosen(node);
    this.address = node >= 0 && shapes ? shapes.address(node) : [];
    if (reveal && node >= 0 && shapes) this.revealShape(shapes, node);
  }

  /**
   * Selects a leaf of a model with too many shapes for a tree, or the part `level` of those above
   * it; -1 for none.
   */
  async selectFar(leaf: number, level?: number): Promise<void> {
    const { model, client } = this.host;
    const { derivation } = model;
    const info = leaf < 0 ? null : await client.leaf(derivation, leaf).catch(() => null);
    if (derivation !== model.derivation) return;
    this.goFar(info ? new Far(leaf, info, level) : null);
  }

  goFar(far: Far | null): void {
    this.far = far;
    if (!far) return;
    const rule = far.isLeaf ? undefined : this.host.model.ruleNamed(far.name);
    this.host.reveal?.(rule?.file ?? far.info.file ?? '', rule?.line ?? far.info.line ?? 1);
  }

  /** Selects the shape above. */
  up(): void {
    if (this.far) return this.goFar(this.far.up);
    const { shapes } = this.host.model;
    if (!shapes || this.node < 0) return;
    const path = shapes.pathTo(this.node);
    this.select(path.length > 1 ? path[path.length - 2]! : -1);
  }

  /** The initial shape of the selection; -1 without one. */
  get lot(): number {
    const { shapes } = this.host.model;
    return this.node >= 0 && shapes ? shapes.tree.shape[this.node]! : -1;
  }

  private revealShape(shapes: Shapes, node: number): void {
    const file = shapes.tree.files[shapes.tree.file[node]!] ?? '';
    const place = this.host.model.ruleOf(node);
    this.host.reveal?.(place?.file ?? file, place?.line ?? shapes.tree.line[node]!);
  }
}
