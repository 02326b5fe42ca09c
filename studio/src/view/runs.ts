// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Runs: things in space, sorted once by cell of a grid over the ground and then by how much a
// picture would miss them, so that what is worth drawing in a cell is the beginning of a run.

import * as THREE from 'three';

const SIDE = 12;
/** So few things are one cell. */
const FEW = 1500;
/** Things larger than this share of the grid are a cell of their own, so that cells stay small. */
const WIDE_SHARE = 1 / SIDE;

export interface Cell {
  from: number;
  to: number;
  centre: THREE.Vector3;
  radius: number;
}

/**
 * What is worth one pixel in a cell, in metres; Infinity where nothing of it is to be drawn.
 */
export type PixelIn = (cell: Cell) => number;

/** The middle of each thing (x, y, z), its longest side, and what it is worth, in metres. */
export interface Things {
  at: Float32Array;
  reach: Float32Array;
  worth: Float32Array;
}

export interface Runs {
  /** The thing at each place of the order. */
  order: Uint32Array;
  /** In that order. */
  worth: Float32Array;
  cells: Cell[];
}

/** A thing of so many triangles that is a box of these sides covers about this, each way. */
export function worthOf(sides: [number, number, number], triangles: number): number {
  const [a, b, c] = sides;
  const widest = Math.max(a * b, b * c, c * a);
  // For one ball of a tree a dozen walls can be drawn.
  const cheap = Math.min(1.6, Math.max(0.6, Math.sqrt(Math.sqrt(24 / Math.max(1, triangles)))));
  return Math.sqrt(widest) * cheap;
}

export function sortIntoRuns({ at, reach, worth }: Things): Runs {
  const n = worth.length;
  const cellOf = cellsOver(at, reach);
  // One number says cell, worth from most to least, and index; 53 bits hold it.
  const keys = new Float64Array(n);
  for (let i = 0; i < n; ++i) {
    const rank = 65535 - Math.min(65535, Math.round(worth[i]! * 64));
    keys[i] = (cellOf(i) * 65536 + rank) * 4194304 + i;
  }
  keys.sort();
  const out: Runs = { order: new Uint32Array(n), worth: new Float32Array(n), cells: [] };
  const bounds = new THREE.Box3();
  let cell = -1;
  let largest = 0;
  const close = (to: number) => {
    const last = out.cells[out.cells.length - 1];
    if (!last) return;
    last.to = to;
    bounds.getCenter(last.centre);
    last.radius = bounds.getSize(new THREE.Vector3()).length() / 2 + largest;
  };
  for (let k = 0; k < n; ++k) {
    const i = keys[k]! % 4194304;
    const c = Math.floor(keys[k]! / 4194304 / 65536);
    if (c !== cell) {
      close(k);
      out.cells.push({ from: k, to: n, centre: new THREE.Vector3(), radius: 0 });
      bounds.makeEmpty();
      largest = 0;
      cell = c;
    }
    bounds.expandByPoint(new THREE.Vector3(at[i * 3], at[i * 3 + 1], at[i * 3 + 2]));
    largest = Math.max(largest, reach[i]!);
    out.order[k] = i;
    out.worth[k] = worth[i]!;
  }
  close(n);
  return out;
}

/** What a pixel is worth in each cell. A large place has a hundred thousand of them. */
export function pixelsIn(cells: Cell[], pixelIn: PixelIn): Float64Array {
  const out = new Float64Array(cells.length);
  for (let i = 0; i < cells.length; ++i) out[i] = pixelIn(cells[i]!);
  return out;
}

/** Runs behind each other, as one; the order of each is in the things themselves. */
export function joinedRuns(parts: Omit<Runs, 'order'>[]): Omit<Runs, 'order'> {
  const [only] = parts;
  if (only && parts.length === 1) return only;
  const worth = new Float32Array(parts.reduce((n, part) => n + part.worth.length, 0));
  const cells: Cell[] = [];
  let at = 0;
  for (const part of parts) {
    worth.set(part.worth, at);
    for (const cell of part.cells) cells.push({ ...cell, from: cell.from + at, to: cell.to + at });
    at += part.worth.length;
  }
  return { worth, cells };
}

/** How many at the beginning of a cell are worth no less than that. */
export function worthMore(worth: Float32Array, cell: Cell, least: number): number {
  // Of most cells of a large place there is nothing, or all.
  if (cell.to === cell.from || !(worth[cell.from]! >= least)) return 0;
  if (worth[cell.to - 1]! >= least) return cell.to - cell.from;
  let low = cell.from;
  let high = cell.to;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (worth[middle]! >= least) low = middle + 1;
    else high = middle;
  }
  return low - cell.from;
}

function cellsOver(at: Float32Array, reach: Float32Array): (i: number) => number {
  const n = reach.length;
  if (n < FEW) return () => 0;
  let [x0, x1, z0, z1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let i = 0; i < n; ++i) {
    x0 = Math.min(x0, at[i * 3]!);
    x1 = Math.max(x1, at[i * 3]!);
    z0 = Math.min(z0, at[i * 3 + 2]!);
    z1 = Math.max(z1, at[i * 3 + 2]!);
  }
  const wide = Math.max(x1 - x0, z1 - z0) * WIDE_SHARE;
  const place = (v: number, a: number, b: number) =>
    Math.min(SIDE - 1, Math.floor(((v - a) / Math.max(1e-6, b - a)) * SIDE));
  return (i) =>
    reach[i]! > wide
      ? SIDE * SIDE
      : place(at[i * 3]!, x0, x1) * SIDE + place(at[i * 3 + 2]!, z0, z1);
}
