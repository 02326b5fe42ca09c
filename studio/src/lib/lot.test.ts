// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { atLength, cleaned, distance, signedArea, snap, trouble, type Point } from './lot';

const options = { reach: 1, grid: 0.5, free: false };

it('snapsToCornersAnglesAndTheGrid', () => {
  expect(snap([3.2, 4.4], [], [], options)).toEqual({ point: [3, 4.5], to: 'grid' });
  expect(snap([10.1, 0.4], [[0, 0]], [], options)).toEqual({ point: [10, 0], to: 'angle' });
  expect(
    snap(
      [10.3, 7.1],
      [
        [0, 0],
        [10, 0],
      ],
      [],
      options,
    ),
  ).toEqual({ point: [10, 7], to: 'angle' });
  expect(
    snap(
      [0.4, 0.3],
      [
        [0, 0],
        [10, 0],
        [10, 7],
      ],
      [],
      options,
    ),
  ).toEqual({ point: [0, 0], to: 'close' });
  expect(snap([20.4, 5.2], [[0, 0]], [[20, 5]], options)).toEqual({ point: [20, 5], to: 'corner' });
  expect(snap([3.21, 4.44], [[0, 0]], [[3, 4]], { ...options, free: true })).toEqual({
    point: [3.21, 4.44],
    to: 'none',
  });
});

it('goesOnAtARightAngleToASlantedEdge', () => {
  const ring: Point[] = [
    [0, 0],
    [8, 6],
  ];
  const next = snap([5, 10.2], ring, [], options);
  expect(next.to).toBe('angle');
  expect(distance(next.point, ring[1]!)).toBeCloseTo(5, 2);
  expect((next.point[0] - 8) * 8 + (next.point[1] - 6) * 6).toBeCloseTo(0, 1);
});

it('takesALengthThatIsTyped', () => {
  expect(atLength([0, 0], [3, 4], 10)).toEqual([6, 8]);
  expect(atLength([1, 1], [1, 1], 10)).toEqual([1, 1]);
});

it('saysWhatIsNoLot', () => {
  expect(
    trouble([
      [0, 0],
      [1, 0],
    ]),
  ).toMatch(/three corners/);
  expect(
    trouble([
      [0, 0],
      [5, 5],
      [5, 0],
      [0, 5],
    ]),
  ).toMatch(/crosses/);
  expect(
    trouble([
      [0, 0],
      [5, 0],
      [10, 0],
    ]),
  ).toMatch(/nothing/);
  expect(
    trouble([
      [0, 0],
      [5, 0],
      [5, 5],
      [0, 5],
    ]),
  ).toBeNull();
  const ring = cleaned([
    [0, 5],
    [5, 5],
    [5, 5],
    [5, 0],
    [0, 0],
  ]);
  expect(ring.length).toBe(4);
  expect(signedArea(ring)).toBe(25);
});
