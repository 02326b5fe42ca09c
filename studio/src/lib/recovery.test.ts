// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { Recovery, type Store } from './recovery';
import { Unsent } from './unsent';

function store(): Store {
  const files = new Map<string, string>();
  return {
    recovery: (path) => Promise.resolve(files.get(path) ?? null),
    keepRecovery: (path, text) => Promise.resolve(void files.set(path, text)),
    dropRecovery: (path) => Promise.resolve(void files.delete(path)),
  };
}

function unsent(texts = new Map<string, string>(), page = 'one'): Unsent {
  const browser = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, value: string) => void texts.set(key, value),
    removeItem: (key: string) => void texts.delete(key),
  };
  return new Unsent(browser, page, () => '/places');
}

const SAVED = 'a\nb\nc\nd\ne';

it('gives each page its own text again', async () => {
  const shared = store();
  await new Recovery(shared, 'one', unsent()).keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  await new Recovery(shared, 'two', unsent()).keep('x.cga', 'a\nb\nc\nd\nE', SAVED);
  expect((await new Recovery(shared, 'one', unsent()).recall('x.cga', SAVED)).text).toBe(
    'A\nb\nc\nd\ne',
  );
  expect((await new Recovery(shared, 'two', unsent()).recall('x.cga', SAVED)).text).toBe(
    'a\nb\nc\nd\nE',
  );
});

it('joins for a new page what others had', async () => {
  const shared = store();
  await new Recovery(shared, 'one', unsent()).keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  await new Recovery(shared, 'two', unsent()).keep('x.cga', 'a\nb\nc\nd\nE', SAVED);
  expect(await new Recovery(shared, 'new', unsent()).recall('x.cga', SAVED)).toEqual({
    text: 'A\nb\nc\nd\nE',
    aside: [],
  });
  expect((await new Recovery(shared, 'new', unsent()).recall('y.cga', SAVED)).text).toBe(SAVED);
});

it('puts aside what cannot be joined', async () => {
  const shared = store();
  await new Recovery(shared, 'one', unsent()).keep('x.cga', 'A1\nb\nc\nd\ne', SAVED);
  await new Recovery(shared, 'two', unsent()).keep('x.cga', 'A2\nb\nc\nd\ne', SAVED);
  expect(await new Recovery(shared, 'new', unsent()).recall('x.cga', SAVED)).toEqual({
    text: 'A2\nb\nc\nd\ne',
    aside: ['A1\nb\nc\nd\ne'],
  });
});

it('forgets what was saved', async () => {
  const shared = store();
  const one = new Recovery(shared, 'one', unsent());
  await one.keep('x.cga', 'A', SAVED);
  await one.drop('x.cga');
  expect((await new Recovery(shared, 'new', unsent()).recall('x.cga', SAVED)).text).toBe(SAVED);
  await one.keep('x.cga', 'A', SAVED);
  expect((await new Recovery(shared, 'one', unsent()).recall('x.cga', SAVED)).text).toBe('A');
});

it('does not bring back what was saved meanwhile', async () => {
  const shared = store();
  const one = new Recovery(shared, 'one', unsent());
  await one.keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  const later = 'A\nb\nc\nd\nE2';
  expect((await new Recovery(shared, 'new', unsent()).recall('x.cga', later)).text).toBe(later);
  expect((await new Recovery(shared, 'one', unsent()).recall('x.cga', later)).text).toBe(later);
  // Undone: there is nothing to be kept.
  await one.keep('x.cga', SAVED, SAVED);
  expect((await new Recovery(shared, 'new', unsent()).recall('x.cga', 'z')).text).toBe('z');
});

it('is done with the edits of others once they are saved', async () => {
  const shared = store();
  await new Recovery(shared, 'one', unsent()).keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  const next = new Recovery(shared, 'next', unsent());
  await next.recall('x.cga', SAVED);
  await next.drop('x.cga');
  expect((await new Recovery(shared, 'new', unsent()).recall('x.cga', SAVED)).text).toBe(SAVED);
});

it('finds in the browser what no server has had', async () => {
  const shared = store();
  const browser = new Map<string, string>();
  const one = new Recovery(shared, 'one', unsent(browser));
  await one.keep('x.cga', 'A\nb\nc\nd\ne', SAVED);
  one.keepHere('x.cga', 'A!\nb\nc\nd\ne', SAVED);
  const two = new Recovery(shared, 'two', unsent(browser, 'two'));
  expect((await two.recall('x.cga', SAVED)).text).toBe('A!\nb\nc\nd\ne');
  await two.keep('x.cga', 'A!\nb\nc\nd\ne', SAVED);
  expect(browser.size).toBe(0);
});

it('keeps in the browser what the server has only where it differs', async () => {
  const browser = new Map<string, string>();
  const one = new Recovery(store(), 'one', unsent(browser));
  await one.keep('x.cga', 'A', SAVED);
  one.keepHere('x.cga', 'A', SAVED);
  one.keepHere('y.cga', SAVED, SAVED);
  expect(browser.size).toBe(0);
});
