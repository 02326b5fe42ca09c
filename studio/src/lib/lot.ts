// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Drawing a lot on the ground: points in plan (x east, y north), snapped to corners, right angles
// and a grid.

export type Point = [number, number];

export interface Snap {
  point: Point;
  /** What it was snapped to. */
  to: 'corner' | 'close' | 'angle' | 'grid' | 'none';
}

export interface SnapOptions {
  /** Metres within which corners draw a point to them. */
  reach: number;
  /** 0 for no grid. */
  grid: number;
  free: boolean;
}

const ANGLE_DEGREES = 5;

export const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
const tidy = (v: number): number => Math.round(v * 1000) / 1000 + 0;

/** Where a point goes that is to follow a ring. Others are the corners of other lots. */
export function snap(at: Point, ring: Point[], others: Point[], o: SnapOptions): Snap {
  const plain: Point = [tidy(at[0]), tidy(at[1])];
  if (o.free) return { point: plain, to: 'none' };
  const first = ring[0];
  if (ring.length >= 3 && first && distance(at, first) <= o.reach)
    return { point: first, to: 'close' };
  let nearest: Point | null = null;
  for (const c of [...others, ...ring.slice(0, -1)])
    if (distance(at, c) <= o.reach && (!nearest || distance(at, c) < distance(at, nearest)))
      nearest = c;
  if (nearest) return { point: nearest, to: 'corner' };
  const last = ring.at(-1);
  if (last) {
    const length = distance(at, last);
    const angle = Math.atan2(at[1] - last[1], at[0] - last[0]);
    const before = ring.at(-2);
    const base = before ? Math.atan2(last[1] - before[1], last[0] - before[0]) : 0;
    for (const zero of before ? [base, 0] : [0]) {
      const quarter = Math.round((angle - zero) / (Math.PI / 4)) * (Math.PI / 4) + zero;
      if (Math.abs(angle - quarter) * (180 / Math.PI) > ANGLE_DEGREES || length === 0) continue;
      const along = o.grid > 0 ? Math.round(length / o.grid) * o.grid : length;
      return {
        point: [
          tidy(last[0] + Math.cos(quarter) * along),
          tidy(last[1] + Math.sin(quarter) * along),
        ],
        to: 'angle',
      };
    }
  }
  if (o.grid <= 0) return { point: plain, to: 'none' };
  return {
    point: [tidy(Math.round(at[0] / o.grid) * o.grid), tidy(Math.round(at[1] / o.grid) * o.grid)],
    to: 'grid',
  };
}

/** The point in a direction from another at a length. */
export function atLength(from: Point, towards: Point, length: number): Point {
  const d = distance(from, towards);
  if (d === 0) return from;
  return [
    tidy(from[0] + ((towards[0] - from[0]) * length) / d),
    tidy(from[1] + ((towards[1] - from[1]) * length) / d),
  ];
}

/** Above zero for a ring that runs counter-clockwise. */
export function signedArea(ring: Point[]): number {
  let sum = 0;
  ring.forEach((p, i) => {
    const q = ring[(i + 1) % ring.length]!;
    sum += p[0] * q[1] - q[0] * p[1];
  });
  return sum / 2;
}

function crosses(a: Point, b: Point, c: Point, d: Point): boolean {
  const side = (p: Point, q: Point, r: Point) =>
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

/** A sentence where a ring is no lot, or null. */
export function trouble(ring: Point[]): string | null {
  if (ring.length < 3) return 'A lot has three corners at least.';
  for (let i = 0; i < ring.length; ++i) {
    for (let k = i + 2; k < ring.length; ++k) {
      if (i === 0 && k === ring.length - 1) continue;
      if (crosses(ring[i]!, ring[i + 1]!, ring[k]!, ring[(k + 1) % ring.length]!))
        return 'The outline crosses itself.';
    }
  }
  return Math.abs(signedArea(ring)) < 0.01 ? 'The outline encloses nothing.' : null;
}

/** Without corners that follow each other at one place, counter-clockwise. */
export function cleaned(ring: Point[]): Point[] {
  const out = ring.filter(
    (p, i) => distance(p, ring[(i + ring.length - 1) % ring.length]!) > 1e-6 || ring.length === 1,
  );
  return signedArea(out) < 0 ? [...out].reverse() : out;
}
