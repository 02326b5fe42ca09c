// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it, vi } from 'vitest';
import { chordOf, commands, runKeys, type Command } from './commands';
import { KEYS } from './keys';
import type { Layout } from './layout.svelte';
import type { Studio } from './studio.svelte';

const key = (key: string, more: Partial<KeyboardEvent> = {}) =>
  ({
    key,
    code: '',
    ctrlKey: false,
    metaKey: false,
    altKey: false,
    shiftKey: false,
    ...more,
  }) as KeyboardEvent;

it('namesKeysAsTheListShowsThem', () => {
  expect(chordOf(key('z', { ctrlKey: true }))).toBe('Ctrl Z');
  expect(chordOf(key('Z', { metaKey: true, shiftKey: true }))).toBe('Ctrl Shift Z');
  expect(chordOf(key('F', { shiftKey: true, altKey: true, code: 'KeyF' }))).toBe('Shift Alt F');
  expect(chordOf(key('?', { shiftKey: true }))).toBe('?');
  expect(chordOf(key('Escape'))).toBe('Esc');
});

it('leavesSingleLettersToTextFields', () => {
  const run = vi.fn();
  const list: Command[] = [
    { title: 'New seed', keys: 'R', icon: '', run },
    { title: 'Save', keys: 'Ctrl S', icon: '', anywhere: true, run },
    { title: 'Never', keys: 'M', icon: '', run, when: () => false },
  ];
  expect(runKeys(list, key('r'), true)).toBe(false);
  expect(runKeys(list, key('r'), false)).toBe(true);
  expect(runKeys(list, key('s', { ctrlKey: true }), true)).toBe(true);
  expect(runKeys(list, key('m'), false)).toBe(true);
  expect(run).toHaveBeenCalledTimes(2);
});

it('givesNoKeysTwice', () => {
  const list = commands({} as Studio, {} as Layout, () => undefined);
  const keys = [...list.map((c) => c.keys).filter(Boolean), ...KEYS.map(([k]) => k)];
  expect(new Set(keys).size).toBe(keys.length);
});
