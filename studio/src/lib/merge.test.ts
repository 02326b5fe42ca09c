// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { describe, expect, it } from 'vitest';
import { changes, merge } from './merge';

/** Numbers that look drawn, the same each time. */
function* drawn(seed: number): Generator<number> {
  for (let x = seed; ;) {
    x = (x * 1103515245 + 12345) % 2147483648;
    yield x / 2147483648;
  }
}

function edited(
  lines: string[],
  next: () => number,
  mark: string,
  from: number,
  to: number,
): string[] {
  const out = [...lines];
  for (let i = 0; i < 4; ++i) {
    const at = from + Math.floor(next() * (to - from - 4));
    if (next() < 0.4) out.splice(at, 1, `${mark}${i}`);
    else if (next() < 0.5) out[at] = `${out[at]}${mark}`;
  }
  return out;
}

describe('changes', () => {
  it('turn one text into the other', () => {
    const source = drawn(7);
    const next = () => source.next().value as number;
    for (let round = 0; round < 200; ++round) {
      const a = Array.from(
        { length: Math.floor(next() * 12) },
        () => 'abcd'[Math.floor(next() * 4)]!,
      );
      const b = Array.from(
        { length: Math.floor(next() * 12) },
        () => 'abcd'[Math.floor(next() * 4)]!,
      );
      const out: string[] = [];
      let at = 0;
      for (const c of changes(a, b)) {
        out.push(...a.slice(at, c.from), ...c.lines);
        at = c.to;
      }
      out.push(...a.slice(at));
      expect(out).toEqual(b);
    }
  });
  it('are few where little has changed', () => {
    expect(changes(['a', 'b', 'c', 'd'], ['a', 'x', 'c', 'd'])).toEqual([
      { from: 1, to: 2, lines: ['x'] },
    ]);
    expect(changes(['a', 'b', 'c', 'd'], ['a', 'b', 'n', 'c', 'd'])).toEqual([
      { from: 2, to: 2, lines: ['n'] },
    ]);
  });
});

describe('merge', () => {
  const base = 'a\nb\nc\nd\ne';
  it('takes what only one side has changed', () => {
    expect(merge(base, 'A\nb\nc\nd\ne', 'a\nb\nc\nd\nE')).toEqual({
      text: 'A\nb\nc\nd\nE',
      conflicts: 0,
    });
    expect(merge(base, base, 'x')).toEqual({ text: 'x', conflicts: 0 });
    expect(merge(base, 'y', base)).toEqual({ text: 'y', conflicts: 0 });
  });
  it('takes once what both have changed alike', () => {
    expect(merge(base, 'a\nX\nc\nd\nE', 'a\nX\nc\nd\ne')).toEqual({
      text: 'a\nX\nc\nd\nE',
      conflicts: 0,
    });
  });
  it('takes lines that were put in and lines that were taken out', () => {
    expect(merge(base, 'a\nb\nn\nc\nd\ne', 'a\nb\nc\nd')).toEqual({
      text: 'a\nb\nn\nc\nd',
      conflicts: 0,
    });
  });
  it('tells of the same line changed in two ways, and keeps mine', () => {
    expect(merge(base, 'a\nb\nM\nd\ne', 'a\nb\nT\nd\ne')).toEqual({
      text: 'a\nb\nM\nd\ne',
      conflicts: 1,
    });
  });
  it('tells of two texts put in at one place', () => {
    expect(merge('a\nb', 'a\nm\nb', 'a\nt\nb').conflicts).toBe(1);
  });
  it('loses nothing of edits in different halves', () => {
    const source = drawn(3);
    const next = () => source.next().value as number;
    for (let round = 0; round < 100; ++round) {
      const lines = Array.from({ length: 40 }, (_, i) => `line ${i}`);
      const mine = [...edited(lines.slice(0, 20), next, 'm', 0, 18), ...lines.slice(20)];
      const theirs = [...lines.slice(0, 20), ...edited(lines.slice(20), next, 't', 3, 20)];
      const whole = [...mine.slice(0, 20), ...theirs.slice(20)].join('\n');
      const merged = merge(lines.join('\n'), mine.join('\n'), theirs.join('\n'));
      expect(merged).toEqual({ text: whole, conflicts: 0 });
    }
  });
});
