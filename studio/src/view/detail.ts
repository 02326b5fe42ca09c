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
import { Merged } from './merged';
import { sortIntoRuns, worthMore, worthOf, type Least, type Runs, type Things } from './runs';

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
  /**
   * Takes what is worth no less than is said for its cell, and tells how many triangles that are.
   */
  take(least: Least): number;
  /** Puts together what was taken and is not in the picture yet. */
  fill(): void;
  /** Nothing is in the picture yet. */
  forget(): void;
  /** Draws nothing until the next filling. */
  hide(): void;
}

export function trianglesOf(mesh: THREE.Mesh): number {
  const index = (mesh.geometry as THREE.BufferGeometry).index;
  const each = (index?.count ?? 0) / 3;
  return mesh instanceof THREE.InstancedMesh ? each * mesh.count : each;
}

export class Detail {
  private readonly parts: Part[] = [];

  static worthIt(meshes: THREE.Mesh[]): boolean {
    return meshes.reduce((sum, m) => sum + trianglesOf(m), 0) >= WORTH_IT;
  }

  /** Null for models that need none, or when `over` has become true. */
  static async of(meshes: THREE.Mesh[], over: () => boolean): Promise<Detail | null> {
    if (!Detail.worthIt(meshes)) return null;
    const out = new Detail();
    let began = performance.now();
    for (const mesh of meshes) {
      out.parts.push(mesh instanceof THREE.InstancedMesh ? new Instances(mesh) : new Merged(mesh));
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
    const least = worthSeeing(camera, height);
    this.forget();
    for (let pixels = LEAST_PIXELS; pixels < MOST_PIXELS; pixels *= FINER) {
      if (this.take(least(pixels)) <= budget) break;
    }
    for (const part of this.parts) part.fill();
  }

  /**
   * Takes helping after helping of what such a camera sees, largest first; true for the last one,
   * which has all that is transparent.
   */
  *helpings(camera: THREE.PerspectiveCamera, height: number): Generator<boolean, void> {
    const least = worthSeeing(camera, height);
    this.forget();
    let pixels = MOST_PIXELS;
    for (let before = 0, last = false; !last;) {
      const finer = () => Math.max(LEAST_PIXELS, pixels / FINER);
      do pixels = finer();
      while (pixels > LEAST_PIXELS && this.take(least(finer())) - before <= HELPING);
      before = this.take(least(pixels));
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
    this.take(() => texel * LEAST_TEXELS);
    for (const part of this.parts) part.fill();
  }

  private take(least: Least): number {
    return this.parts.reduce((sum, part) => sum + part.take(least), 0);
  }

  private forget(): void {
    for (const part of this.parts) part.forget();
  }
}

/** What is worth so many pixels of a camera's picture. */
function worthSeeing(camera: THREE.PerspectiveCamera, height: number): (pixels: number) => Least {
  const frustum = new THREE.Frustum().setFromProjectionMatrix(
    new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
  );
  const pixel = (2 * Math.tan((camera.fov * Math.PI) / 360)) / height;
  const eye = camera.position.clone();
  return (pixels) => (cell) => {
    if (!frustum.intersectsSphere(new THREE.Sphere(cell.centre, cell.radius))) return Infinity;
    return pixels * pixel * Math.max(camera.near, eye.distanceTo(cell.centre) - cell.radius);
  };
}

/** Of instances of one geometry, those that are to be seen. */
class Instances implements Part {
  readonly transparent: boolean;
  private readonly runs: Runs;
  private readonly triangles: number;
  private readonly matrix: Float32Array;
  private readonly tint: Uint8Array;
  private readonly leaf: Float32Array;
  /** How many of each cell are drawn. */
  private readonly taken: Uint32Array;
  /** How many of each cell are in the picture already. */
  private readonly done: Uint32Array;
  /** How many there is room for on the graphics card. */
  private room = 0;

  constructor(private readonly mesh: THREE.InstancedMesh) {
    const n = mesh.count;
    const geometry = mesh.geometry as THREE.BufferGeometry;
    this.transparent = (mesh.material as THREE.Material).transparent;
    this.triangles = (geometry.index?.count ?? 0) / 3;
    this.matrix = mesh.instanceMatrix.array as Float32Array;
    this.tint = (geometry.getAttribute('tint') as THREE.InstancedBufferAttribute)
      .array as Uint8Array;
    this.leaf = (geometry.getAttribute('leaf') as THREE.InstancedBufferAttribute)
      .array as Float32Array;
    this.runs = sortIntoRuns(placesOf(geometry, this.matrix, n));
    // The draw list itself is put in order, so that it stays one.
    const ordered = {
      matrix: new Float32Array(n * 16),
      tint: new Uint8Array(n * 4),
      leaf: new Float32Array(n),
    };
    for (let k = 0; k < n; ++k) {
      const i = this.runs.order[k]!;
      ordered.matrix.set(this.matrix.subarray(i * 16, i * 16 + 16), k * 16);
      ordered.tint.set(this.tint.subarray(i * 4, i * 4 + 4), k * 4);
      ordered.leaf[k] = this.leaf[i]!;
    }
    this.matrix.set(ordered.matrix);
    this.tint.set(ordered.tint);
    this.leaf.set(ordered.leaf);
    this.taken = new Uint32Array(this.runs.cells.length);
    this.done = this.taken.slice();
    this.makeRoom(1);
    mesh.count = 0;
  }

  take(least: Least): number {
    let count = 0;
    this.runs.cells.forEach(
      (cell, i) => (count += this.taken[i] = worthMore(this.runs.worth, cell, least(cell))),
    );
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
