// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Detail: of a large model only what can be seen is drawn: instances, and leaves of merged meshes.
// They are sorted once into runs by cell and size. For each picture the runs of cells in sight are
// copied together, a few memory moves a cell; where that is still too much, the least goes up. A
// picture that stands still is made of several such helpings, one over the other, so that it can
// hold millions of triangles and yet nobody waits long for the next one. Of instances the graphics
// card holds what was drawn at once at most, not all.

import * as THREE from 'three';
import type { Piece } from '../lib/chunks';
import { Merged } from './merged';
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

/** Models with fewer triangles are drawn whole. */
const WORTH_IT = 600_000;
/**
 * Triangles of a picture while things move, of a helping of one that stands still, and of all of
 * that.
 */
export const MOVING = 300_000;
const HELPING = 600_000;
const STILL = 8_000_000;
/** Of a picture that is taken at once. */
export const POSED = 1_000_000;
/** What takes fewer pixels is left out, and so is what takes fewer texels of shadows. */
const LEAST_PIXELS = 1.2;
const LEAST_TEXELS = 2.5;
const MOST_PIXELS = 200;
/** From one least to the next one. */
const FINER = 1.2;
/** The time that sorting may take before others have a turn. */
const SLICE_MS = 12;
/** Instances that there is room for before any are drawn. */
const LEAST_ROOM = 64;

/** What is drawn of one mesh. */
export interface Part {
  readonly transparent: boolean;
  /** What is worth one pixel in each of its cells. */
  seen(pixelIn: PixelIn): Float64Array;
  /**
   * Takes what is worth so many pixels, and tells how many triangles that are.
   */
  take(pixel: Float64Array, pixels: number): number;
  /** Puts together what was taken and is not in the picture yet. */
  fill(): void;
  /** Nothing is in the picture yet. */
  forget(): void;
  /** Draws nothing until the next filling. */
  hide(): void;
}

/** A mesh, with the pieces that its arrays were put together from, if it was. */
export interface Detailed {
  mesh: THREE.Mesh;
  pieces?: Piece[] | undefined;
}

/** What a camera, or the sun, makes of the cells of each part. */
type Sight = Float64Array[];

export function trianglesOf(mesh: THREE.Mesh): number {
  const index = (mesh.geometry as THREE.BufferGeometry).index;
  const each = (index?.count ?? 0) / 3;
  return mesh instanceof THREE.InstancedMesh ? each * mesh.count : each;
}

export class Detail {
  private readonly parts: Part[] = [];

  static worthIt(meshes: Detailed[]): boolean {
    return meshes.reduce((sum, { mesh }) => sum + trianglesOf(mesh), 0) >= WORTH_IT;
  }

  /** Null for models that need none, or when `over` has become true. */
  static async of(meshes: Detailed[], over: () => boolean): Promise<Detail | null> {
    if (!Detail.worthIt(meshes)) return null;
    const out = new Detail();
    let began = performance.now();
    for (const { mesh, pieces } of meshes) {
      out.parts.push(
        mesh instanceof THREE.InstancedMesh
          ? new Instances(mesh, pieces)
          : new Merged(mesh, pieces),
      );
      if (performance.now() - began < SLICE_MS) continue;
      await new Promise((go) => setTimeout(go, 0));
      if (over()) return null;
      began = performance.now();
    }
    return out;
  }

  /**
   * Takes what is in sight of a camera and large enough on a canvas of so many pixels in height.
   */
  select(camera: THREE.PerspectiveCamera, height: number, budget: number): void {
    const sight = this.sightOf(pixelsOf(camera, height));
    this.forget();
    for (let pixels = LEAST_PIXELS; pixels < MOST_PIXELS; pixels *= FINER) {
      if (this.take(sight, pixels) <= budget) break;
    }
    for (const part of this.parts) part.fill();
  }

  /**
   * Takes helping after helping of what such a camera sees, largest first; true for the last one,
   * which has all that is transparent.
   */
  *helpings(camera: THREE.PerspectiveCamera, height: number): Generator<boolean, void> {
    const sight = this.sightOf(pixelsOf(camera, height));
    this.forget();
    let pixels = MOST_PIXELS;
    for (let before = 0, last = false; !last;) {
      const finer = () => Math.max(LEAST_PIXELS, pixels / FINER);
      do pixels = finer();
      while (pixels > LEAST_PIXELS && this.take(sight, finer()) - before <= HELPING);
      before = this.take(sight, pixels);
      last = pixels === LEAST_PIXELS || before > STILL;
      for (const part of this.parts) {
        if (part.transparent && !last) part.hide();
        else part.fill();
      }
      yield last;
    }
  }

  /** Takes all that casts a shadow which a map of that many metres a texel can show. */
  selectForShadow(texel: number): void {
    this.forget();
    this.take(
      this.sightOf(() => texel),
      LEAST_TEXELS,
    );
    for (const part of this.parts) part.fill();
  }

  private sightOf(pixelIn: PixelIn): Sight {
    return this.parts.map((part) => part.seen(pixelIn));
  }

  private take(sight: Sight, pixels: number): number {
    return this.parts.reduce((sum, part, i) => sum + part.take(sight[i]!, pixels), 0);
  }

  private forget(): void {
    for (const part of this.parts) part.forget();
  }
}

/** What one pixel of a camera's picture is worth, cell by cell. */
function pixelsOf(camera: THREE.PerspectiveCamera, height: number): PixelIn {
  const frustum = new THREE.Frustum().setFromProjectionMatrix(
    new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
  );
  const pixel = (2 * Math.tan((camera.fov * Math.PI) / 360)) / height;
  const eye = camera.position.clone();
  const sphere = new THREE.Sphere();
  return (cell) => {
    if (!frustum.intersectsSphere(sphere.set(cell.centre, cell.radius))) return Infinity;
    return pixel * Math.max(camera.near, eye.distanceTo(cell.centre) - cell.radius);
  };
}

/** The arrays of instances. */
interface Placed {
  matrix: Float32Array;
  tint: Uint8Array;
  leaf: Float32Array;
}

/** Of pieces that have been sorted: an update of a large model leaves most as they were. */
const known = new WeakMap<Piece, Omit<Runs, 'order'>>();

/** Of instances of one geometry, those that are to be seen. */
class Instances implements Part {
  readonly transparent: boolean;
  private readonly runs: Omit<Runs, 'order'>;
  private readonly triangles: number;
  readonly matrix: Float32Array;
  readonly tint: Uint8Array;
  readonly leaf: Float32Array;
  /** How many of each cell are drawn. */
  private readonly taken: Uint32Array;
  /** How many of each cell are in the picture already. */
  private readonly done: Uint32Array;
  /** How many there is room for on the graphics card. */
  private room = 0;

  constructor(
    private readonly mesh: THREE.InstancedMesh,
    pieces?: Piece[],
  ) {
    const geometry = mesh.geometry as THREE.BufferGeometry;
    this.transparent = (mesh.material as THREE.Material).transparent;
    this.triangles = (geometry.index?.count ?? 0) / 3;
    this.matrix = mesh.instanceMatrix.array as Float32Array;
    this.tint = (geometry.getAttribute('tint') as THREE.InstancedBufferAttribute)
      .array as Uint8Array;
    this.leaf = (geometry.getAttribute('leaf') as THREE.InstancedBufferAttribute)
      .array as Float32Array;
    const sort = (placed: Placed) => sorted(geometry, placed);
    this.runs = joinedRuns(pieces ? pieces.map((piece) => sortedOnce(piece, sort)) : [sort(this)]);
    this.taken = new Uint32Array(this.runs.cells.length);
    this.done = this.taken.slice();
    this.makeRoom(1);
    mesh.count = 0;
  }

  seen(pixelIn: PixelIn): Float64Array {
    return pixelsIn(this.runs.cells, pixelIn);
  }

  take(pixel: Float64Array, pixels: number): number {
    const { cells, worth } = this.runs;
    let count = 0;
    for (let i = 0; i < cells.length; ++i)
      count += this.taken[i] = worthMore(worth, cells[i]!, pixels * pixel[i]!);
    return count * this.triangles;
  }

  forget(): void {
    this.done.fill(0);
  }

  hide(): void {
    this.mesh.visible = false;
  }

  fill(): void {
    this.makeRoom(this.taken.reduce((sum, n, i) => sum + Math.max(0, n - this.done[i]!), 0));
    const { mesh } = this;
    const matrix = mesh.instanceMatrix;
    const tint = mesh.geometry.getAttribute('tint') as THREE.InstancedBufferAttribute;
    const leaf = mesh.geometry.getAttribute('leaf') as THREE.InstancedBufferAttribute;
    let n = 0;
    this.runs.cells.forEach((cell, i) => {
      const [from, to] = [cell.from + this.done[i]!, cell.from + this.taken[i]!];
      if (to <= from) return;
      (matrix.array as Float32Array).set(this.matrix.subarray(from * 16, to * 16), n * 16);
      (tint.array as Uint8Array).set(this.tint.subarray(from * 4, to * 4), n * 4);
      (leaf.array as Float32Array).set(this.leaf.subarray(from, to), n);
      n += to - from;
      this.done[i] = this.taken[i]!;
    });
    mesh.count = n;
    mesh.visible = n > 0;
    for (const attribute of [matrix, tint, leaf]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, n * attribute.itemSize);
      attribute.needsUpdate = n > 0;
    }
  }

  /**
   * Room for so many instances; what there was room for stays, so that moving to and fro changes
   * nothing.
   */
  private makeRoom(count: number): void {
    if (count <= this.room) return;
    this.room = Math.min(this.leaf.length, Math.max(LEAST_ROOM, Math.ceil(count * 1.25)));
    const { mesh, room } = this;
    mesh.instanceMatrix = new THREE.InstancedBufferAttribute(
      new Float32Array(room * 16),
      16,
    ).setUsage(THREE.DynamicDrawUsage) as THREE.InstancedBufferAttribute;
    mesh.geometry.setAttribute(
      'tint',
      new THREE.InstancedBufferAttribute(new Uint8Array(room * 4), 4, true),
    );
    mesh.geometry.setAttribute(
      'leaf',
      new THREE.InstancedBufferAttribute(new Float32Array(room), 1),
    );
  }
}

function sortedOnce(
  piece: Piece,
  sort: (placed: Placed) => Omit<Runs, 'order'>,
): Omit<Runs, 'order'> {
  const before = known.get(piece);
  if (before) return before;
  const now = sort({ matrix: piece.matrix!, tint: piece.color, leaf: piece.leaf });
  known.set(piece, now);
  return now;
}

/** Puts instances in the order of their runs: the draw list itself, so that it stays one. */
function sorted(geometry: THREE.BufferGeometry, placed: Placed): Omit<Runs, 'order'> {
  const n = placed.leaf.length;
  const { order, ...runs } = sortIntoRuns(placesOf(geometry, placed.matrix, n));
  const [matrix, tint, leaf] = [placed.matrix.slice(), placed.tint.slice(), placed.leaf.slice()];
  order.forEach((i, k) => {
    placed.matrix.set(matrix.subarray(i * 16, i * 16 + 16), k * 16);
    placed.tint.set(tint.subarray(i * 4, i * 4 + 4), k * 4);
    placed.leaf[k] = leaf[i]!;
  });
  return runs;
}

function placesOf(geometry: THREE.BufferGeometry, from: Float32Array, n: number): Things {
  geometry.computeBoundingBox();
  const box = geometry.boundingBox!;
  const middle = box.getCenter(new THREE.Vector3());
  const extent = box.getSize(new THREE.Vector3());
  const triangles = (geometry.index?.count ?? 0) / 3;
  const out: Things = {
    at: new Float32Array(n * 3),
    reach: new Float32Array(n),
    worth: new Float32Array(n),
  };
  for (let i = 0; i < n; ++i) {
    const m = i * 16;
    const side = (k: number) => Math.hypot(from[m + k]!, from[m + k + 1]!, from[m + k + 2]!);
    const sides: [number, number, number] = [
      side(0) * extent.x,
      side(4) * extent.y,
      side(8) * extent.z,
    ];
    out.reach[i] = Math.max(...sides);
    out.worth[i] = worthOf(sides, triangles);
    for (let k = 0; k < 3; ++k) {
      out.at[i * 3 + k] =
        from[m + k]! * middle.x +
        from[m + 4 + k]! * middle.y +
        from[m + 8 + k]! * middle.z +
        from[m + 12 + k]!;
    }
  }
  return out;
}
