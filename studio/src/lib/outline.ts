// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The rows of an outline of shapes: equal siblings fold to one row.

/** Shapes below each other, by number. */
export interface Outlined {
  readonly roots: ArrayLike<number>;
  nameOf(node: number): string;
  /** Those that are known. */
  children(node: number): ArrayLike<number>;
  /** There are some, known or not. */
  isParent(node: number): boolean;
  /** Leaves with geometry below it, itself included. */
  leavesOf(node: number): number;
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
  shapes: Outlined,
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
        for (let j = k; j < (folds ? end : k + 1); ++j) leaves += shapes.leavesOf(nodes[j]!);
        const isParent = shapes.isParent(each);
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
