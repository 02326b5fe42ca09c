// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Detail: of a large model only what can be seen is drawn. Instances are sorted once, by cell of a grid
// over the ground and then by size, so that what is large enough in a cell is the beginning of a run.
// For each picture the runs of cells in sight are copied together, a few memory moves a cell; where
// that is still too much, the least size goes up. The graphics card holds what was drawn at most, not all.

import * as THREE from 'three';

/** Models with fewer triangles are drawn whole. */
const WORTH_IT = 600_000;
/** Triangles of a picture while things move, and of one that stands still. */
export const MOVING = 300_000;
export const STILL = 1_000_000;
/** An instance of fewer pixels is left out. */
const LEAST_PIXELS = 1.2;
const SIDE = 12;
/** Batches below are one cell. */
const FEW = 1500;
/** The time that sorting may take before others have a turn. */
const SLICE_MS = 12;
/** Instances that there is room for before any are drawn. */
const LEAST_ROOM = 64;

interface Cell {
  from: number;
  to: number;
  centre: THREE.Vector3;
  radius: number;
}

interface Sorted {
  mesh: THREE.InstancedMesh;
  triangles: number;
  cells: Cell[];
  /** In the order of cells, falling within each. */
  sizes: Float32Array;
  matrix: Float32Array;
  tint: Uint8Array;
  leaf: Float32Array;
  /** How many of each cell are drawn. */
  taken: Uint32Array;
  /** How many there is room for on the graphics card. */
  room: number;
}

export function trianglesOf(mesh: THREE.Mesh): number {
  const index = (mesh.geometry as THREE.BufferGeometry).index;
  const each = (index?.count ?? 0) / 3;
  return mesh instanceof THREE.InstancedMesh ? each * mesh.count : each;
}

export class Detail {
  private readonly sorted: Sorted[] = [];
  private others = 0;

  static worthIt(meshes: THREE.Mesh[]): boolean {
    return meshes.reduce((sum, m) => sum + trianglesOf(m), 0) >= WORTH_IT;
  }

  /** Null for models that need none, or when `over` has become true. */
  static async of(meshes: THREE.Mesh[], over: () => boolean): Promise<Detail | null> {
    if (!Detail.worthIt(meshes)) return null;
    const out = new Detail();
    let began = performance.now();
    for (const mesh of meshes) {
      if (mesh instanceof THREE.InstancedMesh) out.sorted.push(sortInstances(mesh));
      else out.others += trianglesOf(mesh);
      if (performance.now() - began < SLICE_MS) continue;
      await new Promise((go) => setTimeout(go, 0));
      if (over()) return null;
      began = performance.now();
    }
    return out;
  }

  /** Takes what is in sight of a camera and large enough on a canvas of so many pixels in height. */
  select(camera: THREE.PerspectiveCamera, height: number, budget: number): void {
    const frustum = new THREE.Frustum().setFromProjectionMatrix(
      new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    const pixel = (2 * Math.tan((camera.fov * Math.PI) / 360)) / height;
    const eye = camera.position;
    const seen = (cell: Cell, pixels: number) => {
      if (!frustum.intersectsSphere(new THREE.Sphere(cell.centre, cell.radius))) return Infinity;
      return pixels * pixel * Math.max(camera.near, eye.distanceTo(cell.centre) - cell.radius);
    };
    for (let pixels = LEAST_PIXELS; ; pixels *= 1.35) {
      const triangles = this.count((cell) => seen(cell, pixels));
      if (triangles <= budget || pixels > 60) break;
    }
    this.fill();
  }

  /** Takes all that casts a shadow which a map of that many metres a texel can show. */
  selectForShadow(texel: number): void {
    this.count(() => texel * 1.5);
    this.fill();
  }

  private count(least: (cell: Cell) => number): number {
    let triangles = this.others;
    for (const s of this.sorted) {
      s.cells.forEach((cell, i) => {
        s.taken[i] = longEnough(s.sizes, cell, least(cell));
        triangles += s.taken[i]! * s.triangles;
      });
    }
    return triangles;
  }

  private fill(): void {
    for (const s of this.sorted) {
      makeRoom(s, s.taken.reduce((sum, n) => sum + n, 0));
      const matrix = s.mesh.instanceMatrix;
      const tint = s.mesh.geometry.getAttribute('tint') as THREE.InstancedBufferAttribute;
      const leaf = s.mesh.geometry.getAttribute('leaf') as THREE.InstancedBufferAttribute;
      let n = 0;
      s.cells.forEach((cell, i) => {
        const to = cell.from + s.taken[i]!;
        if (to === cell.from) return;
        (matrix.array as Float32Array).set(s.matrix.subarray(cell.from * 16, to * 16), n * 16);
        (tint.array as Uint8Array).set(s.tint.subarray(cell.from * 4, to * 4), n * 4);
        (leaf.array as Float32Array).set(s.leaf.subarray(cell.from, to), n);
        n += s.taken[i]!;
      });
      s.mesh.count = n;
      s.mesh.visible = n > 0;
      for (const attribute of [matrix, tint, leaf]) {
        attribute.clearUpdateRanges();
        attribute.addUpdateRange(0, n * attribute.itemSize);
        attribute.needsUpdate = n > 0;
      }
    }
  }
}

/** Room for so many instances; what there was room for stays, so that moving to and fro changes nothing. */
function makeRoom(s: Sorted, count: number): void {
  if (count <= s.room) return;
  s.room = Math.min(s.sizes.length, Math.max(LEAST_ROOM, Math.ceil(count * 1.25)));
  s.mesh.instanceMatrix = new THREE.InstancedBufferAttribute(new Float32Array(s.room * 16), 16).setUsage(THREE.DynamicDrawUsage) as THREE.InstancedBufferAttribute;
  s.mesh.geometry.setAttribute('tint', new THREE.InstancedBufferAttribute(new Uint8Array(s.room * 4), 4, true));
  s.mesh.geometry.setAttribute('leaf', new THREE.InstancedBufferAttribute(new Float32Array(s.room), 1));
}

/** How many at the beginning of a cell are no smaller than a size. */
function longEnough(sizes: Float32Array, cell: Cell, least: number): number {
  let low = cell.from;
  let high = cell.to;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sizes[middle]! >= least) low = middle + 1;
    else high = middle;
  }
  return low - cell.from;
}

function sortInstances(mesh: THREE.InstancedMesh): Sorted {
  const n = mesh.count;
  const geometry = mesh.geometry as THREE.BufferGeometry;
  geometry.computeBoundingBox();
  const box = geometry.boundingBox!;
  const middle = box.getCenter(new THREE.Vector3());
  const extent = box.getSize(new THREE.Vector3());
  const from = mesh.instanceMatrix.array as Float32Array;
  const sizes = new Float32Array(n);
  const at = new Float32Array(n * 3);
  for (let i = 0; i < n; ++i) {
    const m = i * 16;
    const side = (k: number) => Math.hypot(from[m + k]!, from[m + k + 1]!, from[m + k + 2]!);
    sizes[i] = Math.max(side(0) * extent.x, side(4) * extent.y, side(8) * extent.z);
    for (let k = 0; k < 3; ++k) {
      at[i * 3 + k] = from[m + k]! * middle.x + from[m + 4 + k]! * middle.y + from[m + 8 + k]! * middle.z + from[m + 12 + k]!;
    }
  }
  const cellOf = cellsOver(at, n);
  // One number says cell, size from large to small, and index; 53 bits hold it.
  const keys = new Float64Array(n);
  for (let i = 0; i < n; ++i) {
    const rank = 65535 - Math.min(65535, Math.round(sizes[i]! * 64));
    keys[i] = (cellOf(i) * 65536 + rank) * 4194304 + i;
  }
  keys.sort();
  const tint = (geometry.getAttribute('tint') as THREE.InstancedBufferAttribute).array as Uint8Array;
  const leaf = (geometry.getAttribute('leaf') as THREE.InstancedBufferAttribute).array as Float32Array;
  // The draw list itself is put in order, so that it stays one.
  const ordered = { matrix: new Float32Array(n * 16), tint: new Uint8Array(n * 4), leaf: new Float32Array(n) };
  const out: Sorted = {
    mesh,
    triangles: (geometry.index?.count ?? 0) / 3,
    cells: [],
    sizes: new Float32Array(n),
    matrix: from,
    tint,
    leaf,
    taken: new Uint32Array(0),
    room: 0,
  };
  let cell = -1;
  const bounds = new THREE.Box3();
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
    largest = Math.max(largest, sizes[i]!);
    out.sizes[k] = sizes[i]!;
    ordered.matrix.set(from.subarray(i * 16, i * 16 + 16), k * 16);
    ordered.tint.set(tint.subarray(i * 4, i * 4 + 4), k * 4);
    ordered.leaf[k] = leaf[i]!;
  }
  close(n);
  out.taken = new Uint32Array(out.cells.length);
  from.set(ordered.matrix);
  tint.set(ordered.tint);
  leaf.set(ordered.leaf);
  makeRoom(out, 1);
  mesh.count = 0;
  return out;
}

function cellsOver(at: Float32Array, n: number): (i: number) => number {
  if (n < FEW) return () => 0;
  let [x0, x1, z0, z1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let i = 0; i < n; ++i) {
    x0 = Math.min(x0, at[i * 3]!);
    x1 = Math.max(x1, at[i * 3]!);
    z0 = Math.min(z0, at[i * 3 + 2]!);
    z1 = Math.max(z1, at[i * 3 + 2]!);
  }
  const place = (v: number, a: number, b: number) => Math.min(SIDE - 1, Math.floor(((v - a) / Math.max(1e-6, b - a)) * SIDE));
  return (i) => place(at[i * 3]!, x0, x1) * SIDE + place(at[i * 3 + 2]!, z0, z1);
}
