// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { describe, expect, it } from 'vitest';
import { applied, difference, History, inverse, type Step } from './history';

const text = (before: string, after: string): Step => ({
  label: 'Typing',
  texts: [difference('a.cga', before, after)!],
  place: null,
});
const place = (before: number, after: number): Step => ({
  label: 'height',
  texts: [],
  place: { main: 'a.cga', before: String(before), after: String(after) },
});

describe('difference', () => {
  it('isTheSmallestChangeAndCanBeTakenBack', () => {
    expect(difference('p', 'abc', 'abc')).toBeNull();
    expect(difference('p', 'aaa', 'aa')).toEqual({ path: 'p', at: 2, removed: 'a', inserted: '' });
    for (const [a, b] of [
      ['', 'x'],
      ['one two', 'one three two'],
      ['aXa', 'aa'],
      ['tower', 'flower'],
    ] as const) {
      const change = difference('p', a, b)!;
      expect(applied(a, change)).toBe(b);
      expect(applied(b, inverse(change))).toBe(a);
    }
    expect(applied('other', { path: 'p', at: 0, removed: 'x', inserted: '' })).toBeNull();
  });
});

describe('History', () => {
  it('joinsTypingAndEndsAStepAfterAPause', () => {
    let time = 0;
    const history = new History(() => time);
    let now = '';
    const type = (next: string) => {
      history.record(text(now, next), 'text');
      now = next;
      time += 100;
    };
    for (const each of ['a', 'ab', 'abc', 'ab', 'abd']) type(each);
    time += 1000;
    type('abde');
    expect(history.undoSteps).toBe(2);
    for (const change of history.undo()!.texts) now = applied(now, change)!;
    expect(now).toBe('abd');
    for (const change of history.undo()!.texts) now = applied(now, change)!;
    expect(now).toBe('');
    for (const change of history.redo()!.texts) now = applied(now, change)!;
    for (const change of history.redo()!.texts) now = applied(now, change)!;
    expect(now).toBe('abde');
  });

  it('backspacesBeyondWhatWasTyped', () => {
    const history = new History(() => 0);
    let now = 'ab';
    for (const next of ['abc', 'ab', 'a', '']) {
      history.record(text(now, next), 'text');
      now = next;
    }
    expect(history.undoSteps).toBe(1);
    for (const change of history.undo()!.texts) now = applied(now, change)!;
    expect(now).toBe('ab');
  });

  it('makesOneStepOfADragAndKeepsTheOrderOfTime', () => {
    const history = new History(() => 0);
    history.record(text('', 'a'), 'text');
    for (let i = 0; i < 5; ++i) history.record(place(i, i + 1), 'height');
    expect(history.undoSteps).toBe(2);
    expect(history.undo()!.place).toEqual({ main: 'a.cga', before: '5', after: '0' });
    expect(history.redo()!.place!.after).toBe('5');
    history.close();
    history.record(place(5, 6), 'height');
    expect(history.undoSteps).toBe(3);
    expect(history.redoSteps).toBe(0);
  });

  it('survivesAReload', () => {
    const history = new History(() => 0);
    history.record(text('', 'a'), 'text');
    history.record(place(1, 2), 'height');
    const next = new History();
    next.recall(history.keep());
    expect(next.undoLabel).toBe('height');
    next.undo();
    expect(next.undo()!.texts[0]).toEqual({ path: 'a.cga', at: 0, removed: 'a', inserted: '' });
    next.recall('{"done":1}');
    next.recall('nonsense');
    expect(next.redoSteps).toBe(2);
  });
});

it('makes one step of a gesture, however long it takes, and takes it back whole', () => {
  let now = 0;
  const history = new History(() => now);
  const drag = (before: string, after: string, gesture: number) => {
    now += 900;
    history.record({ label: 'h', texts: [], place: { main: 'a', before, after } }, 'h', gesture);
  };
  drag('1', '2', 1);
  drag('2', '3', 1);
  drag('3', '4', 2);
  expect(history.undoSteps).toBe(2);
  expect(history.takeBack(1)).toBeNull();
  expect(history.takeBack(2)?.place).toMatchObject({ before: '4', after: '3' });
  expect([history.undoSteps, history.redoSteps]).toEqual([1, 0]);
  // Dragged there and back again: nothing has happened.
  drag('3', '5', 3);
  drag('5', '3', 3);
  expect(history.undoSteps).toBe(1);
});
