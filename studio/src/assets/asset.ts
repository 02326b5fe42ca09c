// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A model made ready to fill scopes: which point of it goes to the scope's corner, and which box
// from there fills the scope. The engine does the same when it saves (gable asset prepare).

import type { DrawList } from '../lib/protocol';

export type Triple = [number, number, number];

export interface Box {
  min: Triple;
  max: Triple;
}

export interface Preparation {
  /** The point of the model that becomes the scope's corner. */
  pivot: Triple;
  size: Triple;
  /** Degrees about x, then y, then z, around the pivot. */
  rotate: Triple;
  /** The file's up axis is z. */
  zUp: boolean;
}

const tidy = (v: number): number => Math.round(v * 1e6) / 1e6 + 0;

/** Rows of a rotation about x, then y, then z. */
export function rotation([x, y, z]: Triple): number[] {
  const [a, b, c] = [x, y, z].map((d) => (d * Math.PI) / 180) as Triple;
  const [sa, ca, sb, cb, sc, cc] = [
    Math.sin(a),
    Math.cos(a),
    Math.sin(b),
    Math.cos(b),
    Math.sin(c),
    Math.cos(c),
  ];
  return [
    cb * cc,
    sa * sb * cc - ca * sc,
    ca * sb * cc + sa * sc,
    cb * sc,
    sa * sb * sc + ca * cc,
    ca * sb * sc - sa * cc,
    -sb,
    sa * cb,
    ca * cb,
  ];
}

function turned(m: number[], p: Triple): Triple {
  return [0, 3, 6].map((row) => m[row]! * p[0] + m[row + 1]! * p[1] + m[row + 2]! * p[2]) as Triple;
}

/** A point of the file where it stands on the workbench: upright, turned around the pivot. */
export function placed(p: Triple, prep: Preparation): Triple {
  const up = prep.zUp ? ([p[0], p[2], -p[1]] as Triple) : p;
  const d = turned(rotation(prep.rotate), up.map((v, i) => v - prep.pivot[i]!) as Triple);
  return d.map((v, i) => v + prep.pivot[i]!) as Triple;
}

/** A draw list as it stands on the workbench. */
export function placedList(list: DrawList, prep: Preparation): DrawList {
  const m = rotation(prep.rotate);
  const turnAll = (from: Float32Array, isPoint: boolean) => {
    const out = new Float32Array(from.length);
    for (let i = 0; i < from.length; i += 3) {
      const p: Triple = [from[i]!, from[i + 1]!, from[i + 2]!];
      const q = isPoint ? placed(p, prep) : turned(m, prep.zUp ? [p[0], p[2], -p[1]] : p);
      out.set(q, i);
    }
    return out;
  };
  return {
    ...list,
    batches: list.batches.map((b) => {
      if (!b.matrix)
        return { ...b, position: turnAll(b.position, true), normal: turnAll(b.normal, false) };
      const matrix = new Float32Array(b.matrix.length);
      for (let k = 0; k < b.matrix.length; k += 16) {
        const column = (c: number): Triple => [
          b.matrix![k + c * 4]!,
          b.matrix![k + c * 4 + 1]!,
          b.matrix![k + c * 4 + 2]!,
        ];
        for (let c = 0; c < 3; ++c) {
          const v = column(c);
          matrix.set(turned(m, prep.zUp ? [v[0], v[2], -v[1]] : v), k + c * 4);
        }
        matrix.set(placed(column(3), prep), k + 12);
        matrix[k + 15] = 1;
      }
      return { ...b, matrix };
    }),
  };
}

/** The model's box on the workbench, from its positions. */
export function boundsOf(list: DrawList): Box {
  const box: Box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  const add = (x: number, y: number, z: number) => {
    [x, y, z].forEach((v, i) => {
      box.min[i] = Math.min(box.min[i]!, v);
      box.max[i] = Math.max(box.max[i]!, v);
    });
  };
  for (const b of list.batches) {
    const count = b.matrix ? b.matrix.length / 16 : 1;
    for (let k = 0; k < count; ++k) {
      const m = b.matrix?.subarray(k * 16, k * 16 + 16);
      for (let i = 0; i < b.position.length; i += 3) {
        const [x, y, z] = [b.position[i]!, b.position[i + 1]!, b.position[i + 2]!];
        if (!m) add(x, y, z);
        else
          add(
            m[0]! * x + m[4]! * y + m[8]! * z + m[12]!,
            m[1]! * x + m[5]! * y + m[9]! * z + m[13]!,
            m[2]! * x + m[6]! * y + m[10]! * z + m[14]!,
          );
      }
    }
  }
  return box.min[0] <= box.max[0] ? box : { min: [0, 0, 0], max: [1, 1, 1] };
}

/**
 * The size box that holds the model from the pivot on; what is flat gets a metre, as the engine
 * does.
 */
export function fitted(box: Box, pivot: Triple): Triple {
  return box.max.map((v, i) => {
    const size = v - pivot[i]!;
    return size > 1e-9 ? tidy(size) : 1;
  }) as Triple;
}

/** The nine places of a pivot on the floor of the box: column and row 0 to 2, row 0 at the back. */
export function ninth(box: Box, column: number, row: number): Triple {
  const at = (i: 0 | 2, share: number) => tidy(box.min[i] + (box.max[i] - box.min[i]) * share);
  return [at(0, column / 2), tidy(box.min[1]), at(2, row / 2)];
}

/** One side to a length; with `ratio` the others follow. */
export function resized(size: Triple, axis: number, length: number, ratio: boolean): Triple {
  const value = Math.max(1e-3, tidy(length));
  const factor = value / size[axis]!;
  return size.map((v, i) => (i === axis ? value : ratio ? tidy(v * factor) : v)) as Triple;
}

export const snapped = (v: number, step: number): number =>
  step > 0 ? tidy(Math.round(v / step) * step) : tidy(v);

/** What keeps a shape from being saved, or null. */
export function saveTrouble(name: string, size: Triple): string | null {
  if (!name.trim()) return 'The shape needs a name.';
  if (!/^[A-Za-z_][\w-]*$/.test(name))
    return 'A name is letters, digits, - and _, and begins with no digit.';
  return size.every((v) => v > 0 && Number.isFinite(v)) ? null : 'All three sizes are above zero.';
}
