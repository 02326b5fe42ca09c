// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the server says, as types, and the decoding of its binary answers. The fields are described
// in docs/dev/studio-protocol.md.

import { updated, type Held, type Piece } from './chunks';

/** A remedy as an edit: the text in place of what stands there. */
export interface Fix {
  file: string;
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
  text: string;
}

export interface Diagnostic {
  severity: 'error' | 'warning' | 'note';
  code: string;
  message: string;
  hint?: string;
  file?: string;
  line?: number;
  column?: number;
  endLine?: number;
  endColumn?: number;
  shapePath?: string;
  fix?: Fix;
}

export interface Annotation {
  name: string;
  arguments: [string, string][];
}

export interface AttributeInfo {
  name: string;
  type: string;
  /** Not offered to people. */
  hidden: boolean;
  annotations: Annotation[];
}

export interface RuleInfo {
  name: string;
  parameters: number;
  start: boolean;
  file: string;
  line: number;
  /** Not offered as a start rule. */
  hidden: boolean;
  /** What shape it expects (InPolygon, ...), how its model is to be divided (Out). */
  annotations: Annotation[];
}

export type Value = number | boolean | string | Value[] | null;

export interface ReportTotal {
  n: number;
  sum?: number;
  avg?: number;
  min?: number;
  max?: number;
  values?: Record<string, number>;
}

export interface Stats {
  shapes: number;
  /** Taken over from the page's model before. */
  recalled?: number;
  leaves: number;
  faces: number;
  triangles: number;
  instances: number;
  bbox: { min: [number, number, number]; max: [number, number, number] };
  reports: Record<string, ReportTotal>;
  prints: string[];
  seconds: { parse: number; derive: number };
}

export type End = 'done' | 'limit' | 'cancelled' | 'wrong' | 'checked';

export interface Derived {
  end: End;
  derivation?: number;
  startRule: string;
  /** "Default" first. */
  styles: string[];
  rules: RuleInfo[];
  attributes: AttributeInfo[];
  diagnostics: Diagnostic[];
  values?: Record<string, Value>;
  stats?: Stats;
}

export interface Look {
  roughness: number;
  metallic: number;
  opacity?: number;
  cutoff?: number;
  emissive?: number;
  map?: string;
  uv?: [number, number, number, number, number];
}

/** A draw call: merged triangles, or instances of one geometry where `matrix` is there. */
export interface Batch {
  look: number;
  position: Float32Array;
  normal: Float32Array;
  index: Uint32Array;
  uv?: Float32Array;
  /** sRGB with alpha, four bytes a vertex or an instance. */
  color: Uint8Array;
  leaf: Float32Array;
  matrix?: Float32Array;
  /** What it was put together from, where it came in chunks. */
  pieces?: Piece[];
}

export interface DrawList {
  leaves: number;
  truncated: boolean;
  looks: Look[];
  batches: Batch[];
}

/** What a rule drew or looked up in a step. */
export interface Note {
  node: number;
  kind: 'choice' | 'draw' | 'attribute' | 'parameter';
  /** Of an attribute or a parameter, its name; of a draw, the call in the text. */
  name: string;
  value: Value;
  file: number;
  line: number;
  /** What was drawn from 0 to 1. */
  draw: number;
  chance: number;
  /** The alternative, from 0, among `choices`; the one behind the last is `else`. */
  chosen: number;
  choices: number;
}

export interface Tree {
  count: number;
  end: End;
  names: string[];
  files: string[];
  /** Of a derivation in steps. */
  notes: Note[];
  parent: Uint32Array;
  shape: Uint32Array;
  name: Uint32Array;
  file: Uint32Array;
  line: Uint32Array;
  column: Uint32Array;
  endLine: Uint32Array;
  endColumn: Uint32Array;
  firstLeaf: Uint32Array;
  endLeaf: Uint32Array;
  /** 1 leaf, 2 dropped, 4 made by a rule call, so that a step replaces it. */
  flags: Uint32Array;
  /**
   * In the draw list of all steps: the shape as it was made, and as it stays where it is a leaf.
   */
  before: Uint32Array;
  after: Uint32Array;
  /** Twelve a node: origin, x, y, z. */
  frame: Float32Array;
  size: Float32Array;
}

export const NONE = 0xffffffff;

export interface Parts {
  json: unknown;
  bytes: ArrayBuffer;
  start: number;
}

function markAt(bytes: ArrayBuffer, from: number): string {
  return new TextDecoder('latin1').decode(new Uint8Array(bytes, from, 4));
}

/** Splits "MARK", a count, JSON, the rest; throws on another mark. */
export function head(bytes: ArrayBuffer, from: number, mark: string): Parts {
  const found = markAt(bytes, from);
  if (found !== mark) throw new Error(`The server's answer begins with ${found}, not ${mark}.`);
  const size = new DataView(bytes).getUint32(from + 4, true);
  const json: unknown = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, from + 8, size)));
  return { json, bytes, start: from + 8 + size };
}

/** The first byte of an array, and how many numbers it has. */
export type Section = [number, number];
interface BatchHead {
  look: number;
  position: Section;
  normal: Section;
  index: Section;
  uv?: Section;
  color: Section;
  leaf: Section;
  matrix?: Section;
}

export function decodeDrawList(bytes: ArrayBuffer, from = 0): DrawList {
  const { json, start } = head(bytes, from, 'GBL1');
  const list = json as Omit<DrawList, 'batches'> & { batches: BatchHead[] };
  const floats = (s: Section) => new Float32Array(bytes, start + s[0], s[1]);
  const batches = list.batches.map((b): Batch => ({
    look: b.look,
    position: floats(b.position),
    normal: floats(b.normal),
    index: new Uint32Array(bytes, start + b.index[0], b.index[1]),
    color: new Uint8Array(bytes, start + b.color[0], b.color[1] * 4),
    leaf: floats(b.leaf),
    ...(b.uv ? { uv: floats(b.uv) } : {}),
    ...(b.matrix ? { matrix: floats(b.matrix) } : {}),
  }));
  return { ...list, batches };
}

/**
 * A derivation, and its draw list: a whole one, or an update of the one that the page holds. `held`
 * is what it holds then.
 */
export function decodeDerived(
  bytes: ArrayBuffer,
  before: Held | null = null,
): { derived: Derived; draw: DrawList | null; held: Held | null } {
  const { json, start } = head(bytes, 0, 'GBS1');
  const derived = json as Derived;
  if (start >= bytes.byteLength) return { derived, draw: null, held: before };
  if (markAt(bytes, start) === 'GBU2')
    return { derived, ...updated(bytes, start, derived.derivation ?? 0, before) };
  return { derived, draw: decodeDrawList(bytes, start), held: null };
}

/** A model that was read, for the workshop. */
export interface ModelPreview {
  derivation: number;
  /** Least corner, then greatest. */
  bounds: number[];
  stats: Stats;
  draw: DrawList;
}

export function decodeModel(bytes: ArrayBuffer): ModelPreview {
  const { json, start } = head(bytes, 0, 'GBM1');
  return { ...(json as Omit<ModelPreview, 'draw'>), draw: decodeDrawList(bytes, start) };
}

type RawNote = [number, number, string, Value, number, number, number?, number?, number?, number?];
const NOTE_KINDS = ['choice', 'draw', 'attribute', 'parameter'] as const;

function readNote([
  node,
  kind,
  name,
  value,
  file,
  line,
  draw = 0,
  chance = 0,
  chosen = 0,
  choices = 0,
]: RawNote): Note {
  return {
    node,
    kind: NOTE_KINDS[kind] ?? 'draw',
    name,
    value,
    file,
    line,
    draw,
    chance,
    chosen,
    choices,
  };
}

/** The tree, and the draw list of all steps where it was asked for. */
export function decodeTree(bytes: ArrayBuffer): { tree: Tree; draw: DrawList | null } {
  const { json, start } = head(bytes, 0, 'GBT1');
  const said = json as Pick<Tree, 'count' | 'end' | 'names' | 'files'> & { notes?: RawNote[] };
  const n = said.count;
  let at = start;
  const column = () => {
    const out = new Uint32Array(bytes, at, n);
    at += n * 4;
    return out;
  };
  const floats = (each: number) => {
    const out = new Float32Array(bytes, at, n * each);
    at += n * each * 4;
    return out;
  };
  const tree: Tree = {
    ...said,
    notes: (said.notes ?? []).map(readNote),
    parent: column(),
    shape: column(),
    name: column(),
    file: column(),
    line: column(),
    column: column(),
    endLine: column(),
    endColumn: column(),
    firstLeaf: column(),
    endLeaf: column(),
    flags: column(),
    before: column(),
    after: column(),
    frame: floats(12),
    size: floats(3),
  };
  return { tree, draw: at < bytes.byteLength ? decodeDrawList(bytes, at) : null };
}

/** What is known of one leaf. */
export interface LeafInfo {
  name: string;
  rule?: string;
  file?: string;
  line?: number;
  column?: number;
  faces: number;
  vertices: number;
  material: Record<string, string | number>;
  attributes: Record<string, Value>;
  /** Its box: origin, x, y, z; and along these. */
  frame: number[];
  size: number[];
  /**
   * Shapes above that were derived on their own, from the initial one down, with the leaves below
   * each.
   */
  above: { name: string; from: number; to: number }[];
}

/** What lies directly below a shape: name, first leaf, end of its leaves, whether it is a leaf. */
export interface PartsBelow {
  parts: [string, number, number, boolean][];
  /** Those that were left out behind them. */
  more: number;
}
