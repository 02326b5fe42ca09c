// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { lengths } from './measure';

it('tells lengths across, up and along', () => {
  expect(lengths([0, 0, 0], [3, 12, 4])).toEqual({
    length: 13,
    across: 5,
    up: 12,
    slope: (Math.atan2(12, 5) * 180) / Math.PI,
  });
  expect(lengths([1, 5, 1], [1, 2, 1])).toEqual({ length: 3, across: 0, up: -3, slope: 90 });
  expect(lengths([1, 1, 1], [1, 1, 1])).toEqual({ length: 0, across: 0, up: 0, slope: 0 });
});
