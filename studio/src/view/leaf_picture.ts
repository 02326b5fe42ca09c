// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// LeafPicture: pictures of numbers instead of colours. They tell which leaf is seen at a pixel and
// how far away it is, for outlines, for picking and for walking.

import * as THREE from 'three';
import type { Batched } from './batches';
import { depthMaterial } from './shading';

/** A number of 24 bits as the shaders write it, from 0 to 1. */
function fraction(bytes: Uint8Array): number {
  return ((bytes[0]! * 256 + bytes[1]!) * 256 + bytes[2]!) / 16777216;
}

/** Acts while some objects of a scene are hidden. */
export function without(hidden: THREE.Object3D[], act: () => void): void {
  const seen = hidden.map((o) => o.visible);
  for (const o of hidden) o.visible = false;
  act();
  hidden.forEach((o, i) => (o.visible = seen[i]!));
}

export class LeafPicture {
  /** The leaves that are seen, as large as the canvas, and their depths. */
  readonly target = new THREE.WebGLRenderTarget(1, 1, {
    minFilter: THREE.NearestFilter,
    magFilter: THREE.NearestFilter,
    depthTexture: new THREE.DepthTexture(1, 1, THREE.UnsignedIntType),
  });
  /** What the scene shows of the model. */
  batches: Batched[] = [];

  private readonly onePixel = new THREE.WebGLRenderTarget(1, 1);
  private readonly depth = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), depthMaterial());
  private readonly bytes = new Uint8Array(4);
  private stale = true;

  /** `hidden`: what the scene has beside the model. */
  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly scene: THREE.Scene,
    private readonly flat: THREE.Camera,
    private readonly hidden: THREE.Object3D[],
  ) {
    this.depth.frustumCulled = false;
  }

  /** The picture no longer shows what the camera sees. */
  forget(): void {
    this.stale = true;
  }

  setSize(width: number, height: number): void {
    this.target.setSize(width, height);
    this.stale = true;
  }

  /** Draws the picture where it is stale. */
  update(camera: THREE.Camera): void {
    if (this.stale) this.draw(camera);
  }

  /** `over`: over what is there. */
  draw(camera: THREE.Camera, over = false): void {
    this.render(this.target, camera, (b) => b.leaf, over);
    this.stale = false;
  }

  /**
   * The leaf at a place of the canvas, both in CSS pixels; -1 for none. `drawn`: as the picture
   * shows it, where it is not stale; otherwise that one pixel is drawn.
   */
  leafAt(
    at: THREE.Vector2Like,
    canvas: { width: number; height: number },
    camera: THREE.PerspectiveCamera,
    drawn: boolean,
  ): number {
    if (drawn && !this.stale) {
      const pixel = (v: number, of: number, pixels: number) =>
        Math.min(pixels - 1, Math.max(0, Math.floor((v / of) * pixels)));
      const { width, height } = this.target;
      const x = pixel(at.x, canvas.width, width);
      const y = pixel(canvas.height - at.y, canvas.height, height);
      this.renderer.readRenderTargetPixels(this.target, x, y, 1, 1, this.bytes);
    } else {
      camera.setViewOffset(canvas.width, canvas.height, at.x, at.y, 1, 1);
      this.render(this.onePixel, camera, (b) => b.leaf);
      camera.clearViewOffset();
      this.readPixel();
    }
    const [low, middle, high] = this.bytes;
    return low! + middle! * 256 + high! * 65536 - 1;
  }

  /** The depth at a place of the canvas, its left lower corner at 0, 0 and the other at 1, 1. */
  depthAt(x: number, y: number, camera: THREE.Camera): number {
    this.update(camera);
    const { uniforms } = this.depth.material;
    uniforms.depths!.value = this.target.depthTexture;
    (uniforms.place!.value as THREE.Vector2).set(x, y);
    this.renderer.setRenderTarget(this.onePixel);
    this.renderer.render(this.depth, this.flat);
    this.renderer.setRenderTarget(null);
    this.readPixel();
    return fraction(this.bytes);
  }

  /**
   * The height of the first surface below a point, down to `floor`; null where there is none.
   * `heights`: makes the material of a batch that writes heights above a base within a range.
   */
  heightBelow(
    at: THREE.Vector3,
    floor: number,
    heights: (base: number, range: number) => (b: Batched) => THREE.Material,
  ): number | null {
    const reach = Math.max(1, at.y - floor) + 1;
    const down = new THREE.OrthographicCamera(-0.05, 0.05, 0.05, -0.05, 0, reach);
    down.position.copy(at);
    down.up.set(0, 0, -1);
    down.lookAt(at.x, at.y - 1, at.z);
    this.render(this.onePixel, down, heights(floor - 1, reach + 1));
    this.readPixel();
    return this.bytes[3] === 0 ? null : floor - 1 + fraction(this.bytes) * (reach + 1);
  }

  dispose(): void {
    this.target.dispose();
    this.onePixel.dispose();
  }

  private readPixel(): void {
    this.renderer.readRenderTargetPixels(this.onePixel, 0, 0, 1, 1, this.bytes);
  }

  /** Draws the model alone, with materials that write numbers. */
  private render(
    target: THREE.WebGLRenderTarget,
    camera: THREE.Camera,
    material: (b: Batched) => THREE.Material,
    over = false,
  ): void {
    const background = this.scene.background;
    this.scene.background = null;
    for (const b of this.batches) b.mesh.material = material(b);
    without(this.hidden, () => {
      this.renderer.setRenderTarget(target);
      this.renderer.setClearColor(0, 0);
      if (!over) this.renderer.clear();
      this.renderer.render(this.scene, camera);
      this.renderer.setRenderTarget(null);
    });
    for (const b of this.batches) b.mesh.material = b.plain;
    this.scene.background = background;
  }
}
