// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Of a mesh that holds the triangles of many leaves, those of the leaves that are to be seen: their
// corners are copied together from runs of leaves. The vertices stay where they are.

import * as THREE from 'three';
import type { Piece } from '../lib/chunks';
import type { Part } from './detail';
import {
  joinedRuns,
  pixelsIn,
  sortIntoRuns,
  worthMore,
  worthOf,
  type PixelIn,
  type Runs,
  type Things,
} from './runs';

/** Leaves of a mesh whose corners have been put in the order of runs. */
interface Sorted {
  runs: Omit<Runs, 'order'>;
  /** Corners up to each leaf. */
  corners: Uint32Array;
}

/** Of pieces that have been sorted: an update of a large model leaves most as they were. */
const known = new WeakMap<Piece, Sorted>();

export class Merged implements Part {
  readonly transparent: boolean;
  private readonly runs: Omit<Runs, 'order'>;
  private readonly corners: Uint32Array;
  /** In the order of the runs. */
  private readonly all: Uint32Array;
  private readonly taken: Uint32Array;
  /** How many of each cell are in the picture already. */
  private readonly done: Uint32Array;

  constructor(
    private readonly mesh: THREE.Mesh,
    pieces?: Piece[],
  ) {
    const { geometry } = mesh;
    this.transparent = (mesh.material as THREE.Material).transparent;
    const leaf = geometry.getAttribute('leaf').array as Float32Array;
    const position = geometry.getAttribute('position').array as Float32Array;
    this.all = geometry.index!.array as Uint32Array;
    const parts = pieces
      ? pieces.map((piece) => sortedOnce(piece, leaf, position))
      : [sorted(this.all, leaf, position)];
    this.runs = joinedRuns(parts.map((part) => part.runs));
    this.corners = joinedCorners(parts, this.runs.worth.length);
    this.taken = new Uint32Array(this.runs.cells.length);
    this.done = this.taken.slice();
    geometry.setIndex(
      new THREE.BufferAttribute(new Uint32Array(this.all.length), 1).setUsage(
        THREE.DynamicDrawUsage,
      ) as THREE.BufferAttribute,
    );
    geometry.setDrawRange(0, 0);
  }

  seen(pixelIn: PixelIn): Float64Array {
    return pixelsIn(this.runs.cells, pixelIn);
  }

  take(pixel: Float64Array, pixels: number): number {
    const { cells, worth } = this.runs;
    let corners = 0;
    for (let i = 0; i < cells.length; ++i) {
      const cell = cells[i]!;
      this.taken[i] = worthMore(worth, cell, pixels * pixel[i]!);
      corners += this.corners[cell.from + this.taken[i]!]! - this.corners[cell.from]!;
    }
    return corners / 3;
  }

  forget(): void {
    this.done.fill(0);
  }

  fill(): void {
    const index = this.mesh.geometry.index!;
    let n = 0;
    this.runs.cells.forEach((cell, i) => {
      if (this.done[i]! >= this.taken[i]!) return;
      const part = this.all.subarray(
        this.corners[cell.from + this.done[i]!]!,
        this.corners[cell.from + this.taken[i]!]!,
      );
      (index.array as Uint32Array).set(part, n);
      n += part.length;
      this.done[i] = this.taken[i]!;
    });
    this.mesh.geometry.setDrawRange(0, n);
    this.mesh.visible = n > 0;
    index.clearUpdateRanges();
    index.addUpdateRange(0, n);
    index.needsUpdate = n > 0;
  }

  hide(): void {
    this.mesh.visible = false;
  }
}

function sortedOnce(piece: Piece, leaf: Float32Array, position: Float32Array): Sorted {
  const before = known.get(piece);
  if (before) return before;
  const now = sorted(piece.index!, leaf, position);
  known.set(piece, now);
  return now;
}

/** Puts the corners of leaves in the order of their runs. */
function sorted(index: Uint32Array, leaf: Float32Array, position: Float32Array): Sorted {
  const { starts, things } = leavesOf(index, leaf, position);
  const { order, ...runs } = sortIntoRuns(things);
  const corners = new Uint32Array(order.length + 1);
  const before = index.slice();
  order.forEach((i, k) => {
    const part = before.subarray(starts[i]!, starts[i + 1]!);
    index.set(part, corners[k]!);
    corners[k + 1] = corners[k]! + part.length;
  });
  return { runs, corners };
}

function joinedCorners(parts: Sorted[], leaves: number): Uint32Array {
  const out = new Uint32Array(leaves + 1);
  let at = 0;
  let corner = 0;
  for (const { corners } of parts) {
    for (let k = 1; k < corners.length; ++k) out[at + k] = corners[k]! + corner;
    at += corners.length - 1;
    corner += corners[corners.length - 1]!;
  }
  return out;
}

/** The leaves of some corners, and where those of each begin. */
function leavesOf(
  corners: Uint32Array,
  leaf: Float32Array,
  position: Float32Array,
): { starts: number[]; things: Things } {
  const starts: number[] = [];
  for (let c = 0; c < corners.length; c += 3) {
    if (c === 0 || leaf[corners[c]!] !== leaf[corners[c - 3]!]) starts.push(c);
  }
  const n = starts.length;
  starts.push(corners.length);
  const things: Things = {
    at: new Float32Array(n * 3),
    reach: new Float32Array(n),
    worth: new Float32Array(n),
  };
  const box = new THREE.Box3();
  const point = new THREE.Vector3();
  for (let i = 0; i < n; ++i) {
    box.makeEmpty();
    for (let c = starts[i]!; c < starts[i + 1]!; ++c)
      box.expandByPoint(point.fromArray(position, corners[c]! * 3));
    box.getCenter(point).toArray(things.at, i * 3);
    const sides = box.getSize(point).toArray();
    things.reach[i] = Math.max(...sides);
    things.worth[i] = worthOf(sides, (starts[i + 1]! - starts[i]!) / 3);
  }
  return { starts, things };
}
