// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Numbers as sliders and handles change them: within a range, on its steps, which count from its
// least value.

export interface Grid {
  min?: number | undefined;
  max?: number | undefined;
  step?: number | undefined;
}

export type Way = 'up' | 'down' | 'least' | 'most';

/** 1, 2 or 5 times a power of ten, not above a size. */
export function niceStep(size: number): number {
  const ten = 10 ** Math.floor(Math.log10(size));
  return size / ten >= 5 ? 5 * ten : size / ten >= 2 ? 2 * ten : ten;
}

export const ranged = ({ min, max }: Grid): boolean =>
  min !== undefined && max !== undefined && max > min;

/** What a slider of 200 pixels is long. */
export const spanOf = (grid: Grid, value: number): number =>
  ranged(grid) ? grid.max! - grid.min! : Math.max(1, Math.abs(value));

/** How far a key or the least move goes. */
export const paceOf = (grid: Grid, value: number): number =>
  grid.step || niceStep(spanOf(grid, value) / 100);

export function clamped(value: number, { min, max }: Grid): number {
  return Math.max(min ?? -Infinity, Math.min(max ?? Infinity, value));
}

/** The nearest value of the grid: on a step of its own, or on `pace` where it has none. */
export function snapped(value: number, grid: Grid, pace: number): number {
  const from = grid.step ? (grid.min ?? 0) : 0;
  const size = grid.step || pace;
  const on = from + Math.round((value - from) / size) * size;
  if (grid.step && grid.max !== undefined && on > grid.max)
    return tidy(from + Math.floor((grid.max - from) / size + 1e-9) * size);
  return tidy(clamped(on, grid));
}

/** Without the last digits, which are noise. */
const tidy = (value: number): number => Number(value.toPrecision(12));

const WAYS: Record<string, Way> = {
  ArrowUp: 'up',
  ArrowRight: 'up',
  ArrowDown: 'down',
  ArrowLeft: 'down',
  Home: 'least',
  End: 'most',
};

/** What a key makes of a value, ten steps at once with Shift; null for a key that does nothing. */
export function byKey(
  event: { key: string; shiftKey: boolean },
  value: number,
  grid: Grid,
): number | null {
  const way = WAYS[event.key];
  if (!way) return null;
  if (way === 'least' || way === 'most')
    return ranged(grid) ? snapped(way === 'least' ? grid.min! : grid.max!, grid, 1e-9) : null;
  const pace = paceOf(grid, value);
  return snapped(value + (way === 'up' ? 1 : -1) * pace * (event.shiftKey ? 10 : 1), grid, pace);
}
