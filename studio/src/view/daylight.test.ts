// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import { expect, test } from 'vitest';
import { daylight } from './daylight';

test('it is darker the lower the sun stands, and never all dark', () => {
  let before = Infinity;
  for (let elevation = 60; elevation >= -30; elevation -= 1) {
    const { skyStrength, air, strength } = daylight(elevation);
    expect(skyStrength).toBeLessThanOrEqual(before);
    expect(skyStrength).toBeGreaterThan(0.2);
    expect(air).toBeGreaterThan(0);
    expect(strength).toBeGreaterThanOrEqual(0);
    before = skyStrength;
  }
});

test('rooms are lit at night alone', () => {
  expect(daylight(20).lit).toBe(0);
  expect(daylight(2).lit).toBe(0);
  expect(daylight(-3).lit).toBeGreaterThan(0);
  expect(daylight(-10).lit).toBeCloseTo(0.4);
});

test('the light changes from sun to moon where neither is seen', () => {
  expect(daylight(-1.99).strength).toBeLessThan(0.01);
  expect(daylight(-2.01).strength).toBeLessThan(0.01);
  expect(daylight(-15).moon).toBe(true);
});
