// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import type { DrawList } from '../lib/protocol';
import {
  boundsOf,
  fitted,
  ninth,
  placed,
  placedList,
  resized,
  rotation,
  saveTrouble,
  snapped,
  type Preparation,
  type Triple,
} from './asset';

const plain: Preparation = { pivot: [0, 0, 0], size: [1, 1, 1], rotate: [0, 0, 0], zUp: false };
const close = (a: Triple, b: Triple) => a.forEach((v, i) => expect(v).toBeCloseTo(b[i]!, 9));

/** A triangle in a batch. */
const list = (position: number[], matrix?: number[]): DrawList => ({
  leaves: 1,
  truncated: false,
  looks: [],
  batches: [
    {
      look: 0,
      position: Float32Array.from(position),
      normal: Float32Array.from(position.map((_, i) => (i % 3 === 1 ? 1 : 0))),
      index: Uint32Array.from([0, 1, 2]),
      color: new Uint8Array(),
      leaf: new Float32Array(),
      ...(matrix ? { matrix: Float32Array.from(matrix) } : {}),
    },
  ],
});

it('turnsAsTheEngineDoes', () => {
  close(placed([1, 0, 0], { ...plain, rotate: [0, 90, 0] }), [0, 0, -1]);
  close(placed([0, 1, 0], { ...plain, rotate: [90, 0, 0] }), [0, 0, 1]);
  close(placed([2, 1, 1], { ...plain, pivot: [1, 1, 1], rotate: [0, 0, 90] }), [1, 2, 1]);
  close(placed([0, 0, 5], { ...plain, zUp: true }), [0, 5, 0]);
  const m = rotation([20, 30, 40]);
  expect(m[0]! ** 2 + m[3]! ** 2 + m[6]! ** 2).toBeCloseTo(1, 9);
});

it('movesBatchesAndInstancesAlike', () => {
  const prep: Preparation = { ...plain, zUp: true, rotate: [0, 90, 0] };
  const merged = boundsOf(placedList(list([0, 0, 0, 1, 0, 0, 0, 0, 3]), prep));
  const instanced = boundsOf(
    placedList(
      list([0, 0, 0, 1, 0, 0, 0, 0, 3], [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
      prep,
    ),
  );
  close(merged.max, instanced.max);
  close(merged.min, [0, 0, -1]);
  close(merged.max, [0, 3, 0]);
});

it('fitsSnapsAndKeepsTheRatio', () => {
  const box = { min: [-1, 0, -2] as Triple, max: [3, 6, 2] as Triple };
  expect(fitted(box, [-1, 0, -2])).toEqual([4, 6, 4]);
  expect(fitted(box, [-1, 6, -2])).toEqual([4, 1, 4]);
  expect(ninth(box, 0, 2)).toEqual([-1, 0, 2]);
  expect(ninth(box, 1, 1)).toEqual([1, 0, 0]);
  expect(resized([4, 6, 2], 1, 3, true)).toEqual([2, 3, 1]);
  expect(resized([4, 6, 2], 1, 3, false)).toEqual([4, 3, 2]);
  expect(resized([4, 6, 2], 0, -5, false)[0]).toBe(0.001);
  expect(snapped(1.23, 0.05)).toBe(1.25);
});

it('saysWhatKeepsAShapeFromBeingSaved', () => {
  expect(saveTrouble('', [1, 1, 1])).toMatch(/needs a name/);
  expect(saveTrouble('a b', [1, 1, 1])).toMatch(/letters/);
  expect(saveTrouble('wall', [1, 0, 1])).toMatch(/above zero/);
  expect(saveTrouble('wall_2', [1, 2, 1])).toBeNull();
});
