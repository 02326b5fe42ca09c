// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { describe, expect, it } from 'vitest';
import { NONE, type Tree } from './protocol';
import { outline } from './outline';
import { Shapes } from './tree';

/** A tree from lines that are indented by one blank a level; a name with a dot is a leaf. */
function grow(text: string): Shapes {
  const lines = text.split('\n').filter((l) => l.trim());
  const n = lines.length;
  const names = [...new Set(lines.map((l) => l.trim()))];
  const column = () => new Uint32Array(n);
  const tree: Tree = {
    count: n,
    end: 'done',
    names,
    files: ['a.cga'],
    notes: [],
    parent: column().fill(NONE),
    shape: column(),
    name: column(),
    file: column(),
    line: column(),
    column: column(),
    endLine: column(),
    endColumn: column(),
    firstLeaf: column().fill(NONE),
    endLeaf: column().fill(NONE),
    flags: column(),
    before: column(),
    after: column(),
    frame: new Float32Array(n * 12),
    size: new Float32Array(n * 3),
  };
  const stack: number[] = [];
  let leaf = 0;
  lines.forEach((line, i) => {
    const depth = line.length - line.trimStart().length;
    stack.length = depth;
    tree.parent[i] = depth ? stack[depth - 1]! : NONE;
    tree.name[i] = names.indexOf(line.trim());
    stack[depth] = i;
    if (!line.trim().endsWith('.')) return;
    tree.flags[i] = 1;
    for (const each of stack) {
      if (tree.firstLeaf[each] === NONE) tree.firstLeaf[each] = leaf;
      tree.endLeaf[each] = leaf + 1;
    }
    ++leaf;
  });
  return new Shapes(tree);
}

const HOUSE = `
Lot
 House
  Wall
   Brick.
   Brick.
   Pane.
  Wall
   Brick.
  Roof.
 Garden.
`;
const named = (s: Shapes, node: number) => (node < 0 ? '' : s.nameOf(node));

describe('shapes', () => {
  const s = grow(HOUSE);
  it('count their leaves', () => {
    expect([...s.leaves]).toEqual([6, 5, 3, 1, 1, 1, 1, 1, 1, 1]);
  });
  it('are found by their leaf', () => {
    expect(s.pathTo(s.ofLeaf(2)).map((n) => s.nameOf(n))).toEqual([
      'Lot',
      'House',
      'Wall',
      'Pane.',
    ]);
    expect(named(s, s.ofLeaf(5))).toBe('Garden.');
    expect(s.ofLeaf(99)).toBe(-1);
  });
  it('are clicked one level deeper each time', () => {
    let at = -1;
    const seen: string[] = [];
    for (let i = 0; i < 5; ++i) seen.push(named(s, (at = s.clicked(0, at, false))));
    expect(seen).toEqual(['Lot', 'House', 'Wall', 'Brick.', 'Brick.']);
    expect(named(s, s.clicked(5, at, false))).toBe('Garden.');
    expect(named(s, s.clicked(2, -1, true))).toBe('Pane.');
  });
  it('keep their address over derivations, or give the shape above', () => {
    const second = s.address(6);
    expect(second).toEqual(['Lot#0', 'House#0', 'Wall#1']);
    expect(s.find(second)).toBe(6);
    const changed = grow('Lot\n Shed.\n House\n  Wall\n   Brick.\n');
    expect(named(changed, changed.find(second))).toBe('House');
    expect(grow('Park.\n').find(second)).toBe(-1);
  });
});

describe('the outline', () => {
  const s = grow('Lot\n Floor\n  Pane.\n Floor\n  Pane.\n Floor\n  Pane.\n Roof.\n');
  it('folds equal siblings until they are unfolded', () => {
    const rows = outline(s, new Set([0]), new Set());
    expect(rows.map((r) => `${r.name} ${r.times} ${r.leaves}`)).toEqual([
      'Lot 1 4',
      'Floor 3 3',
      'Roof. 1 1',
    ]);
    expect(outline(s, new Set([0]), new Set([1])).map((r) => r.name)).toEqual([
      'Lot',
      'Floor',
      'Floor',
      'Floor',
      'Roof.',
    ]);
  });
  it('shows what is open', () => {
    expect(outline(s, new Set(), new Set()).length).toBe(1);
  });
});
