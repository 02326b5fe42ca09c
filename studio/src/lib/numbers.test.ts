// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { byKey, niceStep, paceOf, snapped } from './numbers';

const key = (name: string, shiftKey = false) => ({ key: name, shiftKey });

it('steps count from the least value, and end within the range', () => {
  const grid = { min: 3.2, max: 9, step: 0.5 };
  expect(snapped(4, grid, 1)).toBe(4.2);
  expect(snapped(0, grid, 1)).toBe(3.2);
  expect(snapped(40, grid, 1)).toBe(8.7);
});

it('without steps values lie on a pace, and in the range', () => {
  expect(snapped(4.321, { min: 0, max: 10 }, 0.1)).toBe(4.3);
  expect(snapped(-1, { min: 0.25, max: 10 }, 0.1)).toBe(0.25);
  expect(snapped(123.4, {}, 5)).toBe(125);
  expect(niceStep(0.27)).toBeCloseTo(0.2);
  expect(paceOf({ min: 0, max: 27 }, 3)).toBeCloseTo(0.2);
});

it('keys go one step or ten, and to the ends of a range', () => {
  const grid = { min: 3, max: 30 };
  expect(byKey(key('ArrowUp'), 9, grid)).toBeCloseTo(9.2);
  expect(byKey(key('ArrowLeft', true), 9, grid)).toBeCloseTo(7);
  expect(byKey(key('End'), 9, grid)).toBe(30);
  expect(byKey(key('Home'), 9, {})).toBeNull();
  expect(byKey(key('x'), 9, grid)).toBeNull();
});
