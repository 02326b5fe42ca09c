// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, test } from 'vitest';
import { Pace, SHARES } from './pace';

test('late pictures get coarser down to an end', () => {
  const pace = new Pace(false);
  expect(pace.share).toBe(1);
  for (let i = 0; i < 10; ++i) pace.took(0.3);
  expect(pace.share).toBe(SHARES[0]);
});

test('a row of early pictures makes them finer, a late one ends the row', () => {
  const pace = new Pace(true);
  const before = pace.share;
  for (let i = 0; i < 11; ++i) pace.took(0.005);
  pace.took(0.03);
  for (let i = 0; i < 11; ++i) pace.took(0.005);
  expect(pace.share).toBe(before);
  pace.took(0.005);
  expect(pace.share).toBeGreaterThan(before);
  for (let i = 0; i < 100; ++i) pace.took(0.005);
  expect(pace.share).toBe(1);
});
