// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which variants a wall shows: seeds, the values of one attribute, or those of two against each
// other.

import type { Field } from './fields';
import type { Value } from './protocol';

export interface Variant {
  /** Identifies the variant on the wall. */
  key: string;
  seed: number;
  /** Attributes that are set, over those of the place. */
  attributes: Record<string, Value>;
  caption: string[];
}

export interface Axis {
  field: Field;
  from: number;
  to: number;
}

/** The range that a wall begins with: the annotated one, else half to twice the value. */
export function axisOf(field: Field, value: Value): Axis {
  const control = field.control;
  const now = typeof value === 'number' ? value : 0;
  if (control.kind !== 'number') return { field, from: 0, to: 1 };
  const from = control.min ?? (now === 0 ? 0 : Math.min(now / 2, now * 2));
  const to = control.max ?? (now === 0 ? 10 : Math.max(now / 2, now * 2));
  return { field, from, to };
}

/** `count` values along an axis; all there are where they are few. */
export function valuesOf(axis: Axis, count: number): Value[] {
  const control = axis.field.control;
  if (control.kind === 'bool') return [false, true];
  if (control.kind === 'choice')
    return control.choices
      .slice(0, Math.max(count, 12))
      .map((c) => (axis.field.type === 'float' ? Number(c) : c));
  if (control.kind !== 'number') return [];
  const { step } = control;
  const out: number[] = [];
  for (let i = 0; i < count; ++i) {
    const exact = count === 1 ? axis.from : axis.from + ((axis.to - axis.from) * i) / (count - 1);
    const snapped = step ? axis.from + Math.round((exact - axis.from) / step) * step : exact;
    const tidy = Number(snapped.toPrecision(6));
    if (out.at(-1) !== tidy) out.push(tidy);
  }
  return out;
}

const shownValue = (v: Value): string =>
  typeof v === 'number' ? String(Math.round(v * 100) / 100) : String(v);
const unit = (axis: Axis): string =>
  axis.field.control.kind === 'number' ? axis.field.control.unit : '';
const caption = (axis: Axis, v: Value): string =>
  `${axis.field.label} ${shownValue(v)}${unit(axis) ? ` ${unit(axis)}` : ''}`;

/** Seeds from one on, those of the kept ones first. */
export function seedVariants(first: number, kept: number[], count: number): Variant[] {
  const seeds = [...kept];
  for (let s = first; seeds.length < count; s = s >= 0x7fffffff ? 0 : s + 1)
    if (!seeds.includes(s)) seeds.push(s);
  return seeds
    .slice(0, Math.max(count, kept.length))
    .map((seed) => ({ key: `seed ${seed}`, seed, attributes: {}, caption: [`seed ${seed}`] }));
}

export function attributeVariants(
  seed: number,
  across: Axis,
  down: Axis | null,
  columns: number,
  rows: number,
): Variant[] {
  const xs = valuesOf(across, down ? columns : columns * rows);
  const ys: (Value | undefined)[] = down ? valuesOf(down, rows) : [undefined];
  return ys.flatMap((y) =>
    xs.map((x): Variant => {
      const attributes: Record<string, Value> = { [across.field.name]: x };
      const captions = [caption(across, x)];
      if (down && y !== undefined) {
        attributes[down.field.name] = y;
        captions.push(caption(down, y));
      }
      return { key: JSON.stringify(attributes), seed, attributes, caption: captions };
    }),
  );
}

/** By how many percent a number differs from another; null where that says nothing. */
export function percent(now: number, then: number): number | null {
  if (!Number.isFinite(now) || !Number.isFinite(then) || now === 0 || now === then) return null;
  return Math.round((100 * (then - now)) / Math.abs(now));
}

/** Variants that show how far a wall reaches: its corners, or a few seeds. */
export function extremes(variants: Variant[], columns: number): Variant[] {
  const rows = Math.ceil(variants.length / columns);
  const at = [0, columns - 1, (rows - 1) * columns, variants.length - 1];
  return [...new Set(at)].flatMap((i) => variants[i] ?? []);
}

export interface Reach {
  min: [number, number, number];
  max: [number, number, number];
}

/** The box that holds both. */
export function union(a: Reach | null, b: Reach): Reach {
  const pick = (f: (x: number, y: number) => number, p: number[], q: number[]) =>
    p.map((v, i) => f(v, q[i]!)) as [number, number, number];
  return a ? { min: pick(Math.min, a.min, b.min), max: pick(Math.max, a.max, b.max) } : b;
}
