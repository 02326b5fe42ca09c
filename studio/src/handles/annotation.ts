// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Handles of attributes as their annotations say them: @Handle(shape=Wall, axis=y, align=left).
// Words that are not known count as not written.

import type { Field } from '../lib/fields';
import type { Annotation, AttributeInfo, RuleInfo } from '../lib/protocol';
import type { Shapes } from '../lib/tree';

export type HandleKind = 'linear' | 'move' | 'angular' | 'toggle' | 'selector' | 'color';
export type Reference = 'edges' | 'origin' | 'center' | 'radial';
export type Slip = 'scope' | 'inside' | 'screen';
export type Align =
  | 'default'
  | 'topLeft'
  | 'left'
  | 'bottomLeft'
  | 'bottom'
  | 'bottomRight'
  | 'right'
  | 'topRight'
  | 'top';

export interface Handle {
  /** Its attribute and its place among the handles of that. */
  id: string;
  field: Field;
  kind: HandleKind;
  /** The rule whose shapes it is at, and how many parameters it has; a leaf of that name. */
  rule: string;
  parameters: number;
  leaf: boolean;
  axis: 0 | 1 | 2;
  reference: Reference;
  align: Align;
  slip: Slip;
  /** What stands before it hides it. */
  occlusion: boolean;
  /** By so many sizes of the scope. */
  translate: [number, number, number];
  /** Equal ones in a line go on as a chain. */
  chain: boolean;
  /** Both ends move, about the middle. */
  bothEnds: boolean;
  round: boolean;
  color: string;
}

const KINDS: HandleKind[] = ['linear', 'move', 'angular', 'toggle', 'selector', 'color'];
const REFERENCES: Reference[] = ['edges', 'origin', 'center', 'radial'];
const SLIPS: Slip[] = ['scope', 'inside', 'screen'];
const ALIGNS: Align[] = [
  'default',
  'topLeft',
  'left',
  'bottomLeft',
  'bottom',
  'bottomRight',
  'right',
  'topRight',
  'top',
];

const oneOf = <T extends string>(known: T[], text: string | undefined): T =>
  known.find((k) => k === text) ?? known[0]!;

/** The parts of "{a,b}"; of another text itself. */
const listOf = (text = ''): string[] => text.replace(/^\{|\}$/g, '').split(',');

/** What can change such a field: an annotation that does not fit its type has no effect. */
function fits(kind: HandleKind, field: Field): boolean {
  const { control } = field;
  if (kind === 'toggle') return control.kind === 'bool';
  if (kind === 'selector') return control.kind === 'choice';
  if (kind === 'color') return control.kind === 'color';
  return field.type === 'float';
}

function handleOf(field: Field, note: Annotation, id: string): Handle | null {
  const args = new Map(note.arguments);
  const [name = '', count = '0'] = (args.get('shape') ?? '').split('^');
  const kind = oneOf(KINDS, args.get('type'));
  if (!name || !fits(kind, field)) return null;
  const [x = 0, y = 0, z = 0] = listOf(args.get('translate')).map((n) => Number(n) || 0);
  const color = args.get('color') ?? '';
  return {
    id,
    field,
    kind,
    rule: name.replace(/\*$/, ''),
    parameters: Number(count) || 0,
    leaf: name.endsWith('*'),
    axis: ({ x: 0, z: 2 } as const)[args.get('axis') ?? ''] ?? 1,
    reference: oneOf(REFERENCES, args.get('reference')),
    align: oneOf(ALIGNS, args.get('align')),
    slip: SLIPS.find((s) => listOf(args.get('slip')).includes(s)) ?? 'scope',
    occlusion: args.get('occlusion') !== 'false',
    translate: [x, y, z],
    chain: args.get('repeat') !== 'none',
    bothEnds: args.get('skin') === 'diameterArrow',
    round: args.get('skin') === 'sphere',
    color: /^#[0-9a-f]{6}/i.test(color) ? color.slice(0, 7) : '',
  };
}

/** The handles of the attributes that are offered as fields. */
export function handlesOf(attributes: AttributeInfo[], fields: Field[]): Handle[] {
  return fields.flatMap((field) => {
    const notes = attributes.find((a) => a.name === field.name)?.annotations ?? [];
    return notes
      .filter((n) => n.name === 'Handle')
      .flatMap((note, i) => handleOf(field, note, `${field.name} ${i}`) ?? []);
  });
}

/** Of so many shapes of a rule one is chosen to carry the handle. */
export const MOST_SHAPES = 400;

/**
 * The shapes of each handle within an initial shape, -1 for all of them. Of rules that are imported
 * under several names the tree knows the last part alone.
 */
export function shapesOf(
  handles: Handle[],
  shapes: Shapes,
  rules: RuleInfo[],
  lot: number,
): Map<string, number[]> {
  const { tree } = shapes;
  const out = new Map<string, number[]>(handles.map((h) => [h.id, []]));
  const lastPart = (name: string) => name.slice(name.lastIndexOf('.') + 1);
  const wanted = new Map<string, Handle[]>();
  for (const handle of handles) {
    const name = lastPart(handle.rule);
    const known = rules.filter((r) => lastPart(r.name) === name);
    const missing = known.length > 0 && !known.some((r) => r.parameters === handle.parameters);
    if (missing && !handle.leaf) continue;
    wanted.set(name, [...(wanted.get(name) ?? []), handle]);
  }
  const byName = tree.names.map((name) => wanted.get(name));
  for (let node = 0; node < tree.count; ++node) {
    const found = byName[tree.name[node]!];
    if (!found || (lot >= 0 && tree.shape[node] !== lot)) continue;
    for (const handle of found) {
      const list = out.get(handle.id)!;
      if (list.length >= MOST_SHAPES) continue;
      if (handle.leaf && !(tree.flags[node]! & 1)) continue;
      list.push(node);
    }
  }
  return out;
}
