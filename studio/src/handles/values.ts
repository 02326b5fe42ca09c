// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From lengths in the view to values of attributes and back.

import { shown, type Field } from '../lib/fields';
import { niceStep, snapped, type Grid } from '../lib/numbers';
import type { Handle } from './annotation';

/** What a value may be: the range where it holds, the numbers of a choice. */
export function gridOf({ control }: Field): Grid {
  return control.kind === 'number' && !control.free ? control : {};
}

/**
 * The value for a dimension of another length. Some attributes are lengths; of others, such as a
 * number of storeys or a scale, a length is made, and they grow with it.
 */
export function valueFor(handle: Handle, value: number, length: number, grown: number): number {
  const share = length > 1e-6 && Math.abs(value) > 1e-9 && handle.kind === 'linear';
  return share ? (value * Math.max(0, length + grown)) / length : value + grown;
}

/** How long a dimension is drawn for a value other than the one that its shape was made with. */
export function lengthFor(length: number, made: number, value: number): number {
  return Math.abs(made) > 1e-9 && value / made > 0 ? (length * value) / made : length;
}

/** A value that the attribute may have; `pixel`: how much one pixel changes it. */
export function allowed(field: Field, value: number, pixel: number, slow: boolean): number {
  const { control } = field;
  if (control.kind === 'choice') {
    const choices = control.choices.map(Number).filter(Number.isFinite);
    if (!control.free && choices.length)
      return choices.reduce((a, b) => (Math.abs(b - value) < Math.abs(a - value) ? b : a));
  }
  const grid = gridOf(field);
  return snapped(value, grid, niceStep(Math.max(1e-6, pixel)) * (slow ? 0.1 : 1));
}

/** "9 m", and what the dimension measures where that is another number: "4 (12.8 m)". */
export function label(field: Field, value: number, measured: number | null): string {
  const { control } = field;
  const number = control.kind === 'number' ? control : null;
  const text = shown(value * (number?.shownAs ?? 1));
  const unit = number?.unit ?? '';
  const space = unit && unit !== '°' ? '\u2009' : '';
  const other = measured !== null && Math.abs(measured - value) > 0.01 * Math.max(1, measured);
  return `${text}${space}${unit}${other ? ` (${shown(measured)}\u2009m)` : ''}`;
}
