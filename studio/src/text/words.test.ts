// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import page from '../../../docs/reference/operations.md?raw';
import { readRegistry } from '../lib/registry';
import { findWord, leanedOn, wordsOf } from './words';

const registry = readRegistry({
  operations: [
    {
      name: 'split',
      summary: 'Divides the shape.',
      block: '{ size : rules }',
      overloads: [{ params: [{ name: 'axis', type: 'word', doc: 'Along it.' }] }],
    },
    { name: 'innerRectangle', summary: 'The largest rectangle.', overloads: [{ params: [] }] },
  ],
  functions: [],
  attributes: [{ name: 'scope.sx', type: 'float', doc: 'The size along x.' }],
  selectors: [],
});

it('explainsOwnWordsByTheOperationThatDoesThem', () => {
  const split = findWord(wordsOf('GBBG', registry), 'Split', 'GBBG')!;
  expect(split.text).toMatch(/widths.*Done by split\./);
  expect(split.snippet).toContain('Split(');
  expect(findWord(wordsOf('Park', registry), 'innerrect', 'Park')!.text).toMatch(
    /largest rectangle/,
  );
  expect(findWord(wordsOf('GBBG', registry), 'split', 'GBBG')).toBeUndefined();
});

it('takesGablesOwnWordsFromTheRegistry', () => {
  const words = wordsOf('CGA', registry);
  expect(findWord(words, 'split', 'CGA')).toMatchObject({
    signatures: ['split(axis)'],
    snippet: 'split(${1:1}) { ${2:~1} : ${3:A} }',
  });
  expect(findWord(words, 'scope.sx', 'CGA')!.snippet).toBe('');
  expect(findWord(words, '@Range', 'CGA')!.kind).toBe('annotation');
});

it('leansOnOperationsThatExist', () => {
  for (const name of leanedOn()) expect(page).toContain(`[\`${name}\`]`);
});

it('insertsCallsThatAreNoMistake', () => {
  const roof = readRegistry({
    operations: [
      {
        name: 'roofGable',
        summary: 'A roof.',
        overloads: [
          {
            params: [
              { name: 'angle', type: 'float', doc: '' },
              { name: 'path', type: 'string', doc: '' },
              { name: 'axis', type: 'selector', doc: '', words: 'x y z' },
              { name: 'even', type: 'bool', doc: '', default: 'false' },
            ],
          },
        ],
      },
    ],
    functions: [],
    attributes: [],
    selectors: [],
  });
  expect(wordsOf('CGA', roof)[0]!.snippet).toBe('roofGable(${1:30}, ${2:""}, ${3:x})');
});
