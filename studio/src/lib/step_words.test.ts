// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { NONE, type Tree } from './protocol';
import { RULE_CALL, Steps } from './steps';
import { inWords } from './step_words';
import { Shapes } from './tree';

type Node = {
  name: string;
  at: number[];
  size: number[];
  x?: number[];
  y?: number[];
  z?: number[];
  flags?: number;
};

/** A shape and what stands in its place after the first step. */
function step(parent: Node, ...children: Node[]): string[] {
  const nodes = [parent, ...children];
  const names = [...new Set(nodes.map((n) => n.name))];
  const column = (f: (n: Node, i: number) => number) => Uint32Array.from(nodes.map(f));
  const none = () => new Uint32Array(nodes.length);
  const tree: Tree = {
    count: nodes.length,
    end: 'done',
    names,
    files: [],
    notes: [],
    parent: column((_, i) => (i ? 0 : NONE)),
    shape: none(),
    name: column((n) => names.indexOf(n.name)),
    file: none(),
    line: none(),
    column: none(),
    endLine: none(),
    endColumn: none(),
    firstLeaf: none(),
    endLeaf: none(),
    flags: column((n, i) => n.flags ?? (i ? 1 : RULE_CALL)),
    before: none(),
    after: none(),
    frame: Float32Array.from(
      nodes.flatMap((n) => [
        ...n.at,
        ...(n.x ?? [1, 0, 0]),
        ...(n.y ?? [0, 1, 0]),
        ...(n.z ?? [0, 0, 1]),
      ]),
    ),
    size: Float32Array.from(nodes.flatMap((n) => n.size)),
  };
  return inWords(new Steps(new Shapes(tree)), 1);
}

const wall: Node = { name: 'Wall', at: [5, 0, 0], size: [10, 3, 0] };

it('tells of leaves and of what is dropped', () => {
  expect(step(wall)).toEqual(['Wall stays as it is, as a leaf.']);
  expect(step({ ...wall, flags: RULE_CALL | 2 })).toEqual([
    'Wall was dropped: nothing stands in its place.',
  ]);
});

it('tells how one shape became another', () => {
  expect(step(wall, { ...wall, name: 'Face' })).toEqual([
    'Wall became Face.',
    'The scope is the same.',
  ]);
  const lot: Node = { name: 'Lot', at: [0, 0, 0], size: [20, 0, 30] };
  expect(step(lot, { name: 'Body', at: [0, 2, 0], size: [20, 9, 30] })[1]).toBe(
    '0 m along y became 9 m and it was moved by 2 m.',
  );
  expect(step(lot, { ...lot, name: 'Turned', x: [0, 0, -1], z: [1, 0, 0] })[1]).toBe(
    'It was turned by 90°.',
  );
});

it('tells of splits', () => {
  const bay = (x: number, name: string, width: number): Node => ({
    name,
    at: [5 + x, 0, 0],
    size: [width, 3, 0],
  });
  expect(
    step(wall, bay(0, 'Pier', 1), bay(1, 'Bay', 4), bay(5, 'Bay', 4), bay(9, 'Pier', 1)),
  ).toEqual([
    'Wall became 4 shapes: 2 × Pier and 2 × Bay.',
    'Cut along x, 10 m: 2 × Pier of 1 m and 2 × Bay of 4 m.',
  ]);
  expect(step(wall, bay(0, 'Bay', 4), bay(4, 'Bay', 4))[2]).toBe('2 m of it are left empty.');
});

it('tells of faces, and of shapes that reach further', () => {
  const lot: Node = { name: 'Lot', at: [0, 0, 0], size: [20, 0, 30] };
  const front: Node = { name: 'Wall', at: [0, 0, 30], size: [20, 9, 0] };
  const side: Node = {
    name: 'Wall',
    at: [20, 0, 30],
    size: [30, 9, 0],
    x: [0, 0, -1],
    z: [1, 0, 0],
  };
  expect(step(lot, front, side)).toEqual([
    'Lot became 2 shapes: 2 × Wall.',
    'They are faces, each with a scope of its own.',
    'Together they reach 9 m along y instead of 0 m.',
  ]);
});
