// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What can be written in each notation, for completion and hover. Gable's own language is what the
// engine's registry says. The words of the others are few; where one is carried out by an operation
// of the registry, that operation explains it.

import type { Notation } from '../lib/notation';
import { signatureText, type Entry, type Param } from '../lib/registry';

export interface Word {
  name: string;
  /** "operation", "function", "annotation", ... */
  kind: string;
  /** How it is called, one line each. */
  signatures: string[];
  text: string;
  params: { name: string; text: string }[];
  /** Text to insert, with ${places} to fill in; empty: the name. */
  snippet: string;
}

interface Own {
  name: string;
  call: string;
  /** The operation that carries it out, or a sentence. */
  is?: string;
  text?: string;
  snippet?: string;
}

const GBBG: Own[] = [
  {
    name: 'Scope',
    call: 'Scope(T(x, y, z), R(x, y, z), S(x, y, z)) {Q}',
    text: 'The box moved, turned and resized; what is left out is off.',
    snippet: 'Scope(T(${0}, 0, 0), S(0, 0, 0)) {${Q}}',
  },
  {
    name: 'Split',
    call: 'Split(axis, {widths}, FromRoot | ToRoot) {A | B | ..}',
    is: 'split',
    text: 'Pieces of given widths along an axis; the last one is the rest.',
    snippet: 'Split(${Y}, {${1}}) {${A} | ${B}}',
  },
  {
    name: 'Repeat',
    call: 'Repeat(axis) {Q}',
    is: 'splitRepeat',
    text: 'Equal pieces along an axis, as near to the preferred size of Q as they can be.',
    snippet: 'Repeat(${X}) {${Q}}',
  },
  {
    name: 'Grid',
    call: 'Grid(axis) {Q}',
    is: 'splitGrid',
    text: 'Equal pieces along the two other axes.',
    snippet: 'Grid(${Y}) {${Q}}',
  },
  {
    name: 'Margin',
    call: 'Margin(axis, width, Default | FacingOut | FacingIn) {Corner | Edge | Center}',
    is: 'margin',
    text: 'Four corners, four edges and a centre; NoCenter leaves a ring.',
    snippet: 'Margin(${Y}, ${1}, FacingOut) {${Corner} | ${Edge} | ${Center}}',
  },
  {
    name: 'Component',
    call: 'Component(axis, faces) {Side | Top | Bottom}',
    is: 'comp',
    text: 'Faces of the box as 2D shapes: AllFaces, Sides, Top, Bottom, SidesPlusTop, SidesPlusBottom, TopPlusBottom.',
    snippet: 'Component(${Y}, ${Sides}) {${Side}}',
  },
  { name: 'T', call: 'T(x, y, z, Add | Set, Local | World)', text: 'Moves the box, in metres.' },
  {
    name: 'R',
    call: 'R(x, y, z, Add | Set, Local | World)',
    text: 'Turns the box, in degrees, in the order z, x, y.',
  },
  {
    name: 'S',
    call: 'S(x, y, z, Add | Set, Absolute | Relative)',
    text: 'Resizes the box. With Set a size of 0 makes a face, -1 leaves an axis as it is.',
  },
  {
    name: 'axiom',
    call: 'axiom SYMBOL at (x, y, z) rotate (x, y, z) size (w, h, d)',
    text: 'What the derivation begins with.',
    snippet: 'axiom ${START} size (${10}, 10, 10)',
  },
  {
    name: 'shape',
    call: 'shape Symbol 3D | 2D | Empty [x, y, z]',
    text: 'Declares a symbol; in brackets the size that it prefers, 0 for any.',
    snippet: 'shape ${Symbol} [0, ${3}, 0]',
  },
  {
    name: 'terminal',
    call: 'terminal Symbol 3D | 2D | Empty [x, y, z]',
    text: 'Declares a symbol that is not rewritten.',
    snippet: 'terminal ${Symbol}',
  },
  {
    name: 'select',
    call: 'select first | random | weighted',
    text: 'Which of several rules of one symbol counts.',
  },
  {
    name: 'use',
    call: 'use "common.gbbg"',
    text: 'Takes the rules of another grammar.',
    snippet: 'use "${common.gbbg}"',
  },
  {
    name: 'postprocess',
    call: 'postprocess { Symbol : "asset.glb" }',
    text: 'Models that take the place of terminal shapes.',
    snippet: 'postprocess {\n  ${Symbol} : "${assets/model.glb}"\n}',
  },
  ...['X', 'Y', 'Z'].map((name): Own => ({
    name,
    call: name,
    text: `The ${name.toLowerCase()} axis of the box.`,
  })),
  ...['FromRoot', 'ToRoot'].map((name): Own => ({
    name,
    call: name,
    text: 'Where pieces are counted from: the least corner, or the far end.',
  })),
  ...['Default', 'FacingOut', 'FacingIn'].map((name): Own => ({
    name,
    call: name,
    text: 'How the pieces of a margin are turned.',
  })),
  ...['Center', 'NoCenter'].map((name): Own => ({
    name,
    call: name,
    text: 'Whether a margin has a piece in the middle.',
  })),
  ...['AllFaces', 'Sides', 'Top', 'Bottom', 'SidesPlusTop', 'SidesPlusBottom', 'TopPlusBottom'].map(
    (name): Own => ({ name, call: name, text: 'Faces that Component takes.' }),
  ),
  ...['Add', 'Set', 'Local', 'World', 'Absolute', 'Relative', 'On', 'Off'].map((name): Own => ({
    name,
    call: name,
    text: 'How T, R or S is meant.',
  })),
  { name: 'EMPTY', call: 'EMPTY', text: 'Nothing.' },
];

const PROGEN: Own[] = [
  {
    name: 'S',
    call: 'S ( x y z )',
    text: 'Scales what follows, on top of what was scaled before. Negative mirrors.',
    snippet: 'S ( ${1} 1 1 )',
  },
  {
    name: 'T',
    call: 'T ( x y z )',
    text: 'Moves what follows, in the scaled and turned units.',
    snippet: 'T ( ${0} 0 0 )',
  },
  {
    name: 'A',
    call: 'A ( degrees axis )',
    text: 'Turns what follows about axis 0 (x), 1 (y) or 2 (z).',
    snippet: 'A ( ${90} 1 )',
  },
  {
    name: 'D',
    call: 'D ( x y z )',
    text: 'Tapers: scales the far side of what follows.',
    snippet: 'D ( ${0.5} 1 0.5 )',
  },
  {
    name: 'I',
    call: 'I ( Cube texture turns scale )',
    is: 'primitiveCube',
    text: 'Draws Cube, CubeX, CubeY, Sphere or Cylinder with a texture of the list.',
    snippet: 'I ( ${Cube} ${0} )',
  },
  {
    name: 'R',
    call: 'R name ( least most )',
    text: 'A number drawn anew at each call of a rule that lists it.',
    snippet: 'R ${name} ( ${1} ${2} )',
  },
  ...['Cube', 'CubeX', 'CubeY', 'Sphere', 'Cylinder'].map((name): Own => ({
    name,
    call: name,
    text: 'What I draws. Cube stands on the middle of its base, CubeX on the middle of its left lower edge, CubeY reaches forward.',
  })),
  ...['sin', 'cos'].map((name): Own => ({ name, call: `${name}(degrees)`, text: 'Of an angle.' })),
];

const PARK: Own[] = [
  {
    name: 'Grid',
    call: 'Grid(columns, rows) { region } { path } { junction }',
    is: 'grid',
    snippet: 'Grid(${2}, ${2}) { ${Region} } { ${Path} } { }',
  },
  {
    name: 'VoronoiRegions',
    call: 'VoronoiRegions(sites, smooth) { region } { path }',
    is: 'voronoi',
    snippet: 'VoronoiRegions(${5}) { ${Region} } { ${Path} }',
  },
  { name: 'VoronoiSmoothed', call: 'VoronoiSmoothed(sites) { region } { path }', is: 'voronoi' },
  {
    name: 'CastRays',
    call: 'CastRays(source, targets) { centre } { region }',
    is: 'castRays',
    snippet: 'CastRays(${CENTRE}, ${corners}) { ${Plaza} } { ${Sector} }',
  },
  {
    name: 'Peel',
    call: 'Peel(selection, size) { strip | rest }',
    is: 'peel',
    snippet: 'Peel(${OUTER}) { ${0.75}: ${Strip} | ${Rest} }',
  },
  { name: 'Contract', call: 'Contract(distance)', is: 'contract' },
  {
    name: 'Place',
    call: 'Place(where) { figure }',
    is: 'place',
    snippet: 'Place(${CENTRE}) { ${Bed} }',
  },
  {
    name: 'Distribute',
    call: 'Distribute(selection : inset, spacing) { figure }',
    is: 'distribute',
    snippet: 'Distribute(${OUTER_EDGE}: ${0.4}, ${2}) { ${Tree} }',
  },
  { name: 'ScatterCircles', call: 'ScatterCircles(count {radius})', is: 'scatterCircles' },
  { name: 'Scatter', call: 'Scatter(count)', is: 'scatterCircles' },
  { name: 'Sweep', call: 'Sweep(lines)', is: 'sweep' },
  { name: 'DistributeSmooth', call: 'DistributeSmooth(lines)', is: 'sweep' },
  { name: 'Parametrise', call: 'Parametrise(ranges, figure)', is: 'parametrise' },
  { name: 'InnerRect', call: 'InnerRect { shape: A | remainder: B }', is: 'innerRectangle' },
  {
    name: 'Choose',
    call: 'Choose { A, 30%: B }',
    text: 'One of several, by chance.',
    snippet: 'Choose { ${A}, 30%: ${B} }',
  },
  { name: 'joined', call: 'joined { Romb(r) P }', text: 'Paths and their junctions as one shape.' },
  {
    name: 'loadModel',
    call: 'loadModel("tree")',
    is: 'i',
    text: 'A model of the project, fitted to the place.',
  },
  { name: 'Circle', call: 'Circle(radius)', is: 'circle' },
  { name: 'Romb', call: 'Romb(radius)', is: 'romb' },
  { name: 'Square', call: 'Square(side)', is: 'square' },
  { name: 'Rect', call: 'Rect(width, height)', is: 'rect' },
  { name: 'Polygon', call: 'Polygon(radius, sides)', is: 'regularPolygon' },
  { name: 'OUTER', call: 'OUTER', text: 'Sides on the border of the park.' },
  { name: 'INNER', call: 'INNER', text: 'Sides along paths.' },
  { name: 'CENTRE', call: 'CENTRE', text: 'The middle of the region, always inside.' },
  {
    name: 'case',
    call: 'case condition: operations else: operations',
    text: "Operations under a condition; w and h are the region's width and height.",
  },
  { name: 'fun', call: 'fun Name(parameters) -> operations', text: 'Operations under a name.' },
];

const ANNOTATIONS: Own[] = [
  { name: '@StartRule', call: '@StartRule', text: 'A derivation begins with this rule.' },
  {
    name: '@Range',
    call: '@Range(min=0, max=10, stepsize=1)',
    text: 'A slider in the inspector.',
    snippet: '@Range(min=${0}, max=${10})',
  },
  {
    name: '@Enum',
    call: '@Enum("one", "two")',
    text: 'One of a list.',
    snippet: '@Enum("${one}", "${two}")',
  },
  { name: '@Color', call: '@Color', text: 'A colour.' },
  {
    name: '@File',
    call: '@File("obj", "glb")',
    text: 'A file of the project.',
    snippet: '@File("${obj}")',
  },
  {
    name: '@Group',
    call: '@Group("Name", order)',
    text: 'The group in the inspector.',
    snippet: '@Group("${Name}")',
  },
  { name: '@Order', call: '@Order(1)', text: 'The place in the group.', snippet: '@Order(${1})' },
  { name: '@Hidden', call: '@Hidden', text: 'Not in the inspector.' },
  {
    name: '@Description',
    call: '@Description("text")',
    text: 'Shown beside the attribute.',
    snippet: '@Description("${text}")',
  },
  { name: '@Handle', call: '@Handle', text: 'A handle in the view.' },
  { name: '@Angle', call: '@Angle', text: 'In degrees.' },
  { name: '@Distance', call: '@Distance', text: 'In metres.' },
  { name: '@Percent', call: '@Percent', text: 'A share.' },
];

/** Something that may stand for a parameter, so that what is inserted is no mistake. */
function sample(p: Param): string {
  if (p.type.endsWith('[]')) return '[]';
  if (p.type === 'string') return '""';
  if (p.type === 'bool') return 'true';
  const word = p.words?.split(' ')[0];
  if (word) return word;
  if (/angle/i.test(p.name)) return '30';
  return /sides|count|divisions/i.test(p.name) ? '4' : '1';
}

function fromEntry(entry: Entry): Word {
  const signatures = entry.signatures.length
    ? entry.signatures.map((_, i) => signatureText(entry, i))
    : [entry.name];
  const required = entry.signatures[0]?.params.filter((p) => p.default === undefined) ?? [];
  const inside = required.map((p, i) => `\${${i + 1}:${sample(p)}}`).join(', ');
  const next = required.length + 1;
  const divides = /^\{ (size|selector)/.exec(entry.block)?.[1];
  const first = divides === 'size' ? '~1' : 'all';
  let block = entry.block ? ` { \${${next}:A} }` : '';
  if (divides) block = ` { \${${next}:${first}} : \${${next + 1}:A} }`;
  return {
    name: entry.name,
    kind: entry.kind,
    signatures,
    text: entry.summary,
    params: (entry.signatures[0]?.params ?? []).map((p) => ({
      name: p.name,
      text: p.default === undefined ? p.doc : `${p.doc} Default: ${p.default}.`,
    })),
    snippet: entry.bare || entry.signatures.length === 0 ? '' : `${entry.name}(${inside})${block}`,
  };
}

function fromOwn(own: Own, registry: Entry[], kind: string): Word {
  const entry = own.is ? registry.find((e) => e.name === own.is) : undefined;
  const text = own.text ?? entry?.summary ?? '';
  return {
    name: own.name,
    kind,
    signatures: [own.call],
    text: entry && own.is ? `${text} Done by ${own.is}.` : text,
    params: [],
    snippet: own.snippet ?? '',
  };
}

/** All words of a notation. */
export function wordsOf(notation: Notation, registry: Entry[]): Word[] {
  if (notation === 'GBBG') return GBBG.map((o) => fromOwn(o, registry, 'operation'));
  if (notation === 'ProGen3d') return PROGEN.map((o) => fromOwn(o, registry, 'operation'));
  if (notation === 'Park') return PARK.map((o) => fromOwn(o, registry, 'operation'));
  return [
    ...registry.map(fromEntry),
    ...ANNOTATIONS.map((o) => fromOwn(o, registry, 'annotation')),
  ];
}

/** The registry's names that the tables above lean on, for a test. */
export const leanedOn = (): string[] => [
  ...new Set([...GBBG, ...PROGEN, ...PARK].flatMap((o) => (o.is ? [o.is] : []))),
];

/** A word of a notation; operations of park grammars do not mind capitals. */
export function findWord(words: Word[], name: string, notation: Notation): Word | undefined {
  const exact = words.find((w) => w.name === name);
  if (exact || notation !== 'Park') return exact;
  return words.find((w) => w.name.toLowerCase() === name.toLowerCase());
}
