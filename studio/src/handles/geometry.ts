// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Points of the world and of the picture, as far as handles need them.

import type { ScopeBox } from '../view/boxes';

export type P3 = [number, number, number];
export interface P2 {
  x: number;
  y: number;
}

export const plus = (a: P3, b: P3, times = 1): P3 => [
  a[0] + b[0] * times,
  a[1] + b[1] * times,
  a[2] + b[2] * times,
];
export const minus = (a: P3, b: P3): P3 => plus(a, b, -1);
export const dot = (a: P3, b: P3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: P3): number => Math.sqrt(dot(a, a));
export const mid = (a: P3, b: P3): P3 => plus(a, minus(b, a), 0.5);
export const cross = (a: P3, b: P3): P3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
/** Of length one; nothing stays nothing. */
export const unit = (a: P3): P3 => {
  const l = length(a);
  return l > 0 ? [a[0] / l, a[1] / l, a[2] / l] : a;
};

/** What somebody looks through. */
export interface Eye {
  position: P3;
  width: number;
  height: number;
  /** Where a point is in the picture, in pixels; null behind the camera. */
  project(at: P3): P2 | null;
  /** From the eye through a pixel, of length one. */
  ray(at: P2): P3;
}

/** How many pixels one metre along a direction is at a point. */
export function pixelsAMetre(eye: Eye, at: P3, along: P3): number {
  const step = length(minus(at, eye.position)) / 1000;
  const [a, b] = [eye.project(at), eye.project(plus(at, along, step))];
  return a && b ? Math.hypot(b.x - a.x, b.y - a.y) / step : 0;
}

/** How far along a line it is nearest to what a pixel shows; null where one looks along it. */
export function alongLine(eye: Eye, from: P3, along: P3, at: P2): number | null {
  const ray = eye.ray(at);
  const b = dot(along, ray);
  const flat = 1 - b * b;
  if (flat < 1e-4) return null;
  const w = minus(from, eye.position);
  return (b * dot(ray, w) - dot(along, w)) / flat;
}

/** Where a pixel's ray meets a plane; null where it does not. */
export function onPlane(eye: Eye, through: P3, normal: P3, at: P2): P3 | null {
  const ray = eye.ray(at);
  const slope = dot(ray, normal);
  if (Math.abs(slope) < 1e-6) return null;
  const t = dot(minus(through, eye.position), normal) / slope;
  return t > 0 ? plus(eye.position, ray, t) : null;
}

/** The outline around points, as they follow each other around it. */
export function hull(points: P2[]): P2[] {
  const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  const half = (all: P2[]): P2[] => {
    const out: P2[] = [];
    for (const p of all) {
      while (out.length > 1) {
        const [a, b] = [out[out.length - 2]!, out[out.length - 1]!];
        if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Whether a point lies in an outline of `hull`, or nearer to it than a margin. */
export function inHull(outline: P2[], p: P2, margin: number): boolean {
  return outline.every((a, i) => {
    const b = outline[(i + 1) % outline.length]!;
    const side = Math.hypot(b.x - a.x, b.y - a.y) || 1;
    return ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / side > -margin;
  });
}

/** How near two lines of the picture come to each other, by some of their points. */
export function gap(a: [P2, P2], b: [P2, P2]): number {
  const from = (p: P2, [c, d]: [P2, P2]): number => {
    const [x, y] = [d.x - c.x, d.y - c.y];
    const t = Math.max(0, Math.min(1, ((p.x - c.x) * x + (p.y - c.y) * y) / (x * x + y * y || 1)));
    return Math.hypot(c.x + x * t - p.x, c.y + y * t - p.y);
  };
  const between = ([p, q]: [P2, P2], t: number): P2 => ({
    x: p.x + (q.x - p.x) * t,
    y: p.y + (q.y - p.y) * t,
  });
  let least = Infinity;
  for (const t of [0, 0.25, 0.5, 0.75, 1])
    least = Math.min(least, from(between(a, t), b), from(between(b, t), a));
  return least;
}

/** A scope: its origin, its axes and its size along them. */
export interface Box {
  origin: P3;
  axes: [P3, P3, P3];
  size: P3;
}

export function boxFrom({ frame, size }: ScopeBox): Box {
  const at = (i: number): P3 => [frame[i]!, frame[i + 1]!, frame[i + 2]!];
  return { origin: at(0), axes: [at(3), at(6), at(9)], size: [size[0]!, size[1]!, size[2]!] };
}

/** A point by shares of the size, 0 to 1. */
export function pointIn({ origin, axes, size }: Box, share: P3): P3 {
  let out = origin;
  for (const i of [0, 1, 2] as const) out = plus(out, axes[i], size[i] * share[i]);
  return out;
}

export const cornersOf = (box: Box): P3[] =>
  Array.from({ length: 8 }, (_, i) => pointIn(box, [i & 1, (i >> 1) & 1, i >> 2]));
