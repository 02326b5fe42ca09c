// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Framing: where the camera stands so that a model just fits, and whether it still does.

import * as THREE from 'three';
import type { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { DrawList } from '../lib/protocol';

export interface Bounds {
  min: [number, number, number];
  max: [number, number, number];
}

/** Where a camera stands and what it turns about. */
export interface Standpoint {
  position: [number, number, number];
  target: [number, number, number];
  /** Of a model that is still to come. */
  ahead?: boolean;
}

/** Metres from the middle to a corner of what counts as a place, not a building. */
export const WIDE = 150;
const POINTS_A_BATCH = 400;
/** Air around a building, and around a place. */
const AIR = 1.1;
const PLACE_AIR = 1.08;
const FROM = new THREE.Vector3(0.52, 0.5, 0.82).normalize();
/**
 * A model that has become so many times larger or smaller is framed anew; where somebody has moved
 * the camera, that is more.
 */
const OUTGROWN = 1.08;
const OUTGROWN_AFTER_MOVES = 3;

const boxOf = (b: Bounds) =>
  new THREE.Box3(new THREE.Vector3(...b.min), new THREE.Vector3(...b.max));

export class Framing {
  /** Some of all points of a place. */
  private points: THREE.Vector3[] = [];
  private framed: Bounds | null = null;
  private own = false;
  private empty = true;
  /** The next model is seen from where the camera stands. */
  private ahead = false;
  /** Somebody has moved the camera since the page did. */
  private moved = false;

  constructor(
    private readonly camera: THREE.PerspectiveCamera,
    private readonly controls: OrbitControls,
  ) {
    controls.addEventListener('change', () => {
      if (!this.own) this.moved = true;
    });
  }

  /** Hears of another model. */
  know(list: DrawList, bounds: Bounds): void {
    this.empty = list.leaves === 0;
    if (this.ahead && !this.empty) {
      this.framed = bounds;
      this.ahead = false;
    }
    this.points =
      boxOf(bounds).getSize(new THREE.Vector3()).length() / 2 > WIDE ? somePoints(list) : [];
  }

  standpoint(): Standpoint {
    return { position: this.camera.position.toArray(), target: this.controls.target.toArray() };
  }

  /** Goes where somebody stood before; what is shown counts as framed. */
  lookFrom(from: Standpoint, bounds: Bounds): void {
    this.camera.position.set(...from.position);
    this.controls.target.set(...from.target);
    this.controls.update();
    this.framed = bounds;
    this.moved = true;
    this.ahead = from.ahead ?? false;
  }

  /** Whether no model has been framed yet. */
  get fresh(): boolean {
    return !this.framed;
  }

  /** `reset`: seen as at first, not as it is seen now. */
  model(bounds: Bounds, reset: boolean): void {
    this.box(bounds, reset);
    if (this.points.length && reset) this.fill(bounds);
    this.framed = bounds;
    this.moved = false;
  }

  /** Whether a model is another size than the one that was framed, or elsewhere. */
  outgrown(bounds: Bounds): boolean {
    if (!this.framed || this.empty) return false;
    const [now, then] = [bounds, this.framed].map((b) =>
      boxOf(b).getBoundingSphere(new THREE.Sphere()),
    );
    const room = this.moved ? OUTGROWN_AFTER_MOVES : OUTGROWN;
    const ratio = Math.max(now!.radius, 1) / Math.max(then!.radius, 1);
    return (
      ratio > room ||
      ratio < 1 / room ||
      now!.center.distanceTo(then!.center) > then!.radius * (room - 0.8)
    );
  }

  box(bounds: Bounds, reset: boolean): void {
    const box = boxOf(bounds);
    const centre = box.getCenter(new THREE.Vector3());
    const radius = Math.max(0.5, box.getSize(new THREE.Vector3()).length() / 2);
    const direction = reset
      ? FROM
      : this.camera.position.clone().sub(this.controls.target).normalize();
    // A wide, flat place fills the picture when all corners of its box just fit; a house has air
    // around it.
    const upward = Math.tan((this.camera.fov * Math.PI) / 360);
    const right = new THREE.Vector3(0, 1, 0).cross(direction).normalize();
    const up = direction.clone().cross(right);
    const fit = Math.atan(upward * Math.min(1, this.camera.aspect));
    let far = radius > WIDE ? 0 : (radius * AIR) / Math.sin(fit);
    for (let i = 0; i < 8 && radius > WIDE; ++i) {
      const corner = new THREE.Vector3(
        ...[0, 1, 2].map((k) => (i & (1 << k) ? bounds.max : bounds.min)[k]!),
      ).sub(centre);
      const wide = Math.abs(corner.dot(right)) / (upward * this.camera.aspect);
      far = Math.max(
        far,
        corner.dot(direction) + Math.max(wide, Math.abs(corner.dot(up)) / upward),
      );
    }
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(direction, radius > WIDE ? far * AIR : far);
    this.update();
  }

  /** Moves the camera so that the points of a place just fill the picture. */
  private fill(bounds: Bounds): void {
    const { camera, controls } = this;
    const axis = new THREE.Vector3();
    const point = new THREE.Vector3();
    for (let round = 0; round < 4; ++round) {
      camera.updateMatrixWorld();
      const seen = new THREE.Box2();
      for (const p of this.points) {
        point.copy(p).project(camera);
        seen.expandByPoint(new THREE.Vector2(point.x, point.y));
      }
      const middle = seen.getCenter(new THREE.Vector2());
      const size = seen.getSize(new THREE.Vector2());
      const half =
        camera.position.distanceTo(controls.target) * Math.tan((camera.fov * Math.PI) / 360);
      const aside = axis
        .setFromMatrixColumn(camera.matrixWorld, 0)
        .multiplyScalar(middle.x * half * camera.aspect)
        .clone();
      aside.addScaledVector(axis.setFromMatrixColumn(camera.matrixWorld, 1), middle.y * half);
      const towards = camera.position.clone().sub(controls.target);
      controls.target.add(aside);
      camera.position
        .copy(controls.target)
        .addScaledVector(towards, (Math.max(size.x, size.y) / 2) * PLACE_AIR);
    }
    // What it turns about is on the ground.
    const ahead = controls.target.clone().sub(camera.position).normalize();
    const fall = camera.position.y - Math.max(0, bounds.min[1]);
    if (ahead.y < 0) controls.target.copy(camera.position).addScaledVector(ahead, fall / -ahead.y);
    this.update();
  }

  private update(): void {
    this.own = true;
    this.controls.update();
    this.own = false;
  }
}

function somePoints(list: DrawList): THREE.Vector3[] {
  const out: THREE.Vector3[] = [];
  for (const batch of list.batches) {
    const [from, each, first] = batch.matrix ? [batch.matrix, 16, 12] : [batch.position, 3, 0];
    const step = Math.max(1, Math.floor(from.length / each / POINTS_A_BATCH)) * each;
    for (let i = first; i < from.length; i += step)
      out.push(new THREE.Vector3().fromArray(from, i));
  }
  return out;
}
