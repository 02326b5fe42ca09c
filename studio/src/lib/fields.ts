// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Attributes as fields of the inspector: their annotations say which control fits, in which group
// and where in it.

import type { Annotation, AttributeInfo, RuleInfo, Value } from './protocol';

export interface NumberControl {
  kind: 'number';
  min?: number;
  max?: number;
  step?: number;
  /** Values outside of the range are as good. */
  free?: boolean;
  unit: string;
  /** What is shown is the value times this: 100 where a share is given in percent. */
  shownAs?: number;
}

export type Control =
  | NumberControl
  | { kind: 'bool' }
  | { kind: 'choice'; choices: string[]; free: boolean }
  | { kind: 'color' }
  | { kind: 'file'; extensions: string[] }
  | { kind: 'folder' }
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
  position = -1,
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

/** What a choice offers: values that are written, or those of another attribute. */
function choicesOf(a: AttributeInfo, note: Annotation, values: Record<string, Value>): string[] {
  const other = argument(note, 'valuesAttr');
  if (other === undefined) return note.arguments.filter(([k]) => !k).map(([, v]) => String(v));
  const beside = a.name.slice(0, a.name.lastIndexOf('.') + 1);
  const given = values[beside + other] ?? values[other] ?? [];
  return (Array.isArray(given) ? given.flat(2) : [given]).map(valueText);
}

const isFree = (note: Annotation | undefined): boolean =>
  String(argument(note, 'restricted')) === 'false';

function numberControl(a: AttributeInfo): NumberControl {
  const range = find(a, 'Range');
  const shares = !!find(a, 'Percent');
  // Those of an angle and of a share, where no other is written, hold for the slider alone.
  const usual = find(a, 'Angle') ? [0, 360] : shares ? [0, 1] : [];
  const min = range ? numberOf(argument(range, 'min', 0)) : usual[0];
  const max = range ? numberOf(argument(range, 'max', 1)) : usual[1];
  const step = numberOf(argument(range, 'stepsize', 2));
  return {
    kind: 'number',
    unit: unitOf(a),
    ...(min === undefined ? {} : { min }),
    ...(max === undefined ? {} : { max }),
    ...(step === undefined ? {} : { step }),
    ...((range ? isFree(range) : usual.length) ? { free: true } : {}),
    ...(shares ? { shownAs: 100 } : {}),
  };
}

/** `values`: those of all attributes, since some name the choices of others. */
export function controlOf(a: AttributeInfo, values: Record<string, Value> = {}): Control {
  const choices = find(a, 'Enum');
  if (choices && (a.type === 'string' || a.type === 'float')) {
    const offered = choicesOf(a, choices, values);
    if (offered.length) return { kind: 'choice', choices: offered, free: isFree(choices) };
  }
  if (find(a, 'Color')) return { kind: 'color' };
  if (find(a, 'Directory')) return { kind: 'folder' };
  if (find(a, 'MaterialFile')) return { kind: 'file', extensions: ['cgamat', 'mtl'] };
  const file = find(a, 'File');
  if (file)
    return { kind: 'file', extensions: file.arguments.filter(([k]) => !k).map(([, v]) => v) };
  if (a.type === 'bool') return { kind: 'bool' };
  return a.type === 'float' ? numberControl(a) : { kind: 'text' };
}

/** As rules write it: paths start at the folder of assets or at that of the project. */
const asWritten = (path: string): string =>
  path.startsWith('assets/') ? path.slice('assets/'.length) : path;

/** What of the project a field offers: files with one of its extensions, or folders; sorted. */
export function offered(control: Control, paths: string[]): string[] {
  if (control.kind === 'folder') {
    const folders = new Set<string>();
    for (const path of paths) {
      for (let at = path.indexOf('/'); at >= 0; at = path.indexOf('/', at + 1))
        folders.add(asWritten(path.slice(0, at)));
    }
    return [...folders].sort();
  }
  if (control.kind !== 'file') return [];
  const endings = control.extensions.map((e) => `.${e.toLowerCase().replace(/^\*?\./, '')}`);
  const fits = (path: string) =>
    !endings.length || endings.some((e) => path.toLowerCase().endsWith(e));
  return paths.filter(fits).map(asWritten).sort();
}

/**
 * Groups in the order of @Group, fields in that of @Order; those without stand where they are
 * declared.
 */
export function groupFields(
  attributes: AttributeInfo[],
  values: Record<string, Value> = {},
): Group[] {
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
      const title = names.length === 0 ? 'Attributes' : names.join(' › ');
      const order = numberOf(argument(find(a, 'Order'), 'order', 0));
      return {
        field: {
          name: a.name,
          label:
            argument(find(a, 'DisplayName'), 'text', 0) ??
            a.name.slice(a.name.lastIndexOf('.') + 1),
          doc: argument(find(a, 'Description'), 'text', 0) ?? '',
          type: a.type,
          control: controlOf(a, values),
          group: title,
        },
        groupOrder: numberOf(argument(group, 'order')) ?? Infinity,
        order: order ?? Infinity,
      };
    });
  const groups = new Map<string, { order: number; members: Placed[] }>();
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

const STARTS: Record<string, string> = {
  InMesh: 'a mesh',
  InPolygon: 'a polygon',
  InLine: 'a line',
  InPoint: 'a point',
  InPointCloud: 'a point cloud',
};

/** What a start rule says of the shape that it expects and of what it makes; often nothing. */
export function expectation(rule: RuleInfo | undefined): string {
  const names = rule?.annotations.map((a) => a.name) ?? [];
  const said = names.flatMap((n) => (STARTS[n] ? [`Starts on ${STARTS[n]}.`] : []));
  // Without an argument the shapes are one.
  if (names.includes('Out')) said.push('Its shapes are meant to stay separate.');
  return said.join(' ');
}

/** What a text of `valueText` says, for an attribute of that type. */
export function valueOfText(text: string, type: string): Value {
  if (type === 'float') return numberOf(text) ?? null;
  return type === 'bool' ? text === 'true' : text;
}

/** A value as the server takes it: numbers as they are, arrays as [1,2;3,4]. */
export function valueText(value: Value): string {
  if (!Array.isArray(value)) return value === null ? '' : String(value);
  const rows = value.map((row) =>
    Array.isArray(row) ? row.map(valueText).join(',') : valueText(row),
  );
  return `[${rows.join(value.some(Array.isArray) ? ';' : ',')}]`;
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
