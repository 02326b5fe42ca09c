// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import { expect, test } from 'vitest';
import { pathText, standAt, timesOf, type CameraPath, type Point } from './camera_path';

const at = (...eye: Point) => ({ eye, target: [0, 0, 0] as Point, fov: 50 });
const open: CameraPath = {
  stops: [at(10, 2, 0), at(10, 2, 10), at(0, 2, 10)],
  speed: 2,
  closed: false,
};

test('times go by the way between the eyes', () => {
  expect(timesOf(open)).toEqual([0, 5, 10]);
  expect(timesOf({ ...open, stops: [at(1, 1, 1), at(1, 1, 1)] })).toEqual([0, 0.5]);
  expect(timesOf({ ...open, closed: true })).toHaveLength(4);
});

test('each stop is passed, and ends stay where they are', () => {
  for (const path of [open, { ...open, closed: true }]) {
    const times = timesOf(path);
    path.stops.forEach(({ eye }, i) => {
      standAt(path, times[i]!).eye.forEach((v, k) => expect(v).toBeCloseTo(eye[k]!));
    });
  }
  expect(standAt(open, 99).eye).toEqual([0, 2, 10]);
  expect(standAt(open, -1).eye).toEqual([10, 2, 0]);
  const { eye } = standAt({ ...open, closed: true }, timesOf({ ...open, closed: true })[3]!);
  eye.forEach((v, k) => expect(v).toBeCloseTo([10, 2, 0][k]!));
});

test('it goes on without a jerk', () => {
  const speed = (t: number) => {
    const [a, b] = [standAt(open, t - 1e-3).eye, standAt(open, t + 1e-3).eye];
    return a.map((v, k) => (b[k]! - v) / 2e-3);
  };
  speed(5 - 2e-3).forEach((v, k) => expect(v).toBeCloseTo(speed(5 + 2e-3)[k]!, 1));
});

test('a single stop stays', () => {
  expect(standAt({ ...open, stops: [at(1, 2, 3)] }, 4).eye).toEqual([1, 2, 3]);
});

test('the file is what the program reads', () => {
  const told = JSON.parse(pathText({ ...open, closed: true })) as Record<string, unknown>;
  expect(told).toMatchObject({ speed: 2, closed: true });
  expect((told.stops as unknown[])[0]).toEqual({ eye: [10, 2, 0], target: [0, 0, 0], fov: 50 });
});
