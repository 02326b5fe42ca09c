// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { freePath, kindOf } from './dropped';

it('knows what a project takes', () => {
  expect(kindOf('house.cga')).toBe('rules');
  expect(kindOf('Town.GEOJSON')).toBe('shapes');
  expect(kindOf('place.gable.json')).toBe('shared');
  expect(kindOf('window.obj')).toBe('model');
  expect(kindOf('run.sh')).toBeNull();
  expect(kindOf('cga')).toBeNull();
});

it('writes over nothing', () => {
  const taken = new Set(['a.cga', 'a-2.cga', 'assets/b.png']);
  expect(freePath('a.cga', taken)).toBe('a-3.cga');
  expect(freePath('assets/b.png', taken)).toBe('assets/b-2.png');
  expect(freePath('c.cga', taken)).toBe('c.cga');
});
