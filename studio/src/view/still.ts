// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Still: the average of many passes over a picture in which nothing moves. Passes hold linear light
// in half floats, because the sun of a single pass is several times as bright as white; only the
// average is clipped, as the first picture is.

import * as THREE from 'three';
import { spread, type Lights } from './sun';

export class Still {
  readonly sum = new THREE.WebGLRenderTarget(1, 1, { type: THREE.HalfFloatType });
  private readonly one = new THREE.WebGLRenderTarget(1, 1, { type: THREE.HalfFloatType });

  /** `copy`: draws its map over the whole of a target. */
  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly copy: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>,
    private readonly flat: THREE.Camera,
  ) {}

  /** Adds the i-th pass, from 1, with pixels moved by a part of their size. */
  add(
    i: number,
    size: THREE.Vector2,
    camera: THREE.PerspectiveCamera,
    lights: Lights,
    render: (target: THREE.WebGLRenderTarget) => void,
  ): void {
    for (const target of [this.one, this.sum]) target.setSize(size.x, size.y);
    lights.pass(i);
    const [x, y] = [spread(i, 2) - 0.5, spread(i, 3) - 0.5];
    camera.setViewOffset(size.x, size.y, x, y, size.x, size.y);
    render(this.one);
    camera.clearViewOffset();
    this.renderer.setRenderTarget(this.sum);
    if (i === 1) this.renderer.clear();
    this.copy.material.map = this.one.texture;
    this.copy.material.opacity = 1 / i;
    this.renderer.render(this.copy, this.flat);
  }

  dispose(): void {
    this.one.dispose();
    this.sum.dispose();
  }
}
