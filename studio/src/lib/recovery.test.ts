// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { Recovery, type Store } from './recovery';

function store(): Store {
  const files = new Map<string, string>();
  return {
    recovery: (path) => Promise.resolve(files.get(path) ?? null),
    keepRecovery: (path, text) => Promise.resolve(void files.set(path, text)),
    dropRecovery: (path) => Promise.resolve(void files.delete(path)),
  };
}

const SAVED = 'a\nb\nc\nd\ne';

it('gives each page its own text again', async () => {
  const shared = store();
  await new Recovery(shared, 'one').keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  await new Recovery(shared, 'two').keep('x.cga', 'a\nb\nc\nd\nE', SAVED);
  expect((await new Recovery(shared, 'one').recall('x.cga', SAVED)).text).toBe('A\nb\nc\nd\ne');
  expect((await new Recovery(shared, 'two').recall('x.cga', SAVED)).text).toBe('a\nb\nc\nd\nE');
});

it('joins for a new page what others had', async () => {
  const shared = store();
  await new Recovery(shared, 'one').keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  await new Recovery(shared, 'two').keep('x.cga', 'a\nb\nc\nd\nE', SAVED);
  expect(await new Recovery(shared, 'new').recall('x.cga', SAVED)).toEqual({
    text: 'A\nb\nc\nd\nE',
    aside: [],
  });
  expect((await new Recovery(shared, 'new').recall('y.cga', SAVED)).text).toBe(SAVED);
});

it('puts aside what cannot be joined', async () => {
  const shared = store();
  await new Recovery(shared, 'one').keep('x.cga', 'A1\nb\nc\nd\ne', SAVED);
  await new Recovery(shared, 'two').keep('x.cga', 'A2\nb\nc\nd\ne', SAVED);
  expect(await new Recovery(shared, 'new').recall('x.cga', SAVED)).toEqual({
    text: 'A2\nb\nc\nd\ne',
    aside: ['A1\nb\nc\nd\ne'],
  });
});

it('forgets what was saved', async () => {
  const shared = store();
  const one = new Recovery(shared, 'one');
  await one.keep('x.cga', 'A', SAVED);
  await one.drop('x.cga');
  expect((await new Recovery(shared, 'new').recall('x.cga', SAVED)).text).toBe(SAVED);
  await one.keep('x.cga', 'A', SAVED);
  expect((await new Recovery(shared, 'one').recall('x.cga', SAVED)).text).toBe('A');
});

it('does not bring back what was saved meanwhile', async () => {
  const shared = store();
  const one = new Recovery(shared, 'one');
  await one.keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  const later = 'A\nb\nc\nd\nE2';
  expect((await new Recovery(shared, 'new').recall('x.cga', later)).text).toBe(later);
  expect((await new Recovery(shared, 'one').recall('x.cga', later)).text).toBe(later);
  // Undone: there is nothing to be kept.
  await one.keep('x.cga', SAVED, SAVED);
  expect((await new Recovery(shared, 'new').recall('x.cga', 'z')).text).toBe('z');
});

it('is done with the edits of others once they are saved', async () => {
  const shared = store();
  await new Recovery(shared, 'one').keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  const next = new Recovery(shared, 'next');
  await next.recall('x.cga', SAVED);
  await next.drop('x.cga');
  expect((await new Recovery(shared, 'new').recall('x.cga', SAVED)).text).toBe(SAVED);
});
