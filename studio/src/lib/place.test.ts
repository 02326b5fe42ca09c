// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import type { Example } from './client';
import { standpointOf } from './place';

const seen = (view: string) => standpointOf({ view } as Example);

it('stands where the picture of an example was taken, for the angle of the page', () => {
  const from = seen('# From above.\n--eye=10,20,30 --target=1,2,3 --fov 28\n--ground "#7f8e55"\n')!;
  from.position.forEach((v, i) => expect(v).toBeCloseTo([10, 20, 30][i]!));
  expect(from.target).toEqual([1, 2, 3]);
  const wide = seen('--eye=0,3,20 --target=0,6,-10 --fov 80')!;
  expect(wide.position[2]).toBeGreaterThan(80);
  expect(wide.position[1]).toBe(1.6);
  expect(seen('')).toBeNull();
  expect(seen('--eye=1,2 --target=0,0,x')).toBeNull();
});
