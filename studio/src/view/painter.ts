// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Painter: makes the pictures of a scene. The first is as fine as its share of pixels says. Steps
// then refine it: further passes with a moved sun and moved pixels are averaged into soft shadows,
// light from the whole sky and smooth edges. A model too large for that is drawn once more, a
// helping at a time, with shadows softened from the one map; its edges and how its corners are
// darker come from the leaves and depths of that picture.

import * as THREE from 'three';
import { Ambient } from './ambient';
import { MOVING, POSED, type Detail } from './detail';
import { LeafPicture, without } from './leaf_picture';
import type { Marking } from './marking';
import { Still } from './still';
import type { Surroundings } from './surroundings';

/** What is painted. */
export interface Stage {
  readonly canvas: HTMLCanvasElement;
  readonly scene: THREE.Scene;
  readonly camera: THREE.PerspectiveCamera;
  readonly surroundings: Surroundings;
  readonly marking: Marking;
  /** Pictures are taken as soon as they are drawn, so that all are in full. */
  readonly posed: boolean;
  /** The processor draws, as on a machine without a graphics card. */
  readonly software: boolean;
}

/** Passes that a still picture is made of. */
const PASSES = 40;
const SHOWN_AFTER = 10;
/** Of a large model: its picture in full, then edges, then darker corners. */
const PLACE_PASSES = 2;
/** How dark thin edges between leaves are in a refined picture, and in one of a large place. */
const FINE_EDGES = 0.22;
const PLACE_EDGES = 0.16;

export class Painter {
  readonly leaves: LeafPicture;
  /** Of a large model, which parts of it are drawn; null for others. */
  detail: Detail | null = null;
  /** What the latest picture cost. */
  cost = { calls: 0, triangles: 0 };

  private readonly flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly copy: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>;
  /** The picture before it is refined. */
  private readonly picture: THREE.WebGLRenderTarget;
  private readonly still: Still;
  private readonly ambient: Ambient;
  private readonly onePixel = new THREE.WebGLRenderTarget(1, 1);
  /** What the canvas shows below the outlines. */
  private shown: THREE.WebGLRenderTarget;
  /** The picture that is shown is less than the canvas could show. */
  private coarse = false;
  private pass = 0;
  private passes = PASSES;
  /** How dark edges between leaves are in what is shown, and whether corners are darker in it. */
  private edges = 0;
  private cornered = false;
  /** What is left of a picture that is being made. */
  private helpings: Generator<boolean, void> | null = null;
  private share = 0;
  /** Pixels of the canvas. */
  private readonly size = new THREE.Vector2();

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly stage: Stage,
  ) {
    const cheap = stage.software && !stage.posed;
    renderer.shadowMap.enabled = true;
    // A processor pays for each look at the shadows; refining makes them soft all the same.
    renderer.shadowMap.type = cheap ? THREE.BasicShadowMap : THREE.PCFShadowMap;
    renderer.shadowMap.autoUpdate = false;
    renderer.autoClear = false;
    renderer.info.autoReset = false;
    this.picture = new THREE.WebGLRenderTarget(1, 1, {
      colorSpace: THREE.SRGBColorSpace,
      samples: cheap ? 0 : 4,
    });
    this.shown = this.picture;
    this.copy = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2),
      new THREE.MeshBasicMaterial({
        transparent: true,
        depthTest: false,
        depthWrite: false,
        toneMapped: false,
      }),
    );
    this.copy.frustumCulled = false;
    this.ambient = new Ambient(renderer);
    this.still = new Still(renderer, this.copy, this.flat);
    const beside = [...stage.surroundings.backdrop, ...stage.marking.boxes];
    this.leaves = new LeafPicture(renderer, stage.scene, this.flat, beside);
  }

  /** The canvas has another size. */
  resized(): void {
    this.share = 0;
    this.leaves.forget();
  }

  /** A new picture with this share of the pixels each way, which is then to be refined. */
  begin(share: number): void {
    this.pass = 0;
    this.passes = this.detail ? PLACE_PASSES : PASSES;
    this.coarse = share < 1 || !!this.detail;
    if (this.helpings) this.leaves.forget();
    this.helpings = null;
    this.stage.surroundings.lights.soften(false);
    this.draw(share);
  }

  /** The picture can become better. */
  get unfinished(): boolean {
    return this.pass < this.passes;
  }

  /** One step towards the best picture. */
  refine(): void {
    if (this.coarse && this.detail) this.addHelping();
    else if (this.coarse) this.settle();
    else if (this.detail) this.finishPlace();
    else this.addPass();
  }

  /** Where steps are slow, fewer have to do. */
  hurry(): void {
    this.passes = Math.min(this.passes, SHOWN_AFTER);
  }

  /** Puts the latest picture on the canvas, with outlines. */
  present(): void {
    this.renderer.setRenderTarget(null);
    this.copy.material.map = this.shown.texture;
    this.copy.material.opacity = 1;
    this.renderer.clear();
    this.renderer.render(this.copy, this.flat);
    if (this.cornered) this.ambient.draw();
    const { marking, camera } = this.stage;
    marking.draw(this.renderer, this.leaves, camera, this.flat, this.edges);
  }

  dispose(): void {
    this.ambient.dispose();
    this.still.dispose();
    this.leaves.dispose();
    this.picture.dispose();
    this.onePixel.dispose();
  }

  /**
   * The canvas has this share of the pixels each way that the screen has for it; the page enlarges
   * it.
   */
  private setShare(share: number): void {
    if (share === this.share) return;
    this.share = share;
    const { clientWidth, clientHeight } = this.stage.canvas;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio) * share);
    this.renderer.setSize(clientWidth, clientHeight, false);
    const { x, y } = this.renderer.getDrawingBufferSize(this.size);
    this.picture.setSize(x, y);
    this.leaves.setSize(x, y);
    this.stage.marking.setSize(x, y);
  }

  /** A picture with the light of the sun as it is set. */
  private draw(share: number): void {
    const { camera, canvas, posed } = this.stage;
    this.setShare(share);
    this.stage.surroundings.lights.first(share < 1);
    this.drawShadows();
    this.detail?.select(camera, canvas.clientHeight, posed ? POSED : MOVING);
    this.renderer.info.reset();
    this.render(this.picture);
    const { calls, triangles } = this.renderer.info.render;
    this.cost = { calls, triangles };
    this.shown = this.picture;
    this.edges = 0;
    this.cornered = false;
    this.present();
  }

  private render(target: THREE.WebGLRenderTarget, over = false): void {
    // Each sun knows whether its shadows are stale.
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.setRenderTarget(target);
    const { scene, camera } = this.stage;
    const { background } = scene;
    // A background clears.
    if (over) scene.background = null;
    else this.renderer.clear();
    this.renderer.render(scene, camera);
    scene.background = background;
    this.renderer.setRenderTarget(null);
    this.renderer.shadowMap.needsUpdate = false;
  }

  /**
   * Of a large model, the shadows of all that is large enough for them, where they are to be drawn
   * anew.
   */
  private drawShadows(): void {
    const { lights } = this.stage.surroundings;
    if (!this.detail || !lights.stale) return;
    this.detail.selectForShadow(lights.texel);
    // Drawing on one pixel draws the shadow map as well.
    this.render(this.onePixel);
  }

  /** The picture in full, as it was moved. */
  private settle(): void {
    this.coarse = false;
    this.draw(1);
    this.leaves.forget();
  }

  /** Of a large model one more helping, over those that are there. */
  private addHelping(): void {
    const { camera, canvas, surroundings, marking } = this.stage;
    const first = !this.helpings;
    if (!this.helpings) {
      this.setShare(1);
      surroundings.lights.first(false);
      surroundings.lights.soften(true);
      this.drawShadows();
      this.helpings = this.detail!.helpings(camera, canvas.clientHeight);
    }
    const last = this.helpings.next().value ?? true;
    const marks = last ? [] : marking.boxes;
    without(first ? marks : [...marks, ...surroundings.backdrop], () =>
      this.render(this.picture, !first),
    );
    this.leaves.draw(camera, !first);
    this.shown = this.picture;
    if (last) {
      this.helpings = null;
      this.coarse = false;
    }
    this.present();
  }

  /**
   * What a large model gets instead of passes; each of these is short, so that nobody waits for it.
   */
  private finishPlace(): void {
    this.pass += 1;
    if (this.pass === 1) this.edges = PLACE_EDGES;
    else {
      this.ambient.read(this.leaves.target.depthTexture!, this.stage.camera, this.size);
      this.cornered = true;
    }
    this.present();
  }

  private addPass(): void {
    const i = this.pass + 1;
    const { camera, surroundings } = this.stage;
    this.still.add(i, this.size, camera, surroundings.lights, (target) => this.render(target));
    this.pass = i;
    if (i % SHOWN_AFTER !== 0) return;
    this.shown = this.still.sum;
    this.edges = FINE_EDGES;
    this.present();
  }
}
