// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import { expect, test } from 'vitest';
import { clock, compassAzimuth, dayOf, placeOf, viewAzimuth } from './sun_time';

test('days and places are read, and what is none is told apart', () => {
  expect(dayOf('2024-06-21')).toEqual([2024, 6, 21]);
  expect(dayOf('tomorrow')).toBeNull();
  expect(placeOf(' 43.73, -7.4 ')).toEqual([43.73, -7.4]);
  expect(placeOf('43.73 7')).toEqual([43.73, 7]);
  expect(placeOf('')).toBeNull();
  expect(placeOf('43.73')).toBeUndefined();
  expect(placeOf('here, there')).toBeUndefined();
});

test('hours are told as a clock does', () => {
  expect(clock(0)).toBe('0:00');
  expect(clock(14.25)).toBe('14:15');
  expect(clock(23.999)).toBe('24:00');
});

test('the south is in front of the view, the east to its right', () => {
  expect(viewAzimuth(180)).toBe(0);
  expect(viewAzimuth(90)).toBe(90);
  expect(viewAzimuth(270)).toBe(-90);
  for (let a = -170; a <= 170; a += 10) expect(viewAzimuth(compassAzimuth(a))).toBeCloseTo(a);
});
