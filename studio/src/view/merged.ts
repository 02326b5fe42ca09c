// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Of a mesh that holds the triangles of many leaves, those of the leaves that are to be seen: their
// corners are copied together from runs of leaves. The vertices stay where they are.

import * as THREE from 'three';
import type { Part } from './detail';
import { sortIntoRuns, worthMore, worthOf, type Least, type Runs, type Things } from './runs';

export class Merged implements Part {
  readonly transparent: boolean;
  private readonly runs: Runs;
  /** Corners up to each leaf, in the order of the runs. */
  private readonly corners: Uint32Array;
  private readonly all: Uint32Array;
  private readonly taken: Uint32Array;
  /** How many of each cell are in the picture already. */
  private readonly done: Uint32Array;

  constructor(private readonly mesh: THREE.Mesh) {
    const { geometry } = mesh;
    this.transparent = (mesh.material as THREE.Material).transparent;
    const from = geometry.index!.array as Uint32Array;
    const { starts, things } = leavesOf(geometry, from);
    this.runs = sortIntoRuns(things);
    const n = starts.length - 1;
    this.corners = new Uint32Array(n + 1);
    this.all = new Uint32Array(from.length);
    for (let k = 0; k < n; ++k) {
      const i = this.runs.order[k]!;
      const part = from.subarray(starts[i]!, starts[i + 1]!);
      this.all.set(part, this.corners[k]!);
      this.corners[k + 1] = this.corners[k]! + part.length;
    }
    this.taken = new Uint32Array(this.runs.cells.length);
    this.done = this.taken.slice();
    geometry.setIndex(
      new THREE.BufferAttribute(new Uint32Array(from.length), 1).setUsage(
        THREE.DynamicDrawUsage,
      ) as THREE.BufferAttribute,
    );
    geometry.setDrawRange(0, 0);
  }

  take(least: Least): number {
    let corners = 0;
    this.runs.cells.forEach((cell, i) => {
      this.taken[i] = worthMore(this.runs.worth, cell, least(cell));
      corners += this.corners[cell.from + this.taken[i]!]! - this.corners[cell.from]!;
    });
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

/** The leaves of a mesh, and where the corners of each begin. */
function leavesOf(
  geometry: THREE.BufferGeometry,
  corners: Uint32Array,
): { starts: number[]; things: Things } {
  const leaf = geometry.getAttribute('leaf').array;
  const position = geometry.getAttribute('position').array;
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
