// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import functions from '../../../docs/reference/functions.md?raw';
import operations from '../../../docs/reference/operations.md?raw';
import { meant, namesMeant } from './also';

it('finds operations by what people call them', () => {
  expect([...meant('divide into floors').keys()]).toContain('split');
  expect([...meant('cut').keys()]).toContain('split');
  expect([...meant('random').keys()]).toContain('rand');
  expect([...meant('delete face').keys()]).toContain('NIL');
  for (const word of ['windows', 'chance', 'mansard', 'boolean', 'stairs', 'arch'])
    expect(meant(word).size).toBeGreaterThan(0);
  expect(meant('qqq zz').size).toBe(0);
});

it('leads to names that there are', () => {
  for (const name of namesMeant()) expect(operations + functions).toContain(name);
});
