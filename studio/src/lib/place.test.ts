// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import type { Example } from './client';
import { argumentsOf, newPlace, placeBeside, standpointOf } from './place';

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

it('takes the lot of rules in a folder from what lies beside them', async () => {
  const files = ['suburb/suburb.cga', 'suburb/generate.args', 'row/row.cga', 'row/generate.args']
    .concat(['row/buildings.geojson', 'plain/plain.cga', 'lot.cga', 'generate.args'])
    .map((path) => ({ path }));
  const read = (path: string) =>
    path === 'generate.args'
      ? Promise.reject(new Error())
      : Promise.resolve('--lot 320x300 --seed 4\n');
  const suburb = await placeBeside('suburb/suburb.cga', files, read);
  expect(suburb).toMatchObject({ seed: 4, shapes: { lot: [320, 300] } });
  const row = await placeBeside('row/row.cga', files, read);
  expect(row).toMatchObject({ seed: 4, shapes: { file: 'row/buildings.geojson' } });
  expect(await placeBeside('plain/plain.cga', files, read)).toEqual(newPlace());
  expect(await placeBeside('lot.cga', files, read)).toEqual(newPlace());
});

it('says a place as the command line takes it', () => {
  expect(argumentsOf(newPlace())).toBe('--lot 20x30');
  const place = {
    ...newPlace(),
    seed: 7,
    start: 'Lot',
    attributes: { height: '12', paint: "it's red" },
    shapes: { file: 'my lots.geojson' },
  };
  expect(argumentsOf(place)).toBe(
    `--shapes 'my lots.geojson' --start Lot --seed 7 --set height=12 --set 'paint=it'\\''s red'`,
  );
});
