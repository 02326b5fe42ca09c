// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import { satisfies } from 'semver';
import { expect, test } from 'vitest';
import lock from './package-lock.json';

type Locked = { version?: string; resolved?: string; engines?: { node?: string } };
const packages: [string, Locked][] = Object.entries(lock.packages as Record<string, Locked>);

test('every locked package runs on the oldest node that the scripts accept', () => {
  const asksForMore = packages.filter(
    ([, p]) => p.engines?.node && !satisfies('18.18.0', p.engines.node),
  );
  expect(asksForMore.map(([path]) => path)).toEqual([]);
});

test('every locked package comes from the public registry', () => {
  const elsewhere = packages.filter(
    ([, p]) => p.resolved && !p.resolved.startsWith('https://registry.npmjs.org/'),
  );
  expect(elsewhere.map(([path]) => path)).toEqual([]);
});
