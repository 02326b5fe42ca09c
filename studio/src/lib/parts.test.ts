// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { Far } from './far';
import { outline } from './outline';
import { Parts } from './parts.svelte';
import type { LeafInfo, PartsBelow } from './protocol';

const BELOW: Record<string, PartsBelow['parts']> = {
  '0 0': [
    ['Lot', 0, 3, false],
    ['Lot', 3, 7, false],
  ],
  '0 1': [['House', 0, 3, false]],
  '3 1': [['House', 3, 7, false]],
  '3 2': [
    ['Wall', 3, 4, true],
    ['Wall', 4, 5, true],
    ['Wall', 5, 6, true],
    ['Roof', 6, 7, true],
  ],
};

function told() {
  const asked: string[] = [];
  const parts = new Parts(async (leaf, level) => {
    asked.push(`${leaf} ${level}`);
    return Promise.resolve({ parts: BELOW[`${leaf} ${level}`] ?? [], more: 0 });
  });
  return { parts, asked };
}

const lines = (parts: Parts, open: number[], unfolded: number[] = []) =>
  outline(parts, new Set(open), new Set(unfolded)).map(
    (r) => `${' '.repeat(r.depth)}${r.name}${r.times > 1 ? ` x ${r.times}` : ''} ${r.leaves}`,
  );

it('asks for a level when it is opened, once', async () => {
  const { parts, asked } = told();
  await parts.load();
  expect(lines(parts, [])).toEqual(['Lot 3', 'Lot 4']);
  await Promise.all([parts.load(1), parts.load(1)]);
  expect(asked).toEqual(['0 0', '3 1']);
  await parts.load(2);
  expect(lines(parts, [1, 2])).toEqual(['Lot 3', 'Lot 4', ' House 4', '  Wall x 3 3', '  Roof 1']);
  expect(parts.isParent(parts.children(2)[0]!)).toBe(false);
  expect(parts.placeOf(2)).toEqual({ leaf: 3, level: 1 });
});

it('finds what was picked, and what is above it', async () => {
  const { parts, asked } = told();
  const info = {
    name: 'Wall',
    above: [
      { name: 'Lot', from: 3, to: 7 },
      { name: 'House', from: 3, to: 7 },
    ],
  } as LeafInfo;
  const wall = await parts.reveal(new Far(4, info));
  expect(asked).toEqual(['0 0', '3 1', '3 2']);
  expect([parts.nameOf(wall), ...parts.above(wall).map((n) => parts.nameOf(n))]).toEqual([
    'Wall',
    'Lot',
    'House',
  ]);
  expect(lines(parts, parts.above(wall), [3])).toEqual([
    'Lot 3',
    'Lot 4',
    ' House 4',
    '  Wall 1',
    '  Wall 1',
    '  Wall 1',
    '  Roof 1',
  ]);
  expect(parts.find(new Far(4, info, 0))).toBe(1);
});

it('asks again where an answer did not come', async () => {
  let fails = true;
  const parts = new Parts(async () => {
    if (fails) throw new Error('gone');
    return Promise.resolve({ parts: BELOW['0 0']!, more: 5 });
  });
  await parts.load();
  expect(parts.roots).toEqual([]);
  fails = false;
  await parts.load();
  expect([parts.roots.length, parts.more]).toEqual([2, 5]);
});
