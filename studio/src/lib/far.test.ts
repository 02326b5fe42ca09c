// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { Far } from './far';
import type { LeafInfo } from './protocol';

const info: LeafInfo = {
  name: 'Pane',
  rule: 'Window',
  file: 'a.cga',
  line: 4,
  faces: 1,
  vertices: 4,
  material: {},
  attributes: {},
  frame: [1, 2, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1],
  size: [1, 2, 0],
  above: [
    { name: 'Town', from: 0, to: 900 },
    { name: 'House', from: 40, to: 60 },
  ],
};

it('goes up from a leaf', () => {
  const leaf = new Far(45, info);
  expect([leaf.name, leaf.isLeaf, leaf.range]).toEqual(['Pane', true, { from: 45, to: 46 }]);
  expect([...leaf.box!.size]).toEqual([1, 2, 0]);
  const house = leaf.up!;
  expect([house.name, house.isLeaf, house.range.from, house.box]).toEqual([
    'House',
    false,
    40,
    null,
  ]);
  expect(house.up!.up).toBeNull();
  expect(house.path.map((f) => f.name)).toEqual(['Town', 'House', 'Pane']);
});
