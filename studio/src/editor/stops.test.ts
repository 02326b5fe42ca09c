// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, test } from 'vitest';
import { linesOf, ruleOfLine } from './stops';

const rule = (name: string, file: string, line: number) => ({
  name,
  file,
  line,
  parameters: 0,
  start: false,
  hidden: false,
  annotations: [],
});
const rules = [rule('Lot', 'a.cga', 4), rule('Wall', 'a.cga', 9), rule('b.Roof', 'b.cga', 6)];

test('a line belongs to the rule that begins there or above, in its own file', () => {
  expect(ruleOfLine(rules, 'x/a.cga', 3)).toBeUndefined();
  expect(ruleOfLine(rules, 'x/a.cga', 4)?.name).toBe('Lot');
  expect(ruleOfLine(rules, 'x/a.cga', 8)?.name).toBe('Lot');
  expect(ruleOfLine(rules, 'a.cga', 99)?.name).toBe('Wall');
  expect(ruleOfLine(rules, 'b.cga', 99)?.name).toBe('b.Roof');
});

test('stops stand where their rules begin', () => {
  expect(linesOf(rules, 'a.cga', new Set(['Wall', 'b.Roof', 'gone']))).toEqual([9]);
});
