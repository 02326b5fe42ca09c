// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, test } from 'vitest';
import { rowsOf, titleOf } from './features';

const villa = {
  id: 'Building/way/1',
  shape: 'Building',
  name: 'Villa',
  type: 'yes',
  levels: -1,
  height: 12.3456,
  attributes: '{"building":"yes","has_parts":false,"note":""}',
};

test('what a thing is called comes first, else what it is', () => {
  expect(titleOf(villa)).toBe('Villa');
  expect(titleOf({ ...villa, name: '' })).toBe('Building');
});

test('what is not known is not shown', () => {
  expect(rowsOf(villa)).toEqual([
    ['shape', 'Building'],
    ['type', 'yes'],
    ['height', '12.35'],
    ['id', 'Building/way/1'],
    ['building', 'yes'],
    ['has_parts', 'false'],
  ]);
});

test('attributes that cannot be read are none', () => {
  expect(rowsOf({ shape: 'Lot', attributes: '{' })).toEqual([['shape', 'Lot']]);
});
