// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Merges two edits of one text, line by line: what only one side changed is taken, what both
// changed alike is taken once, and anything else is a conflict. Lines are matched by a longest
// common subsequence (Myers, "An O(ND) difference algorithm and its variations").

export interface Merged {
  text: string;
  /** Both changed the same lines in different ways; `text` then has mine there. */
  conflicts: number;
}

/** A stretch of the first text and what stands in its place in the second. */
export interface Change {
  from: number;
  to: number;
  lines: string[];
}

/** Edits that are further apart than this are one change. */
const MOST_EDITS = 4000;

/** Pairs of equal lines, in order. */
function matches(a: string[], b: string[]): [number, number][] {
  let head = 0;
  while (head < a.length && head < b.length && a[head] === b[head]) ++head;
  let tail = 0;
  while (
    tail < a.length - head &&
    tail < b.length - head &&
    a[a.length - 1 - tail] === b[b.length - 1 - tail]
  )
    ++tail;
  const out: [number, number][] = [];
  for (let i = 0; i < head; ++i) out.push([i, i]);
  out.push(
    ...inner(a.slice(head, a.length - tail), b.slice(head, b.length - tail)).map(
      ([i, k]): [number, number] => [i + head, k + head],
    ),
  );
  for (let i = tail; i > 0; --i) out.push([a.length - i, b.length - i]);
  return out;
}

function inner(a: string[], b: string[]): [number, number][] {
  const n = a.length;
  const m = b.length;
  if (n === 0 || m === 0) return [];
  const most = Math.min(n + m, MOST_EDITS);
  const trail: Map<number, number>[] = [];
  let reach = new Map<number, number>([[1, 0]]);
  for (let d = 0; d <= most; ++d) {
    trail.push(reach);
    const next = new Map(reach);
    for (let k = -d; k <= d; k += 2) {
      const down = k === -d || (k !== d && (reach.get(k - 1) ?? -1) < (reach.get(k + 1) ?? -1));
      let x = down ? (reach.get(k + 1) ?? 0) : (reach.get(k - 1) ?? 0) + 1;
      while (x < n && x - k < m && a[x] === b[x - k]) ++x;
      next.set(k, x);
      if (x >= n && x - k >= m) return walkBack(trail, n, m);
    }
    reach = next;
  }
  return [];
}

function walkBack(trail: Map<number, number>[], n: number, m: number): [number, number][] {
  const out: [number, number][] = [];
  let x = n;
  let y = m;
  for (let d = trail.length - 1; d >= 0; --d) {
    const reach = trail[d]!;
    const k = x - y;
    const down = k === -d || (k !== d && (reach.get(k - 1) ?? -1) < (reach.get(k + 1) ?? -1));
    const before = down ? k + 1 : k - 1;
    const px = reach.get(before) ?? 0;
    const py = px - before;
    while (x > px && y > py) out.push([--x, --y]);
    x = px;
    y = py;
  }
  return out.reverse();
}

/** What turns one text into the other. */
export function changes(before: string[], after: string[]): Change[] {
  const out: Change[] = [];
  let i = 0;
  let k = 0;
  for (const [x, y] of [...matches(before, after), [before.length, after.length] as const]) {
    if (x > i || y > k) out.push({ from: i, to: x, lines: after.slice(k, y) });
    i = x + 1;
    k = y + 1;
  }
  return out;
}

export function merge(base: string, mine: string, theirs: string): Merged {
  if (mine === theirs || theirs === base) return { text: mine, conflicts: 0 };
  if (mine === base) return { text: theirs, conflicts: 0 };
  const lines = base.split('\n');
  const ours = changes(lines, mine.split('\n'));
  const others = changes(lines, theirs.split('\n'));
  const out: string[] = [];
  let conflicts = 0;
  let at = 0;
  while (ours.length || others.length) {
    const from = Math.min(ours[0]?.from ?? Infinity, others[0]?.from ?? Infinity);
    out.push(...lines.slice(at, from));
    // All changes that touch one another are one region, taken from one side.
    let to = from;
    const left: Change[] = [];
    const right: Change[] = [];
    for (let grown = true; grown;) {
      grown = false;
      for (const [list, taken] of [
        [ours, left],
        [others, right],
      ] as const) {
        while (list.length && (list[0]!.from < to || list[0]!.from === from)) {
          const change = list.shift()!;
          taken.push(change);
          to = Math.max(to, change.to);
          grown = true;
        }
      }
    }
    const text = (side: Change[]) => applied(lines, from, to, side);
    const [a, b] = [text(left), text(right)];
    if (left.length && right.length && a.join('\n') !== b.join('\n')) ++conflicts;
    out.push(...(left.length ? a : b));
    at = to;
  }
  out.push(...lines.slice(at));
  return { text: out.join('\n'), conflicts };
}

function applied(lines: string[], from: number, to: number, side: Change[]): string[] {
  const out: string[] = [];
  let at = from;
  for (const change of side) {
    out.push(...lines.slice(at, change.from), ...change.lines);
    at = change.to;
  }
  out.push(...lines.slice(at, to));
  return out;
}
