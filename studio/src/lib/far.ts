// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Far: a shape of a model that has too many shapes for a tree at once. What the engine knows of one
// leaf has the shapes above it that were derived on their own, so that one can go up from it.

import type { LeafInfo } from './protocol';

export class Far {
  /** `level`: which of those above, from 0; as many as there are for the leaf itself. */
  constructor(
    readonly leaf: number,
    readonly info: LeafInfo,
    readonly level = info.above.length,
  ) {}

  get isLeaf(): boolean {
    return this.level === this.info.above.length;
  }

  get name(): string {
    return this.info.above[this.level]?.name ?? this.info.name;
  }

  /** The leaves below it. */
  get range(): { from: number; to: number } {
    return this.info.above[this.level] ?? { from: this.leaf, to: this.leaf + 1 };
  }

  /** From the initial shape to the leaf. */
  get path(): Far[] {
    return Array.from({ length: this.info.above.length + 1 }, (_, level) => this.at(level));
  }

  at(level: number): Far {
    return new Far(this.leaf, this.info, level);
  }

  /** The shape above; null for the initial one. */
  get up(): Far | null {
    return this.level > 0 ? this.at(this.level - 1) : null;
  }

  get box(): { frame: Float32Array; size: Float32Array } | null {
    return this.isLeaf
      ? { frame: Float32Array.from(this.info.frame), size: Float32Array.from(this.info.size) }
      : null;
  }
}
