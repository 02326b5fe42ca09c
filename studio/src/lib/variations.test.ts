// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import type { Field } from './fields';
import {
  attributeVariants,
  axisOf,
  extremes,
  percent,
  seedVariants,
  union,
  valuesOf,
} from './variations';

const number = (min?: number, max?: number, step?: number): Field => ({
  name: 'house.height',
  label: 'height',
  doc: '',
  type: 'float',
  group: '',
  control: {
    kind: 'number',
    unit: 'm',
    ...(min === undefined ? {} : { min }),
    ...(max === undefined ? {} : { max }),
    ...(step === undefined ? {} : { step }),
  },
});
const choice: Field = {
  name: 'paint',
  label: 'paint',
  doc: '',
  type: 'string',
  group: '',
  control: { kind: 'choice', choices: ['red', 'blue'], free: false },
};

it('beginsWithTheAnnotatedRange', () => {
  expect(axisOf(number(3, 30), 9)).toMatchObject({ from: 3, to: 30 });
  expect(axisOf(number(), 9)).toMatchObject({ from: 4.5, to: 18 });
  expect(axisOf(number(), -2)).toMatchObject({ from: -4, to: -1 });
  expect(axisOf(number(), 0)).toMatchObject({ from: 0, to: 10 });
});

it('keepsToStepsAndNamesEachValueOnce', () => {
  expect(valuesOf(axisOf(number(1, 3, 1), 1), 12)).toEqual([1, 2, 3]);
  expect(valuesOf(axisOf(number(0, 1), 1), 3)).toEqual([0, 0.5, 1]);
  expect(valuesOf(axisOf(choice, 'red'), 12)).toEqual(['red', 'blue']);
});

it('setsTwoAttributesAgainstEachOther', () => {
  const wall = attributeVariants(7, axisOf(number(1, 2), 1), axisOf(choice, 'red'), 3, 2);
  expect(wall.length).toBe(6);
  expect(wall[4]).toMatchObject({
    seed: 7,
    attributes: { 'house.height': 1.5, paint: 'blue' },
    caption: ['height 1.5 m', 'paint blue'],
  });
});

it('keepsStarredSeedsAndStaysInTheRangeOfSeeds', () => {
  expect(seedVariants(5, [9, 6], 4).map((v) => v.seed)).toEqual([9, 6, 5, 7]);
  expect(seedVariants(0x7fffffff, [], 2).map((v) => v.seed)).toEqual([0x7fffffff, 0]);
});

it('comparesNumbers', () => {
  expect(percent(100, 88)).toBe(-12);
  expect(percent(0, 5)).toBeNull();
  expect(percent(5, 5)).toBeNull();
});

it('measuresAWallByItsCorners', () => {
  const wall = seedVariants(0, [], 12);
  expect(extremes(wall, 4).map((v) => v.seed)).toEqual([0, 3, 8, 11]);
  expect(extremes(wall.slice(0, 2), 4).map((v) => v.seed)).toEqual([0, 1]);
  const one = {
    min: [0, 0, 0] as [number, number, number],
    max: [1, 5, 1] as [number, number, number],
  };
  expect(union(one, { min: [-1, 0, 0], max: [1, 2, 3] })).toEqual({
    min: [-1, 0, 0],
    max: [1, 5, 3],
  });
  expect(union(null, one)).toBe(one);
});
