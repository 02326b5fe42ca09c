// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Two versions of a text side by side: what is alike, and regions of which one side or the other
// can be taken. What only the other side has changed since both were one text is in already.

import { changes, merge } from './merge';

export interface Region {
  /** Lines of the text up to which it stands. */
  from: number;
  mine: string[];
  theirs: string[];
}

export interface Compared {
  lines: string[];
  regions: Region[];
}

export interface Row {
  kind: 'same' | 'changed' | 'gap';
  mine: string;
  theirs: string;
  /** Which region; -1 for none. */
  region: number;
  /** Of a gap. */
  skipped: number;
}

/** Lines that are shown around a region. */
const AROUND = 2;

export function compare(base: string, mine: string, theirs: string): Compared {
  const lines = merge(base, mine, theirs).text.split('\n');
  const regions = changes(lines, theirs.split('\n')).map((c): Region => ({
    from: c.from,
    mine: lines.slice(c.from, c.to),
    theirs: c.lines,
  }));
  return { lines, regions };
}

/** The text with one side of each region. */
export function chosen({ lines, regions }: Compared, takeTheirs: readonly boolean[]): string {
  const out: string[] = [];
  let at = 0;
  regions.forEach((r, i) => {
    out.push(...lines.slice(at, r.from), ...(takeTheirs[i] ? r.theirs : r.mine));
    at = r.from + r.mine.length;
  });
  return [...out, ...lines.slice(at)].join('\n');
}

/** Both sides line by line; stretches that are alike are folded to a few lines. */
export function sideBySide({ lines, regions }: Compared): Row[] {
  const out: Row[] = [];
  const alike = (from: number, to: number) => {
    for (let i = from; i < to; ++i)
      out.push({ kind: 'same', mine: lines[i]!, theirs: lines[i]!, region: -1, skipped: 0 });
  };
  let at = 0;
  regions.forEach((r, region) => {
    const before = at === 0 ? 0 : Math.min(at + AROUND, r.from);
    const after = Math.max(before, r.from - AROUND);
    alike(at, before);
    if (after > before)
      out.push({ kind: 'gap', mine: '', theirs: '', region: -1, skipped: after - before });
    alike(after, r.from);
    for (let i = 0; i < Math.max(r.mine.length, r.theirs.length); ++i) {
      out.push({
        kind: 'changed',
        mine: r.mine[i] ?? '',
        theirs: r.theirs[i] ?? '',
        region,
        skipped: 0,
      });
    }
    at = r.from + r.mine.length;
  });
  const end = Math.min(lines.length, at + AROUND);
  alike(at, end);
  if (end < lines.length)
    out.push({ kind: 'gap', mine: '', theirs: '', region: -1, skipped: lines.length - end });
  return out;
}
