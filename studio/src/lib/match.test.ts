// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { match, parts } from './match';

const best = (query: string, texts: string[]) =>
  texts
    .filter((t) => match(query, t))
    .sort((a, b) => match(query, b)!.score - match(query, a)!.score);

it('putsWholeWordsAndBeginningsFirst', () => {
  expect(best('floor', ['GroundFloor', 'Floor', 'floorHeight', 'Roof'])).toEqual([
    'Floor',
    'floorHeight',
    'GroundFloor',
  ]);
});

it('findsByTheLettersOfWords', () => {
  expect(best('fh', ['floorHeight', 'Sheaf', 'roof hip'])).toEqual(['floorHeight', 'roof hip']);
  expect(match('xyz', 'Floor')).toBeNull();
  expect(match('', 'Floor')).toEqual({ score: 0, letters: [] });
});

it('marksWhatWasFound', () => {
  expect(parts('GroundFloor', match('floor', 'GroundFloor')!.letters)).toEqual([
    { text: 'Ground', hit: false },
    { text: 'Floor', hit: true },
  ]);
});
