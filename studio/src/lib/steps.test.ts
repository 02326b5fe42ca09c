// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { NONE, type Tree } from './protocol';
import { RULE_CALL, Steps } from './steps';
import { Shapes } from './tree';

/** Lot is replaced by two walls and a leaf; the first wall by a leaf, the second stays as it is. */
function house(): Steps {
  const nodes: [string, number, number, number, number][] = [
    // name, parent, flags, before, after
    ['Lot', NONE, RULE_CALL, 0, NONE],
    ['Wall', 0, RULE_CALL, 1, NONE],
    ['Brick', 1, 1, NONE, 2],
    ['Wall', 0, RULE_CALL | 1, 3, 4],
    ['Roof', 0, 1, NONE, 5],
  ];
  const names = ['Lot', 'Wall', 'Brick', 'Roof'];
  const column = (f: (n: (typeof nodes)[number]) => number) => Uint32Array.from(nodes.map(f));
  const none = () => new Uint32Array(nodes.length);
  const size = Float32Array.from([8, 3, 8, 4, 3, 0, 4, 3, 0, 4, 3, 0, 8, 0, 8]);
  const tree: Tree = {
    count: nodes.length,
    end: 'done',
    names,
    files: [],
    notes: [],
    parent: column((n) => n[1]),
    shape: none(),
    name: column((n) => names.indexOf(n[0])),
    file: none(),
    line: none(),
    column: none(),
    endLine: none(),
    endColumn: none(),
    firstLeaf: none(),
    endLeaf: none(),
    flags: column((n) => n[2]),
    before: column((n) => n[3]),
    after: column((n) => n[4]),
    frame: new Float32Array(nodes.length * 12),
    size,
  };
  return new Steps(new Shapes(tree));
}

it('has a step for each shape that a rule rewrites, in order', () => {
  const steps = house();
  expect(steps.nodes).toEqual([0, 1, 3]);
  expect([...steps.replacedIn]).toEqual([1, 2, 0, 3, 0]);
});

it('knows when each shape is there', () => {
  const steps = house();
  expect([0, 1, 2, 3].map((s) => steps.time(0, s))).toEqual([
    'now',
    'replaced',
    'replaced',
    'replaced',
  ]);
  expect([0, 1, 2, 3].map((s) => steps.time(1, s))).toEqual([
    'later',
    'now',
    'replaced',
    'replaced',
  ]);
  expect([0, 1, 2, 3].map((s) => steps.time(2, s))).toEqual(['later', 'later', 'now', 'now']);
  expect([0, 1, 2, 3].map((s) => steps.time(3, s))).toEqual(['later', 'now', 'now', 'now']);
});

it('shows each leaf from the step that makes it up to the one that replaces it', () => {
  const lives = house().lives(6);
  const life = (leaf: number) => [lives[leaf * 2], lives[leaf * 2 + 1]];
  expect(life(0)).toEqual([0, 1]);
  expect(life(1)).toEqual([1, 2]);
  expect(life(2)).toEqual([2, 1e9]);
  expect(life(3)).toEqual([1, 3]);
  expect(life(4)).toEqual([3, 1e9]);
  expect(life(5)).toEqual([1, 1e9]);
});

it('says what a step has made', () => {
  expect(house().made(1)).toEqual([
    { name: 'Wall', count: 2, extent: 4 },
    { name: 'Roof', count: 1, extent: 0 },
  ]);
  expect(house().made(3)).toEqual([]);
});

it('finds the next stop both ways', () => {
  const steps = house();
  expect(steps.nextStop(0, true, new Set(['Wall']))).toBe(2);
  expect(steps.nextStop(2, true, new Set(['Wall']))).toBe(3);
  expect(steps.nextStop(2, false, new Set(['Lot']))).toBe(1);
  expect(steps.nextStop(3, true, new Set(['Wall']))).toBe(0);
});
