// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { defaultChange } from './defaults';
import { applyChanges } from './rules';

const files = [
  {
    path: 'a/house.cga',
    text: 'import w : "window.cga"\n@Range(1, 9)\nattr height = 9 // metres\nattr paint = "red"\nLot --> X\n',
  },
  { path: 'a/window.cga', text: 'attr sill = 0.9\nFrame --> NIL\n' },
];

it('writesADefaultAndLeavesTheRest', () => {
  const height = defaultChange(files, 'a/house.cga', 'height', '12.5', 'float')!;
  expect(applyChanges(files[0]!.text, [height.change])).toContain(
    'attr height = 12.5 // metres\nattr paint',
  );
  const paint = defaultChange(files, 'a/house.cga', 'paint', 'say "so"', 'string')!;
  expect(applyChanges(files[0]!.text, [paint.change])).toContain('attr paint = "say \\"so\\""\n');
});

it('findsAttributesOfImports', () => {
  expect(defaultChange(files, 'a/house.cga', 'w.sill', '1', 'float')).toMatchObject({
    path: 'a/window.cga',
    change: { insert: '1' },
  });
  expect(defaultChange(files, 'a/house.cga', 'w.none', '1', 'float')).toBeNull();
  expect(defaultChange(files, 'a/house.cga', 'x.sill', '1', 'float')).toBeNull();
});
