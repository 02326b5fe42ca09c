// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A GBBG rule as fields, read from its text and printed in the engine's canonical form.

import { tokenize, type Token } from '../text/tokens';

export const OPERATORS = ['Scope', 'Split', 'Repeat', 'Grid', 'Margin', 'Component'] as const;
export type Operator = (typeof OPERATORS)[number];
export const AXES = ['X', 'Y', 'Z'] as const;
export const ORIENTATIONS = ['Default', 'FacingOut', 'FacingIn'] as const;
export const FACES = [
  'AllFaces',
  'Sides',
  'Top',
  'Bottom',
  'SidesPlusTop',
  'SidesPlusBottom',
  'TopPlusBottom',
] as const;

export interface Possibility {
  symbol: string;
  /** Null where no chance is written, which counts as 1. */
  chance: number | null;
}

export interface Change {
  value: [number, number, number];
  set: boolean;
  /** World for T and R, relative for S. */
  other: boolean;
  on: boolean;
}

export interface GbbgRule {
  title: string;
  predecessor: string;
  operator: Operator;
  axis: (typeof AXES)[number];
  translate: Change | null;
  rotate: Change | null;
  scale: Change | null;
  points: number[];
  toRoot: boolean;
  margin: number;
  relative: boolean;
  orientation: (typeof ORIENTATIONS)[number];
  center: boolean;
  faces: (typeof FACES)[number];
  slots: Possibility[][];
  weight: number;
}

export function newRule(predecessor: string, operator: Operator): GbbgRule {
  const rule: GbbgRule = {
    title: '',
    predecessor,
    operator,
    axis: operator === 'Repeat' ? 'X' : 'Y',
    translate: null,
    rotate: null,
    scale: null,
    points: [1],
    toRoot: false,
    margin: 1,
    relative: false,
    orientation: 'Default',
    center: true,
    faces: 'Sides',
    slots: [],
    weight: 1,
  };
  return fitSlots(rule);
}

/** What the successors of a rule stand for, in order. */
export function slotNames(rule: GbbgRule): string[] {
  if (rule.operator === 'Split') return [...rule.points.map((p) => `${p} m`), 'the rest'];
  if (rule.operator === 'Margin') return ['corner', 'edge', ...(rule.center ? ['centre'] : [])];
  if (rule.operator !== 'Component') return ['successor'];
  const all = rule.faces === 'AllFaces';
  return [
    ...(all || rule.faces.startsWith('Sides') ? ['sides'] : []),
    ...(all || rule.faces.includes('Top') ? ['top'] : []),
    ...(all || rule.faces.includes('Bottom') ? ['bottom'] : []),
  ];
}

/** The rule with as many successors as it has to have; those that are there stay. */
export function fitSlots(rule: GbbgRule): GbbgRule {
  const count = slotNames(rule).length;
  const slots = rule.slots.slice(0, count);
  while (slots.length < count) slots.push([{ symbol: 'EMPTY', chance: null }]);
  return { ...rule, slots };
}

export function withOperator(rule: GbbgRule, operator: Operator): GbbgRule {
  return fitSlots({ ...rule, operator });
}

class Reader {
  at = 0;
  constructor(readonly tokens: Token[]) {}
  get text(): string {
    return this.tokens[this.at]?.text ?? '';
  }
  get lower(): string {
    return this.text.toLowerCase();
  }
  take(text: string): boolean {
    if (this.lower !== text.toLowerCase()) return false;
    ++this.at;
    return true;
  }
  expect(text: string): void {
    if (!this.take(text)) throw new Error(`${text} is missing`);
  }
  number(): number {
    const sign = this.take('-') ? -1 : (this.take('+'), 1);
    const value = Number(this.tokens[this.at]?.kind === 'number' ? this.text : NaN);
    if (Number.isNaN(value)) throw new Error('a number is missing');
    ++this.at;
    return sign * value;
  }
  symbol(): string {
    const token = this.tokens[this.at];
    if (token?.kind !== 'name' && token?.kind !== 'string') throw new Error('a symbol is missing');
    ++this.at;
    return token.kind === 'string' ? token.text.slice(1, -1) : token.text;
  }
  /** The one of a list of words that stands here. */
  word<T extends string>(words: readonly T[]): T | null {
    const found = words.find((w) => w.toLowerCase() === this.lower);
    if (found) ++this.at;
    return found ?? null;
  }
}

function readChange(r: Reader): Change {
  r.expect('(');
  const value: Change['value'] = [
    r.number(),
    (r.expect(','), r.number()),
    (r.expect(','), r.number()),
  ];
  const out: Change = { value, set: false, other: false, on: true };
  while (r.take(',')) {
    const word = r.word([
      'Add',
      'Set',
      'Local',
      'World',
      'Absolute',
      'Relative',
      'On',
      'Off',
    ] as const);
    if (!word) throw new Error('a mode is missing');
    if (word === 'Set') out.set = true;
    if (word === 'World' || word === 'Relative') out.other = true;
    if (word === 'Off') out.on = false;
  }
  r.expect(')');
  return out;
}

function readParameters(r: Reader, rule: GbbgRule): void {
  if (rule.operator === 'Scope') {
    for (let first = true; r.text !== ')'; first = false) {
      if (!first) r.expect(',');
      const name = r.word(['T', 'R', 'S'] as const);
      if (!name) throw new Error('T, R or S is missing');
      rule[name === 'T' ? 'translate' : name === 'R' ? 'rotate' : 'scale'] = readChange(r);
    }
    return;
  }
  const axis = r.word(AXES);
  if (!axis) throw new Error('an axis is missing');
  rule.axis = axis;
  if (rule.operator === 'Split') {
    r.expect(',');
    r.expect('{');
    rule.points = [];
    while (r.text !== '}') {
      if (rule.points.length) r.expect(',');
      rule.points.push(r.number());
    }
    r.expect('}');
    if (r.take(',')) rule.toRoot = r.word(['FromRoot', 'ToRoot'] as const) === 'ToRoot';
  } else if (rule.operator === 'Margin') {
    rule.margin = 0;
    while (r.take(',')) {
      const word = r.word([
        'Absolute',
        'Relative',
        'Default',
        'FacingOut',
        'FacingIn',
        'Center',
        'NoCenter',
      ] as const);
      if (word === 'Default' || word === 'FacingOut' || word === 'FacingIn')
        rule.orientation = word;
      else if (word === 'Center' || word === 'NoCenter') rule.center = word === 'Center';
      else if (word) rule.relative = word === 'Relative';
      else rule.margin = r.number();
    }
  } else if (rule.operator === 'Component') {
    r.expect(',');
    const faces = r.word(FACES);
    if (!faces) throw new Error('the faces are missing');
    rule.faces = faces;
  }
}

function readSlots(r: Reader): Possibility[][] {
  const slots: Possibility[][] = [];
  r.expect('{');
  do {
    const slot: Possibility[] = [];
    do {
      const symbol = r.symbol();
      const next = r.tokens[r.at];
      slot.push({
        symbol,
        chance:
          next?.kind === 'number' || next?.text === '-' || next?.text === '+' ? r.number() : null,
      });
    } while (r.take(','));
    slots.push(slot);
  } while (r.take('|'));
  r.expect('}');
  return slots;
}

/** The rule of a text; a sentence where it is none. */
export function parseRule(text: string): GbbgRule | string {
  const r = new Reader(tokenize(text).filter((t) => t.kind !== 'comment'));
  try {
    const titled = r.tokens[0]?.kind === 'string' && r.tokens[1]?.text !== '->';
    const title = titled ? r.symbol() : '';
    const predecessor = r.symbol();
    r.expect('->');
    const operator = r.word(OPERATORS);
    if (!operator) return 'What this rule does is none of the six types.';
    const rule = { ...newRule(predecessor, operator), title, margin: 0 };
    r.expect('(');
    readParameters(r, rule);
    r.expect(')');
    rule.slots = readSlots(r);
    if (r.take('weight')) rule.weight = r.number();
    return r.at === r.tokens.length
      ? rule
      : 'There is more text in this rule than the form can show.';
  } catch (error) {
    return `The form needs a rule that can be read: ${(error as Error).message}.`;
  }
}

const plain = (symbol: string) =>
  /^[A-Za-z_\u0080-\uffff][\w\u0080-\uffff]*$/.test(symbol) ? symbol : `"${symbol}"`;

function changeText(name: string, c: Change | null, words: [string, string]): string[] {
  if (!c) return [];
  return [
    `${name}(${c.value.join(', ')}, ${c.set ? 'Set' : 'Add'}, ${words[c.other ? 1 : 0]}${c.on ? '' : ', Off'})`,
  ];
}

function parametersText(r: GbbgRule): string {
  switch (r.operator) {
    case 'Scope':
      return [
        ...changeText('T', r.translate, ['Local', 'World']),
        ...changeText('R', r.rotate, ['Local', 'World']),
        ...changeText('S', r.scale, ['Absolute', 'Relative']),
      ].join(', ');
    case 'Split':
      return `${r.axis}, {${r.points.join(', ')}}, ${r.toRoot ? 'ToRoot' : 'FromRoot'}`;
    case 'Margin':
      return `${r.axis}, ${r.relative ? 'Relative' : 'Absolute'}, ${r.margin}, ${r.orientation}, ${r.center ? 'Center' : 'NoCenter'}`;
    case 'Component':
      return `${r.axis}, ${r.faces}`;
    default:
      return r.axis;
  }
}

export function printRule(r: GbbgRule): string {
  const head = `${r.title ? `"${r.title}" ` : ''}${plain(r.predecessor)} -> ${r.operator}(${parametersText(r)})`;
  const slots = r.slots.map((s) =>
    s.map((p) => plain(p.symbol) + (p.chance === null ? '' : ` ${p.chance}`)).join(', '),
  );
  const tail = `{${slots.join(' | ')}}${r.weight === 1 ? '' : ` weight ${r.weight}`}`;
  return head.length + tail.length + 1 <= 100 ? `${head} ${tail}` : `${head}\n    ${tail}`;
}

export interface Asset {
  symbol: string;
  path: string;
  /** Of the path's text, quotes left out. */
  from: number;
  to: number;
}

/** Which model takes the place of which symbol, and where a further line can be put in. */
export function assetTable(text: string): { assets: Asset[]; end: number } | null {
  const tokens = tokenize(text).filter((t) => t.kind !== 'comment');
  const open = tokens.findIndex(
    (t, i) => t.text.toLowerCase() === 'postprocess' && tokens[i + 1]?.text === '{',
  );
  if (open < 0) return null;
  const assets: Asset[] = [];
  let i = open + 2;
  for (; i < tokens.length && tokens[i]!.text !== '}'; ++i) {
    if (tokens[i + 1]?.text !== ':' || tokens[i + 2]?.kind !== 'string') continue;
    const path = tokens[i + 2]!;
    assets.push({
      symbol: tokens[i]!.text.replace(/^"|"$/g, ''),
      path: path.text.slice(1, -1),
      from: path.from + 1,
      to: path.to - 1,
    });
    i += 2;
  }
  return { assets, end: tokens[i]?.from ?? text.length };
}

/** All symbols that a grammar names, with those that it declares first. */
export function symbolsOf(text: string): string[] {
  const out = new Set<string>(['START', 'EMPTY']);
  for (const match of text.matchAll(
    /^\s*(?:shape|terminal)\b([^\n]*(?:(?<=,[ \t]*)\n[^\n]*)*)/gim,
  )) {
    for (const part of match[1]!.replace(/\[[^\]]*\]/g, '').split(',')) {
      const name = part.trim().split(/\s+/)[0];
      if (name && /^\w+$/.test(name)) out.add(name);
    }
  }
  for (const match of text.matchAll(/^(?:"[^"]*"\s+)?(\w+)\s*->/gm)) out.add(match[1]!);
  for (const match of text.matchAll(/\)\s*\{([^}]*)\}/g)) {
    for (const name of match[1]!.split(/[|,]/)) {
      const word = /^\s*(\w+)/.exec(name)?.[1];
      if (word && !/^\d/.test(word)) out.add(word);
    }
  }
  return [...out];
}

/**
 * A line that declares a symbol, and where it goes: behind the last declaration, else at the top.
 */
export function declaration(
  text: string,
  name: string,
  dimensions: '3D' | '2D' | 'Empty',
  terminal = false,
): { at: number; insert: string } {
  const line = `${terminal ? 'terminal' : 'shape'} ${name}${dimensions === '3D' ? '' : ` ${dimensions}`}\n`;
  let at = 0;
  for (const match of text.matchAll(
    /^(?:shape|terminal|axiom)\b[^\n]*(?:(?<=,[ \t]*)\n[^\n]*)*\n?/gim,
  ))
    at = match.index + match[0].length;
  return { at, insert: at > 0 && text[at - 1] !== '\n' ? `\n${line}` : line };
}
