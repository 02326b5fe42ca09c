// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { chosen, compare, sideBySide } from './compare';

const BASE = 'a\nb\nc\nd\ne\nf\ng\nh';

it('has a region for each place where the sides differ, and takes one of them', () => {
  // Theirs alone has changed h: that is in already.
  const both = compare(BASE, 'a\nB1\nc\nd\ne\nf\ng\nh', 'a\nB2\nB3\nc\nd\ne\nf\ng\nH');
  expect(both.regions).toEqual([{ from: 1, mine: ['B1'], theirs: ['B2', 'B3'] }]);
  expect(chosen(both, [false])).toBe('a\nB1\nc\nd\ne\nf\ng\nH');
  expect(chosen(both, [true])).toBe('a\nB2\nB3\nc\nd\ne\nf\ng\nH');
});

it('shows both sides with a few lines around', () => {
  const rows = sideBySide(compare(BASE, 'a\nb\nc\nd\nE1\nf\ng\nh', 'a\nb\nc\nd\nE2\nf\ng\nh'));
  expect(rows.map((r) => (r.kind === 'gap' ? `(${r.skipped})` : `${r.mine}|${r.theirs}`))).toEqual([
    '(2)',
    'c|c',
    'd|d',
    'E1|E2',
    'f|f',
    'g|g',
    '(1)',
  ]);
});

it('puts regions that follow each other in order', () => {
  const both = compare('1\n2\n3', 'x\n2\ny', 'u\n2\nv');
  expect(chosen(both, [true, false])).toBe('u\n2\ny');
  expect(chosen(both, [false, true])).toBe('x\n2\nv');
});
