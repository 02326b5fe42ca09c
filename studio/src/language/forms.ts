// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules as forms, as the language server reads them: parts with their places, and for each what
// takes it away and where a further one goes. docs/dev/language-service.md says what they are.

import type { Position, Range, TextEdit } from './protocol';

export interface Insertion {
  at: Position;
  before: string;
  after: string;
}

export interface Piece {
  kind:
    | 'body'
    | 'plain'
    | 'case'
    | 'chance'
    | 'else'
    | 'call'
    | 'argument'
    | 'block'
    | 'part'
    | 'head'
    | 'scoped';
  range: Range;
  text?: string;
  repeated?: boolean;
  /** What is to be deleted to take the part away. */
  removal?: Range[];
  insertion?: Insertion;
  parts: Piece[];
}

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
  /** World for moves and turns, relative for sizes. */
  other: boolean;
  on: boolean;
}

/** A rule of GBBG: one operation, with values to set. */
export interface BoxRule {
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
  slotNames: string[];
  weight: number;
}

export interface RuleForm {
  name: string;
  range: Range;
  nameRange: Range;
  parametersRange: Range;
  removal: Range;
  body?: Piece;
  box?: BoxRule;
  trouble: string;
}

export interface FormRow {
  name: string;
  parameters: string[];
  type: string;
  range: Range;
}

export interface AssetRow {
  symbol: string;
  path: string;
  pathRange: Range;
  removal: Range;
}

export interface TextForm {
  rules: FormRow[];
  symbols: string[];
  taken: string[];
  rule: RuleForm | null;
  newRule: Insertion;
  newSymbol?: Insertion;
  newAsset?: Insertion;
  assets: AssetRow[];
}

/** The edit that writes something where a further one goes. */
export function inserted(place: Insertion, text: string): TextEdit {
  return {
    range: { start: place.at, end: place.at },
    newText: place.before + text + place.after,
  };
}

/** The edit that takes something away. */
export const removed = (range: Range): TextEdit => ({ range, newText: '' });

/** A name that is free: "Facade_2", "Facade_3", ... */
export function freeName(name: string, taken: Iterable<string>): string {
  const all = new Set(taken);
  const stem = name.replace(/_\d+$/, '');
  for (let i = 2; ; ++i) if (!all.has(`${stem}_${i}`)) return `${stem}_${i}`;
}

/** A sentence where a name cannot be used for something new, or null. */
export function nameTrouble(name: string, taken: Iterable<string>): string | null {
  if (!/^[A-Za-z_]\w*$/.test(name))
    return 'A name is letters, digits and _, and begins with no digit.';
  return [...taken].includes(name) ? `There is already something called ${name}.` : null;
}

/** Half of the time what is there, half of the time nothing: what a choice begins with. */
export function asChoice(body: Piece): TextEdit[] {
  const { start, end } = body.range;
  return [
    { range: { start, end: start }, newText: '50% : ' },
    { range: { start: end, end }, newText: ' else : NIL' },
  ];
}

export const partsOf = (piece: Piece, kind: Piece['kind']): Piece[] =>
  piece.parts.filter((p) => p.kind === kind);

export const headOf = (piece: Piece): Piece | undefined =>
  piece.parts[0]?.kind === 'head' ? piece.parts[0] : undefined;
