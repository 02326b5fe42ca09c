// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { withoutFolder } from './sharing';
import { check, decode, encode, fromBase64, toBase64, type Bundle } from './share';

const bundle: Bundle = {
  gable: 1,
  name: 'tower',
  main: 'rules/tower.cga',
  place: {
    start: '',
    seed: -5,
    attributes: { 'a.height': '12' },
    shapes: {
      polygon: [
        [0, 0],
        [9, 0],
        [0, 7.5],
      ],
    },
  },
  files: { 'rules/tower.cga': 'Lot --> extrude(10) "ü"', 'lots.geojson': '{}' },
};

it('comesBackFromALinkAndFromAFile', async () => {
  const code = await encode(bundle);
  expect(code).toMatch(/^[\w-]+$/);
  expect(await decode(`http://127.0.0.1:7000/#share=${code}`)).toEqual(bundle);
  expect(await decode(code)).toEqual(bundle);
  expect(await decode(JSON.stringify(bundle, null, 2))).toEqual(bundle);
});

it('countsPathsFromTheFolderOfAllFiles', () => {
  const inside: Bundle = {
    ...bundle,
    main: 'a/b/t.cga',
    files: { 'a/b/t.cga': '', 'a/b/x/l.geojson': '' },
    place: { ...bundle.place, shapes: { file: 'a/b/x/l.geojson', only: [1] } },
  };
  expect(withoutFolder(inside)).toMatchObject({
    main: 't.cga',
    files: { 't.cga': '', 'x/l.geojson': '' },
    place: { shapes: { file: 'x/l.geojson', only: [1] } },
  });
  const apart = { ...inside, files: { ...inside.files, 'rules/w.cga': '' } };
  expect(withoutFolder(apart)).toBe(apart);
});

it('saysWhatIsWrongWithWhatIsNone', async () => {
  expect(await decode('hello')).toMatch(/#share=/);
  expect(await decode(`#share=${(await encode(bundle)).slice(0, 40)}`)).toMatch(/not complete/);
  expect(check('{"gable":1}')).toMatch(/no shared place/);
  const wrong = (part: object) => check(JSON.stringify({ ...bundle, ...part }));
  for (const path of [
    '../x.cga',
    '/etc/x.cga',
    'a/../x.cga',
    '.gable/x.cga',
    'x.sh',
    'a\\b.cga',
    'c:x.cga',
  ]) {
    expect(wrong({ main: path, files: { [path]: '' } }), path).toMatch(/must not/);
  }
  expect(wrong({ main: 'other.cga' })).toMatch(/must not/);
  expect(wrong({ place: { ...bundle.place, shapes: {} } })).toMatch(/cannot be read/);
  expect(wrong({ place: { ...bundle.place, attributes: { a: 1 } } })).toMatch(/cannot be read/);
});

it('carriesBytes', () => {
  const bytes = Uint8Array.from({ length: 70_000 }, (_, i) => i % 256);
  expect(fromBase64(toBase64(bytes))).toEqual(bytes);
});

it('namesAnExampleAndWhatWasChangedInIt', () => {
  const changed = { ...bundle, example: 'tower', main: 'tower/tower.cga', files: {} };
  expect(check(JSON.stringify(changed))).toEqual(changed);
  const wrong = { ...changed, example: '../tower' };
  expect(check(JSON.stringify(wrong))).toBe('This shared place names no example.');
  const outside = { ...changed, main: '../tower.cga' };
  expect(check(JSON.stringify(outside))).toMatch('files that it must not');
});
