// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Attributes as fields of the inspector: their annotations say which control fits, in which group
// and where in it.

import type { Annotation, AttributeInfo, Value } from './protocol';

export type Control =
  | { kind: 'number'; min?: number; max?: number; step?: number; unit: string }
  | { kind: 'bool' }
  | { kind: 'choice'; choices: string[]; free: boolean }
  | { kind: 'color' }
  | { kind: 'file'; extensions: string[] }
  | { kind: 'text' };

export interface Field {
  name: string;
  label: string;
  doc: string;
  type: string;
  control: Control;
  group: string;
}

export interface Group {
  name: string;
  fields: Field[];
}

const find = (a: AttributeInfo, name: string): Annotation | undefined =>
  a.annotations.find((n) => n.name === name);

function argument(
  annotation: Annotation | undefined,
  key: string,
  position: number,
): string | undefined {
  if (!annotation) return undefined;
  const named = annotation.arguments.find(([k]) => k === key);
  return named?.[1] ?? annotation.arguments.filter(([k]) => !k)[position]?.[1];
}

function numberOf(text: string | undefined): number | undefined {
  const value = text === undefined ? NaN : Number(text);
  return Number.isFinite(value) ? value : undefined;
}

function unitOf(a: AttributeInfo): string {
  if (find(a, 'Angle')) return '°';
  if (find(a, 'Percent')) return '%';
  if (find(a, 'Distance')) return 'm';
  const doc = argument(find(a, 'Description'), 'text', 0) ?? '';
  if (/degrees/i.test(doc)) return '°';
  const metres = /\b(?:(square|cubic) )?met(?:re|er)s?\b/i.exec(doc);
  return metres ? ({ square: 'm²', cubic: 'm³' }[metres[1]?.toLowerCase() ?? ''] ?? 'm') : '';
}

export function controlOf(a: AttributeInfo): Control {
  const choices = find(a, 'Enum');
  if (choices && a.type === 'string') {
    const free = choices.arguments.some(([k, v]) => k === 'restricted' && v === 'false');
    return {
      kind: 'choice',
      choices: choices.arguments.filter(([k]) => !k).map(([, v]) => v),
      free,
    };
  }
  if (find(a, 'Color')) return { kind: 'color' };
  const file = find(a, 'File');
  if (file)
    return { kind: 'file', extensions: file.arguments.filter(([k]) => !k).map(([, v]) => v) };
  if (a.type === 'bool') return { kind: 'bool' };
  if (a.type !== 'float') return { kind: 'text' };
  if (choices)
    return {
      kind: 'choice',
      choices: choices.arguments.filter(([k]) => !k).map(([, v]) => v),
      free: true,
    };
  const range = find(a, 'Range');
  const min = numberOf(argument(range, 'min', 0));
  const max = numberOf(argument(range, 'max', 1));
  const step = numberOf(argument(range, 'stepsize', 2));
  return {
    kind: 'number',
    unit: unitOf(a),
    ...(min === undefined ? {} : { min }),
    ...(max === undefined ? {} : { max }),
    ...(step === undefined ? {} : { step }),
  };
}

/**
 * Groups in the order of @Group, fields in that of @Order; those without stand where they are
 * declared.
 */
export function groupFields(attributes: AttributeInfo[]): Group[] {
  interface Placed {
    field: Field;
    groupOrder: number;
    order: number;
  }
  const placed = attributes
    .filter((a) => !a.hidden)
    .map((a): Placed => {
      const group = find(a, 'Group');
      const names = (group?.arguments ?? []).filter(([k]) => !k).map(([, v]) => v);
      const last = names.length > 1 ? numberOf(names[names.length - 1]) : undefined;
      const title =
        names.length === 0
          ? 'Attributes'
          : (last === undefined ? names : names.slice(0, -1)).join(' › ');
      const order = numberOf(argument(find(a, 'Order'), 'order', 0));
      return {
        field: {
          name: a.name,
          label: a.name.includes('.') ? a.name.slice(a.name.lastIndexOf('.') + 1) : a.name,
          doc: argument(find(a, 'Description'), 'text', 0) ?? '',
          type: a.type,
          control: controlOf(a),
          group: title,
        },
        groupOrder: last ?? Infinity,
        order: order ?? Infinity,
      };
    });
  const groups = new Map<string, { order: number; members: Placed[] }>();
  // An attribute without a group follows the one declared before it only by having none: CGA groups
  // hold for the attribute they are written at.
  for (const p of placed) {
    const known = groups.get(p.field.group) ?? { order: Infinity, members: [] };
    known.order = Math.min(known.order, p.groupOrder);
    known.members.push(p);
    groups.set(p.field.group, known);
  }
  return [...groups.entries()]
    .sort((a, b) => (a[1].order === b[1].order ? 0 : a[1].order - b[1].order))
    .map(([name, { members }]) => ({
      name,
      fields: members
        .sort((a, b) => (a.order === b.order ? 0 : a.order - b.order))
        .map((m) => m.field),
    }));
}

/** A value as the server takes it: numbers as they are, arrays as [1,2;3,4]. */
export function valueText(value: Value): string {
  if (!Array.isArray(value)) return value === null ? '' : String(value);
  return `[${value.map((row) => (Array.isArray(row) ? row.map(valueText).join(',') : valueText(row))).join(value.some(Array.isArray) ? ';' : ',')}]`;
}

/** Numbers for people: two decimals at most, thin spaces between thousands. */
export function shown(value: number): string {
  const rounded = Math.abs(value) >= 1000 ? Math.round(value) : Math.round(value * 100) / 100;
  const [whole = '', fraction] = String(rounded).split('.');
  const spaced = whole.replace(/\B(?=(\d{3})+(?!\d))/g, '\u2009');
  return fraction === undefined ? spaced : `${spaced}.${fraction}`;
}

const UNITS: Record<string, number> = {
  mm: 0.001,
  cm: 0.01,
  m: 1,
  km: 1000,
  ft: 0.3048,
  in: 0.0254,
};

/** "3.25*2", "1/3", "(2+1)*4", "120 cm": a number, or null where it is none. */
export function evaluate(text: string): number | null {
  const source = text
    .trim()
    .replace(
      /(\d)\s*(mm|cm|km|ft|in|m)\b/g,
      (_, digit: string, unit: string) => `${digit}*${UNITS[unit]}`,
    );
  let at = 0;
  const skip = () => {
    while (source[at] === ' ' || source[at] === '\u2009') ++at;
  };
  const factor = (): number => {
    skip();
    if (source[at] === '-') {
      ++at;
      return -factor();
    }
    if (source[at] === '(') {
      ++at;
      const inner = sum();
      skip();
      if (source[at++] !== ')') return NaN;
      return inner;
    }
    const match = /^\d*\.?\d+(?:[eE][+-]?\d+)?|^\d+\.?/.exec(source.slice(at));
    if (!match) return NaN;
    at += match[0].length;
    return Number(match[0]);
  };
  const product = (): number => {
    let out = factor();
    for (skip(); source[at] === '*' || source[at] === '/'; skip())
      out = source[at++] === '*' ? out * factor() : out / factor();
    return out;
  };
  const sum = (): number => {
    let out = product();
    for (skip(); source[at] === '+' || source[at] === '-'; skip())
      out = source[at++] === '+' ? out + product() : out - product();
    return out;
  };
  const value = sum();
  skip();
  return at === source.length && Number.isFinite(value) ? value : null;
}
