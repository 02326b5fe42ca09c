// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, test } from 'vitest';
import { Marking } from './marking';

test('only what differs is a change', () => {
  const marking = new Marking();
  expect(marking.outlines).toBe(false);
  expect(marking.select(null)).toBe(false);
  expect(marking.select({ from: 2, to: 5 })).toBe(true);
  expect(marking.select({ from: 2, to: 5 })).toBe(false);
  expect(marking.marks.selected.value.toArray()).toEqual([2, 5]);
  expect(marking.outlines).toBe(true);
  expect(marking.hover({ from: 1, to: 2 })).toBe(true);
  expect(marking.select(null)).toBe(true);
  expect(marking.hover(null)).toBe(true);
  expect(marking.outlines).toBe(false);
  expect(marking.setScopes([])).toBe(false);
  expect(marking.setScope(null)).toBe(false);
  expect(marking.setStep(3, null)).toBe(true);
  expect(marking.setStep(3, null)).toBe(false);
});
