// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a step of a derivation did, in sentences: what its shape became, and how the scopes of that
// lie in the scope there was. Only scopes are looked at, so it holds for rules of all notations.

import { shown } from './fields';
import type { Steps } from './steps';
import type { Shapes } from './tree';

type Three = [number, number, number];

/** A scope as another one sees it. */
interface Placed {
  /** Along the axes of the other scope. */
  min: Three;
  max: Three;
  parallel: boolean;
  /** Degrees between the first axes of both, or the third where those agree. */
  turned: number;
  moved: number;
}

const AXES = ['x', 'y', 'z'];
/** Metres that make no difference. */
const SAME = 2e-3;

const dot = (a: Three, b: Three) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const less = (a: Three, b: Three): Three => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

function part(shapes: Shapes, node: number, which: number): Three {
  const at = node * 12 + which * 3;
  const { frame } = shapes.tree;
  return [frame[at]!, frame[at + 1]!, frame[at + 2]!];
}

function sizeOf(shapes: Shapes, node: number): Three {
  const { size } = shapes.tree;
  return [size[node * 3]!, size[node * 3 + 1]!, size[node * 3 + 2]!];
}

function seenFrom(shapes: Shapes, node: number, from: number): Placed {
  const origin = less(part(shapes, node, 0), part(shapes, from, 0));
  const axes = [1, 2, 3].map((k) => part(shapes, from, k));
  const own = [1, 2, 3].map((k) => part(shapes, node, k));
  const size = sizeOf(shapes, node);
  const at = axes.map((a) => dot(origin, a)) as Three;
  const out: Placed = {
    min: [...at],
    max: [...at],
    parallel: true,
    turned: 0,
    moved: Math.hypot(...at),
  };
  for (let k = 0; k < 3; ++k) {
    for (let j = 0; j < 3; ++j) {
      const reach = dot(own[j]!, axes[k]!) * size[j]!;
      if (reach < 0) out.min[k]! += reach;
      else out.max[k]! += reach;
    }
    const cosine = Math.min(1, Math.max(-1, dot(own[k]!, axes[k]!)));
    const angle = (Math.acos(cosine) * 180) / Math.PI;
    if (angle > 0.1) out.parallel = false;
    out.turned = Math.max(out.turned, angle);
  }
  return out;
}

/** "a", "a and b", "a, b and c". */
const joined = (all: string[]) =>
  all.length < 2 ? (all[0] ?? '') : `${all.slice(0, -1).join(', ')} and ${all.at(-1)}`;
const metres = (v: number) => `${shown(v)} m`;
const same = (a: number, b: number) => Math.abs(a - b) < SAME * Math.max(1, Math.abs(a));

function one(shapes: Shapes, parent: number, child: number): string[] {
  const seen = seenFrom(shapes, child, parent);
  const [before, after] = [sizeOf(shapes, parent), sizeOf(shapes, child)];
  const out: string[] = [];
  for (let k = 0; k < 3; ++k)
    if (!same(before[k]!, after[k]!))
      out.push(`${metres(before[k]!)} along ${AXES[k]} became ${metres(after[k]!)}`);
  if (seen.moved > SAME) out.push(`it was moved by ${metres(seen.moved)}`);
  if (seen.turned > 0.1) out.push(`it was turned by ${shown(seen.turned)}°`);
  return out.length
    ? [`${joined(out)}.`].map((s) => s[0]!.toUpperCase() + s.slice(1))
    : ['The scope is the same.'];
}

/**
 * Pieces one after the other along an axis, each as wide and deep as the shape was; -1 where they
 * lie otherwise.
 */
function cutAlong(placed: Placed[], size: Three): number {
  return (
    [0, 1, 2].find((k) => {
      const others = [0, 1, 2].filter((j) => j !== k);
      const whole = placed.every(
        (p) => p.parallel && others.every((j) => same(p.min[j]!, 0) && same(p.max[j]!, size[j]!)),
      );
      const ordered = [...placed].sort((a, b) => a.min[k]! - b.min[k]!);
      return (
        whole && ordered.every((p, i) => i === 0 || p.min[k]! > ordered[i - 1]!.max[k]! - SAME)
      );
    }) ?? -1
  );
}

function pieces(
  shapes: Shapes,
  children: number[],
  placed: Placed[],
  axis: number,
  size: Three,
): string[] {
  const groups = new Map<string, number>();
  children.forEach((child, i) => {
    const { min, max } = placed[i]!;
    const key = `${shapes.nameOf(child)} of ${metres(max[axis]! - min[axis]!)}`;
    groups.set(key, (groups.get(key) ?? 0) + 1);
  });
  const told = [...groups].slice(0, 6).map(([what, count]) => `${count} × ${what}`);
  if (groups.size > 6) told.push('others');
  const used = placed.reduce((sum, p) => sum + p.max[axis]! - p.min[axis]!, 0);
  const left = size[axis]! - used;
  return [
    `Cut along ${AXES[axis]}, ${metres(size[axis]!)}: ${joined(told)}.`,
    ...(left > SAME * 5
      ? [`${metres(left)} of it ${children.length > 1 ? 'are' : 'is'} left empty.`]
      : []),
  ];
}

function many(shapes: Shapes, parent: number, children: number[]): string[] {
  const size = sizeOf(shapes, parent);
  const placed = children.map((c) => seenFrom(shapes, c, parent));
  const whole = placed.every(
    (p) => p.parallel && [0, 1, 2].every((k) => same(p.min[k]!, 0) && same(p.max[k]!, size[k]!)),
  );
  if (whole) return ['Each has the scope that there was.'];
  const axis = cutAlong(placed, size);
  if (axis >= 0) return pieces(shapes, children, placed, axis, size);
  const out: string[] = [];
  for (let k = 0; k < 3; ++k) {
    const reach =
      Math.max(...placed.map((p) => p.max[k]!)) - Math.min(...placed.map((p) => p.min[k]!));
    if (reach > size[k]! + 5 * SAME)
      out.push(`${metres(reach)} along ${AXES[k]} instead of ${metres(size[k]!)}`);
  }
  const flat = children.every((c) => sizeOf(shapes, c)[2] < SAME);
  const facing = new Set(
    children.map((c) =>
      part(shapes, c, 3)
        .map((v) => Math.round(v * 50))
        .join(),
    ),
  );
  return [
    ...(flat && facing.size > 1 ? ['They are faces, each with a scope of its own.'] : []),
    ...(out.length ? [`Together they reach ${joined(out)}.`] : []),
  ];
}

/** Sentences about a step; empty for step 0. */
export function inWords(steps: Steps, step: number): string[] {
  const { shapes } = steps;
  const node = steps.nodes[step - 1];
  if (node === undefined) return [];
  const name = shapes.nameOf(node);
  const children = [...steps.children(step)];
  if (!children.length) {
    return [
      shapes.tree.flags[node]! & 2
        ? `${name} was dropped: nothing stands in its place.`
        : `${name} stays as it is, as a leaf.`,
    ];
  }
  const made = steps.made(step).map((m) => (m.count > 1 ? `${m.count} × ${m.name}` : m.name));
  const most = made.length > 6 ? [...made.slice(0, 5), `${made.length - 5} others`] : made;
  const first =
    children.length === 1
      ? `${name} became ${made[0]}.`
      : `${name} became ${children.length} shapes: ${joined(most)}.`;
  return [
    first,
    ...(children.length === 1 ? one(shapes, node, children[0]!) : many(shapes, node, children)),
  ];
}
