// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { charts, csv, reportRows, sortRows } from './reports';

const reports = {
  'floor.area.flat': { n: 3, sum: 300, avg: 100, min: 90, max: 110 },
  'floor.area.shop': { n: 1, sum: 100, avg: 100, min: 100, max: 100 },
  height: { n: 1, sum: 12, avg: 12, min: 12, max: 12 },
  'use, of it': { n: 4, values: { flat: 3, shop: 1 } },
};

it('sortsByAnyColumn', () => {
  const rows = reportRows(reports);
  expect(sortRows(rows, 'sum', false).map((r) => r.sum)).toEqual([300, 100, 12, null]);
  expect(sortRows(rows, 'name', true)[0]!.name).toBe('use, of it');
});

it('makesChartsOfPartsAndOfTexts', () => {
  const made = charts(reports);
  expect(made.map((c) => c.title)).toEqual(['use, of it', 'floor.area']);
  expect(made[1]!.shares).toEqual([
    { name: 'flat', value: 300, share: 0.75 },
    { name: 'shop', value: 100, share: 0.25 },
  ]);
});

it('writesATableForSpreadsheets', () => {
  expect(csv(reportRows(reports)).split('\n')[4]).toBe('"use, of it",4,,,,');
});
