// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Chunks: the draw list of a large model, put together from chunks of which an edit brings only
// those that it changes. The fields are described in docs/dev/studio-protocol.md. The arrays of a
// batch are those of its pieces, one behind the other, and a piece that has been put into a list is
// a part of the list's arrays: nothing is held twice.

import { head, type Batch, type DrawList, type Look, type Section } from './protocol';

/** What a chunk has of a batch. */
export interface Piece {
  geometry: Geometry;
  /** Merged triangles. */
  position?: Float32Array;
  normal?: Float32Array;
  uv?: Float32Array;
  index?: Uint32Array;
  /** Instances. */
  matrix?: Float32Array;
  color: Uint8Array;
  leaf: Float32Array;
  /** What has been added to its corners and to its leaves, where it lies now. */
  vertices: number;
  leaves: number;
}

/** What all instances of a batch have in common; null of one of merged triangles. */
type Geometry = Pick<Batch, 'position' | 'normal' | 'index' | 'uv'> | null;

interface Chunk {
  leaves: number;
  /** With the number of the batch, in the list at work. */
  pieces: [number, Piece][];
}

/** What is kept of a list for the next update. */
export interface Held {
  /** The derivation that it is of. */
  derivation: number;
  geometries: Geometry[];
  chunks: Chunk[];
}

interface BatchHead {
  look: number;
  /** Its number in the list before. */
  kept?: number;
  position?: Section;
  normal?: Section;
  index?: Section;
  uv?: Section;
}

interface UpdateHead {
  leaves: number;
  looks: Look[];
  batches: BatchHead[];
  chunks: Section;
}

const NEW = 0xffffffff;
/** Their numbers have 16 bits, those of more have 32. */
const FEW_VERTICES = 1 << 16;

/** The list after an update of the one that is held, and what is to be held from then on. */
export function updated(
  bytes: ArrayBuffer,
  from: number,
  derivation: number,
  before: Held | null,
): { draw: DrawList; held: Held } {
  const { json, start } = head(bytes, from, 'GBU2');
  const update = json as UpdateHead;
  const geometries = update.batches.map((batch): Geometry => {
    if (batch.kept !== undefined) return before!.geometries[batch.kept]!;
    return batch.position ? geometryOf(bytes, start, batch) : null;
  });
  const hasUv = update.batches.map((batch) => update.looks[batch.look]!.map !== undefined);
  const chunks = chunksOf(bytes, start, update, { geometries, hasUv, before });
  const draw: DrawList = {
    leaves: update.leaves,
    truncated: false,
    looks: update.looks,
    batches: joined(update, geometries, chunks),
  };
  return { draw, held: { derivation, geometries, chunks } };
}

function geometryOf(bytes: ArrayBuffer, start: number, batch: BatchHead): Geometry {
  // Copies: the bytes of the answer are not kept for them.
  const floats = ([at, count]: Section) => new Float32Array(bytes, start + at, count).slice();
  return {
    position: floats(batch.position!),
    normal: floats(batch.normal!),
    index: new Uint32Array(bytes, start + batch.index![0], batch.index![1]).slice(),
    ...(batch.uv ? { uv: floats(batch.uv) } : {}),
  };
}

interface Batches {
  geometries: Geometry[];
  hasUv: boolean[];
  before: Held | null;
}

function chunksOf(
  bytes: ArrayBuffer,
  start: number,
  update: UpdateHead,
  batches: Batches,
): Chunk[] {
  const [at, count] = update.chunks;
  const kept = new Uint32Array(bytes, start + at, count);
  const leaves = new Uint32Array(bytes, start + at + count * 4, count);
  const reader = new Reader(bytes, start + at + count * 8);
  const numbers = new Map<number, number>();
  update.batches.forEach((batch, i) => {
    if (batch.kept !== undefined) numbers.set(batch.kept, i);
  });
  return Array.from(kept, (number, i): Chunk => {
    const before = number === NEW ? null : batches.before!.chunks[number]!;
    const pieces = before
      ? before.pieces.map(([batch, piece]): [number, Piece] => [numbers.get(batch)!, piece])
      : reader.pieces(batches);
    return { leaves: leaves[i]!, pieces };
  });
}

/** Goes through the chunks that have come. */
class Reader {
  constructor(
    private readonly bytes: ArrayBuffer,
    private at: number,
  ) {}

  pieces({ geometries, hasUv }: Batches): [number, Piece][] {
    return Array.from({ length: this.number() }, (): [number, Piece] => {
      const batch = this.number();
      const geometry = geometries[batch]!;
      return [batch, geometry ? this.instances(geometry) : this.triangles(hasUv[batch]!)];
    });
  }

  private number(): number {
    return this.numbers(1)[0]!;
  }

  private numbers(count: number): Uint32Array<ArrayBuffer> {
    const out = new Uint32Array(this.bytes, this.at, count);
    this.at += count * 4;
    return out;
  }

  private floats(count: number): Float32Array<ArrayBuffer> {
    const out = new Float32Array(this.bytes, this.at, count);
    this.at += count * 4;
    return out;
  }

  /** Of vertices or of their normals; `vertices`: how many there are. */
  private vertexNumbers(count: number, vertices: number): Uint16Array | Uint32Array {
    if (vertices > FEW_VERTICES) return this.numbers(count);
    const out = new Uint16Array(this.bytes, this.at, count);
    this.at += Math.ceil(count / 2) * 4;
    return out;
  }

  private instances(geometry: Geometry): Piece {
    const count = this.number();
    const matrix = this.floats(count * 16);
    const color = new Uint8Array(this.bytes, this.at, count * 4);
    this.at += count * 4;
    return { geometry, matrix, color, leaf: this.floats(count), vertices: 0, leaves: 0 };
  }

  private triangles(hasUv: boolean): Piece {
    const counts = this.numbers(4) as unknown as [number, number, number, number];
    const [vertices, corners, runs, normals] = counts;
    const position = this.floats(vertices * 3);
    const table = this.floats(normals * 3);
    const uv = hasUv ? this.floats(vertices * 2) : undefined;
    const color = new Uint32Array(vertices);
    const leaf = new Float32Array(vertices);
    const run = this.numbers(runs * 4);
    for (let r = 0, at = 0; r < run.length; r += 4) {
      const end = at + run[r + 2]!;
      leaf.fill(run[r]!, at, end);
      color.fill(run[r + 1]!, at, end);
      at = end;
    }
    const normal = spread(table, this.vertexNumbers(vertices, vertices));
    const index = Uint32Array.from(this.vertexNumbers(corners, vertices));
    return {
      geometry: null,
      position,
      normal,
      ...(uv ? { uv } : {}),
      index,
      color: new Uint8Array(color.buffer),
      leaf,
      vertices: 0,
      leaves: 0,
    };
  }
}

/** The vectors of a table by their numbers. */
function spread(table: Float32Array, numbers: Uint16Array | Uint32Array): Float32Array {
  const out = new Float32Array(numbers.length * 3);
  for (let i = 0, to = 0; i < numbers.length; ++i) {
    const from = numbers[i]! * 3;
    out[to++] = table[from]!;
    out[to++] = table[from + 1]!;
    out[to++] = table[from + 2]!;
  }
  return out;
}

/** The pieces of each batch, with the first leaf of the chunk that each is of. */
function sorted(batches: number, chunks: Chunk[]): [Piece, number][][] {
  const out = Array.from({ length: batches }, (): [Piece, number][] => []);
  let leaf = 0;
  for (const chunk of chunks) {
    for (const [batch, piece] of chunk.pieces) out[batch]!.push([piece, leaf]);
    leaf += chunk.leaves;
  }
  return out;
}

function joined(update: UpdateHead, geometries: Geometry[], chunks: Chunk[]): Batch[] {
  const pieces = sorted(geometries.length, chunks);
  return update.batches.map(({ look }, i): Batch => {
    const geometry = geometries[i];
    return geometry
      ? { look, ...geometry, ...instances(pieces[i]!), pieces: pieces[i]!.map(([piece]) => piece) }
      : { look, ...triangles(pieces[i]!), pieces: pieces[i]!.map(([piece]) => piece) };
  });
}

/** Puts the arrays of pieces behind each other, and each piece where its own have come to lie. */
class Joint {
  constructor(private readonly pieces: [Piece, number][]) {}

  floats(name: 'position' | 'normal' | 'uv' | 'matrix'): Float32Array {
    const out = new Float32Array(this.pieces.reduce((n, [p]) => n + (p[name]?.length ?? 0), 0));
    let at = 0;
    for (const [piece] of this.pieces) {
      const part = piece[name];
      if (!part) continue;
      out.set(part, at);
      piece[name] = out.subarray(at, (at += part.length));
    }
    return out;
  }

  colors(): Uint8Array {
    const out = new Uint8Array(this.pieces.reduce((n, [p]) => n + p.color.length, 0));
    let at = 0;
    for (const [piece] of this.pieces) {
      out.set(piece.color, at);
      piece.color = out.subarray(at, (at += piece.color.length));
    }
    return out;
  }

  leaves(): Float32Array {
    const out = new Float32Array(this.pieces.reduce((n, [p]) => n + p.leaf.length, 0));
    let at = 0;
    for (const [piece, first] of this.pieces) {
      const shift = first - piece.leaves;
      const part = piece.leaf;
      for (let i = 0; i < part.length; ++i) out[at + i] = part[i]! + shift;
      piece.leaf = out.subarray(at, (at += part.length));
      piece.leaves = first;
    }
    return out;
  }

  indices(): Uint32Array {
    const out = new Uint32Array(this.pieces.reduce((n, [p]) => n + p.index!.length, 0));
    let at = 0;
    let vertices = 0;
    for (const [piece] of this.pieces) {
      const shift = vertices - piece.vertices;
      const part = piece.index!;
      for (let i = 0; i < part.length; ++i) out[at + i] = part[i]! + shift;
      piece.index = out.subarray(at, (at += part.length));
      piece.vertices = vertices;
      vertices += piece.leaf.length;
    }
    return out;
  }
}

function instances(pieces: [Piece, number][]): Pick<Batch, 'matrix' | 'color' | 'leaf'> {
  const joint = new Joint(pieces);
  return { matrix: joint.floats('matrix'), color: joint.colors(), leaf: joint.leaves() };
}

function triangles(pieces: [Piece, number][]): Omit<Batch, 'look'> {
  const joint = new Joint(pieces);
  const uv = joint.floats('uv');
  return {
    position: joint.floats('position'),
    normal: joint.floats('normal'),
    ...(uv.length ? { uv } : {}),
    index: joint.indices(),
    color: joint.colors(),
    leaf: joint.leaves(),
  };
}
