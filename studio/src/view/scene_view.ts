// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SceneView: a draw list on a canvas. While something changes its pictures are as fine as they can
// be in time (Pace). Once nothing does, it draws one in full and then refines it: further passes
// with a moved sun and moved pixels are averaged into soft shadows, light from the whole sky and
// smooth edges. A model too large for that is drawn once more, with shadows softened from the one
// map; its edges and how its corners are darker come from the leaves and depths of that picture.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { PictureView } from '../lib/client';
import type { DrawList } from '../lib/protocol';
import { Ambient } from './ambient';
import { BatchMaker, type Batched } from './batches';
import { emptyGroup, ghostBox, manyScopes, scopeLines, type ScopeBox } from './boxes';
import { Detail, MOVING, POSED } from './detail';
import { Framing, WIDE, type Bounds, type Standpoint } from './framing';
import { Ground } from './ground';
import { LeafPicture, without } from './leaf_picture';
import { Materials } from './materials';
import { Navigation, type Mode } from './navigation';
import { isSoftware, Pace } from './pace';
import { outlineMaterial, skyMaterial, type Marks } from './shading';
import { Still } from './still';
import { Lights } from './sun';

export interface ViewColors {
  ground: string;
  line: string;
  accent: string;
  text: string;
  ghost: string;
  /** The sky over the place, where it is shown. */
  zenith: string;
  horizon: string;
}

/** What a picture costs. */
export interface Cost {
  calls: number;
  triangles: number;
  /** Of all buffers on the graphics card. */
  bytes: number;
}

export interface Range {
  from: number;
  to: number;
}

const NOTHING: Range = { from: 0, to: 0 };
/** Passes that a still picture is made of. */
const PASSES = 40;
const SHOWN_AFTER = 10;
/** How dark thin edges between leaves are in a refined picture, and in one of a large place. */
const FINE_EDGES = 0.22;
const PLACE_EDGES = 0.16;
/**
 * So long nothing changes before a picture is drawn in full: longer than it takes from key to key.
 */
const QUIET_MS = 400;
const SLOW_PASS_MS = 400;
/** Of a large model: its picture in full, then edges, then darker corners. */
const PLACE_PASSES = 2;

export class SceneView {
  readonly renderer: THREE.WebGLRenderer;
  readonly camera = new THREE.PerspectiveCamera(28, 1, 0.1, 5000);
  readonly controls: OrbitControls;
  /** Called after each first picture of a change, not after refinements. */
  drawn: (() => void) | null = null;
  /** Called when a picture is as good as it gets. */
  refined: (() => void) | null = null;
  /** Called when the camera has moved. */
  moved: (() => void) | null = null;
  /**
   * Called with the seconds that a picture took of a camera that moves, from the drawing of it to
   * its end.
   */
  timed: ((seconds: number) => void) | null = null;
  readonly navigation: Navigation;

  private readonly scene = new THREE.Scene();
  private readonly model = new THREE.Group();
  private readonly lights: Lights;
  private readonly pace: Pace;
  /** The processor draws, as on a machine without a graphics card. */
  readonly software: boolean;
  private readonly ground: Ground;
  private readonly marks: Marks = {
    selected: { value: new THREE.Vector2() },
    accent: { value: new THREE.Color() },
    guideStep: { value: 1e9 },
  };
  private readonly materials = new Materials(this.marks, () => {
    this.leaves.forget();
    this.redraw();
  });
  readonly pictures = this.materials.pictures;
  private readonly overlay = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), outlineMaterial());
  private readonly copy: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>;
  private readonly flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly batchMaker = new BatchMaker(this.marks);
  private readonly dome = new THREE.Mesh(new THREE.SphereGeometry(1, 32, 16), skyMaterial());
  private readonly scopes = new THREE.Group();
  private readonly manyScopes = new THREE.Group();
  private readonly ghosts = new THREE.Group();
  private readonly ghostColor = new THREE.Color();
  private readonly groundColor = new THREE.Color();
  private readonly horizonColor = new THREE.Color();
  private readonly leaves: LeafPicture;
  /** The picture before it is refined. */
  private readonly picture: THREE.WebGLRenderTarget;
  private readonly still: Still;
  /** What the canvas shows below the outlines. */
  private shown: THREE.WebGLRenderTarget;
  private readonly onePixel = new THREE.WebGLRenderTarget(1, 1);
  private batches: Batched[] = [];
  private bounds: Bounds = { min: [0, 0, 0], max: [20, 0, 20] };
  private selected = NOTHING;
  private hovered = NOTHING;
  private dirty = false;
  /** The next picture is drawn in full at once. */
  private fine = false;
  /** The picture that is shown is less than the canvas could show. */
  private coarse = false;
  /** The camera has moved since the latest picture. */
  private panned = false;
  private pass = 0;
  private passes = PASSES;
  /** How dark edges between leaves are in what is shown, and whether corners are darker in it. */
  private edges = 0;
  private cornered = false;
  /** What is left of a picture that is being made. */
  private helpings: Generator<boolean, void> | null = null;
  private readonly ambient: Ambient;
  private drawnWith = { calls: 0, triangles: 0 };
  private quiet = 0;
  private frame = 0;
  private readonly framing: Framing;
  /** Counts models, so that one that was sorted too late is not shown. */
  private models = 0;
  private detail: Detail | null = null;
  private sky_ = false;
  private wireframe = false;
  private share = 0;
  /** Pixels of the canvas. */
  private readonly size = new THREE.Vector2();
  private waiting: WebGLSync | null = null;

  /** `posed`: for pictures that are taken as soon as they are drawn, so that all are in full. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly posed = false,
  ) {
    this.renderer = new THREE.WebGLRenderer({
      canvas,
      antialias: false,
      preserveDrawingBuffer: true,
    });
    const software = isSoftware(this.renderer.getContext());
    this.software = software;
    this.pace = new Pace(software);
    this.lights = new Lights(software && !posed);
    this.ground = new Ground(this.lights.scatter);
    this.picture = new THREE.WebGLRenderTarget(1, 1, {
      colorSpace: THREE.SRGBColorSpace,
      samples: software && !posed ? 0 : 4,
    });
    this.shown = this.picture;
    this.renderer.shadowMap.enabled = true;
    // A processor pays for each look at the shadows; refining makes them soft all the same.
    this.renderer.shadowMap.type = software && !posed ? THREE.BasicShadowMap : THREE.PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    this.ambient = new Ambient(this.renderer);
    this.copy = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2),
      new THREE.MeshBasicMaterial({
        transparent: true,
        depthTest: false,
        depthWrite: false,
        toneMapped: false,
      }),
    );
    this.still = new Still(this.renderer, this.copy, this.flat);
    for (const screen of [this.overlay, this.copy]) screen.frustumCulled = false;
    this.dome.frustumCulled = false;
    this.dome.renderOrder = -10;
    this.dome.visible = false;
    this.scene.add(this.dome, this.model, this.lights.group, this.ground.group);
    this.scene.add(this.scopes, this.manyScopes, this.ghosts);
    const beside = [this.dome, this.ground.group, this.scopes, this.manyScopes, this.ghosts];
    this.leaves = new LeafPicture(this.renderer, this.scene, this.flat, beside);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.addEventListener('change', () => {
      this.camera.updateMatrixWorld();
      this.cameraMoved();
    });
    this.framing = new Framing(this.camera, this.controls);
    this.navigation = new Navigation(this);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
    this.fitGround();
    this.framing.box(this.bounds, true);
  }

  cameraMoved(): void {
    this.leaves.forget();
    this.panned = true;
    this.moved?.();
    this.redraw();
  }

  setMode(mode: Mode): void {
    this.navigation.setMode(mode);
    this.fitGround();
    this.redraw();
  }

  /** Where a point of the world is on the canvas, in CSS pixels; null behind the camera. */
  project(at: [number, number, number]): { x: number; y: number } | null {
    const p = new THREE.Vector3(...at).project(this.camera);
    if (p.z > 1) return null;
    return {
      x: ((p.x + 1) / 2) * this.canvas.clientWidth,
      y: ((1 - p.y) / 2) * this.canvas.clientHeight,
    };
  }

  /** Where a place of the canvas is looked at from the camera, as a vector of length one. */
  rayAt(x: number, y: number): [number, number, number] {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    return new THREE.Vector3((x / w) * 2 - 1, 1 - (y / h) * 2, 0.5)
      .unproject(this.camera)
      .sub(this.camera.position)
      .normalize()
      .toArray();
  }

  /** The first surface below a point. */
  heightBelow(at: THREE.Vector3): number {
    const height = this.leaves.heightBelow(at, this.ground.height, (base, range) =>
      this.batchMaker.heights(base, range),
    );
    return height ?? Math.min(0, this.bounds.min[1]);
  }

  setColors(colors: ViewColors): void {
    const ground = this.groundColor.set(colors.ground);
    this.horizonColor.set(colors.horizon);
    this.ghostColor.set(colors.ghost);
    this.dome.material.uniforms.horizon!.value = this.horizonColor;
    (this.dome.material.uniforms.zenith!.value as THREE.Color).set(colors.zenith);
    this.setSky(this.sky_);
    this.ground.setColors(ground, colors.line);
    this.marks.accent.value.set(colors.accent);
    const uniforms = this.overlay.material.uniforms;
    (uniforms.accent!.value as THREE.Color).set(colors.accent);
    (uniforms.text!.value as THREE.Color).set(colors.text);
    this.fitGround();
    this.redraw();
  }

  /** With the sky the ground fades into the horizon; without, into a ground without end. */
  setSky(on: boolean): void {
    this.sky_ = on;
    this.dome.visible = on;
    const far = on ? this.horizonColor : this.groundColor;
    this.scene.background = far;
    this.scene.fog = new THREE.Fog(far, 100, 1000);
    this.fitGround();
    this.redraw();
  }

  /**
   * Shows another model. `lives`: two numbers a leaf, from and up to which step of a derivation it
   * is there; without, all leaves are. False where a later one came first.
   */
  async setModel(
    list: DrawList,
    bounds: Bounds,
    lives: Float32Array | null = null,
  ): Promise<boolean> {
    const number = ++this.models;
    const materials = list.looks.map((look) => this.materials.of(look, !!lives));
    const batches = list.batches.map((batch) =>
      this.batchMaker.make(batch, materials[batch.look]!, lives),
    );
    // Sorting a large model takes a while; the one before stays in sight until then.
    const detail =
      lives || !Detail.worthIt(batches.map((b) => b.mesh))
        ? null
        : await Detail.of(
            batches.map((b) => b.mesh),
            () => number !== this.models,
          );
    if (number !== this.models) return false;
    this.detail = detail;
    for (const { mesh } of this.batches) {
      mesh.geometry.dispose();
      if (mesh instanceof THREE.InstancedMesh) mesh.dispose();
    }
    this.model.clear();
    this.batches = this.leaves.batches = batches;
    for (const { mesh } of this.batches) this.model.add(mesh);
    this.fitWires();
    this.bounds = bounds;
    this.framing.know(list, bounds);
    this.fitGround();
    this.fitSun();
    this.lights.forget();
    if (this.framing.fresh && list.leaves > 0) this.frameAll();
    this.leaves.forget();
    this.redraw();
    return true;
  }

  /** Files have changed: pictures are loaded again. */
  forgetPictures(): void {
    this.materials.clear();
  }

  get centre(): THREE.Vector3 {
    const { min, max } = this.bounds;
    return new THREE.Vector3((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2);
  }

  get radius(): number {
    const { min, max } = this.bounds;
    return Math.max(1, Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]) / 2);
  }

  private fitGround(): void {
    const r = this.radius;
    this.ground.fit(this.centre, r, this.bounds.min[1]);
    if (this.scene.fog instanceof THREE.Fog) {
      // Who stands in a place looks into the haze; who turns it does not have it between.
      const inside = this.sky_ && this.navigation && this.navigation.mode !== 'orbit';
      this.scene.fog.near = r * (inside ? 2.5 : this.sky_ ? 4 : 5);
      this.scene.fog.far = r * (this.sky_ ? 12 : 22);
    }
    const near = this.navigation?.mode === 'walk' ? 0.08 : 0.05;
    this.camera.near =
      this.navigation?.mode === 'orbit' || !this.navigation ? Math.max(near, r / 300) : near;
    this.camera.far = r * 60;
    this.camera.updateProjectionMatrix();
  }

  private fitSun(): void {
    this.lights.fit(this.centre, this.radius, this.radius > WIDE);
    (this.dome.material.uniforms.sun!.value as THREE.Vector3).copy(this.lights.direction());
  }

  setSun(elevation: number, azimuth: number): void {
    this.lights.turn(elevation, azimuth);
    (this.dome.material.uniforms.sun!.value as THREE.Vector3).copy(this.lights.direction());
    this.redraw();
  }

  setSelected(range: Range | null): void {
    const next = range ?? NOTHING;
    if (next.from === this.selected.from && next.to === this.selected.to) return;
    this.selected = next;
    this.marks.selected.value.set(next.from, next.to);
    // The picture of a large model stays, below the outline.
    if (this.detail && !this.dirty) this.present();
    else this.redraw(true);
  }

  setHovered(range: Range | null): void {
    const next = range ?? NOTHING;
    if (next.from === this.hovered.from && next.to === this.hovered.to) return;
    this.hovered = next;
    // The picture itself stays; one that is about to be drawn has the outline anyway.
    if (!this.dirty) this.present();
  }

  setWireframe(on: boolean): void {
    if (on === this.wireframe) return;
    this.wireframe = on;
    this.fitWires();
    this.redraw(true);
  }

  private fitWires(): void {
    for (const { plain } of this.batches)
      (plain as THREE.MeshLambertMaterial).wireframe = this.wireframe;
  }

  /** A box in the accent colour with its axes; null hides it. */
  setScope(box: ScopeBox | null): void {
    // Lines into a picture of a large model would have it made anew.
    if (this.detail) box = null;
    if (!box && !this.scopes.children.length) return;
    emptyGroup(this.scopes);
    if (box) this.scopes.add(...scopeLines(box, this.marks.accent.value));
    this.redraw(true);
  }

  /** The scopes of many shapes, thinly. */
  setScopes(boxes: ScopeBox[]): void {
    if (!boxes.length && !this.manyScopes.children.length) return;
    emptyGroup(this.manyScopes);
    if (boxes.length) this.manyScopes.add(manyScopes(boxes, this.marks.accent.value));
    this.redraw(true);
  }

  /** Shows a derivation as it is after a step, and what the step has replaced. */
  setStep(step: number, ghost: ScopeBox | null): void {
    if (step === this.marks.guideStep.value && !ghost && !this.ghosts.children.length) return;
    this.marks.guideStep.value = step;
    emptyGroup(this.ghosts);
    if (ghost) this.ghosts.add(...ghostBox(ghost, this.ghostColor));
    this.leaves.forget();
    this.lights.forget();
    this.redraw();
  }

  standpoint(): Standpoint {
    return this.framing.standpoint();
  }

  /** What a picture shows that is taken from here. */
  pictureView(): PictureView {
    const { position, target } = this.framing.standpoint();
    const half = Math.tan((this.camera.fov * Math.PI) / 360) * this.camera.aspect;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return { eye: position, target, angle: (Math.atan(half) * 360) / Math.PI, width, height };
  }

  /** Stands where somebody stood before, over the model that comes next. */
  lookFrom(from: Standpoint): void {
    this.framing.lookFrom(from, this.bounds);
    this.leaves.forget();
    this.redraw();
  }

  frameAll(reset = true): void {
    this.framing.model(this.bounds, reset);
    this.leaves.forget();
    this.redraw();
  }

  frameBox(bounds: Bounds, reset = false): void {
    this.framing.box(bounds, reset);
    this.leaves.forget();
    this.redraw();
  }

  /** The leaf under a point of the canvas in CSS pixels; -1 for none. */
  pick(x: number, y: number): number {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return this.leaves.leafAt({ x, y }, { width, height }, this.camera, !!this.detail);
  }

  /**
   * The leaf under a point of the canvas, and where it is there; the ground where there is none.
   * Null for the sky.
   */
  surfaceAt(x: number, y: number): { point: [number, number, number]; leaf: number } | null {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    const depth = this.leaves.depthAt(x / w, 1 - y / h, this.camera);
    const at = new THREE.Vector3((x / w) * 2 - 1, 1 - (y / h) * 2, depth * 2 - 1).unproject(
      this.camera,
    );
    if (depth < 0.99999) return { point: at.toArray(), leaf: this.pick(x, y) };
    const ray = new THREE.Ray(this.camera.position, at.sub(this.camera.position).normalize());
    const ground = ray.intersectPlane(
      new THREE.Plane(new THREE.Vector3(0, 1, 0), -Math.min(0, this.bounds.min[1])),
      new THREE.Vector3(),
    );
    return ground && ground.distanceTo(this.camera.position) < this.radius * 40
      ? { point: ground.toArray(), leaf: -1 }
      : null;
  }

  private resize(): void {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    if (!w || !h) return;
    this.share = 0;
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.leaves.forget();
    this.render();
    clearTimeout(this.quiet);
    this.quiet = window.setTimeout(() => this.refine(), QUIET_MS);
  }

  /**
   * Draws anew; `fine`: what changes does not move, so that the picture may take a little longer.
   */
  redraw(fine = false): void {
    this.fine = this.dirty ? this.fine && fine : fine;
    this.dirty = true;
    if (!this.frame) this.frame = requestAnimationFrame(() => this.tick());
  }

  private tick(): void {
    this.frame = 0;
    if (!this.dirty) return;
    const began = performance.now();
    const moving = !this.fine;
    this.render();
    this.drawn?.();
    clearTimeout(this.quiet);
    this.whenDrawn(() => {
      const seconds = (performance.now() - began) / 1000;
      if (moving) this.pace.took(seconds);
      if (this.panned) this.timed?.(seconds);
      this.panned = false;
      this.quiet = window.setTimeout(() => this.refine(), QUIET_MS);
    });
  }

  private render(): void {
    const share = this.fine || this.posed ? 1 : this.pace.share;
    this.dirty = this.fine = false;
    this.pass = 0;
    this.passes = this.detail ? PLACE_PASSES : PASSES;
    this.coarse = share < 1 || !!this.detail;
    if (this.helpings) this.leaves.forget();
    this.helpings = null;
    this.lights.soften(false);
    this.draw(share);
  }

  /**
   * The canvas has this share of the pixels each way that the screen has for it; the page enlarges
   * it.
   */
  private setShare(share: number): void {
    if (share === this.share) return;
    this.share = share;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio) * share);
    this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    const size = this.renderer.getDrawingBufferSize(this.size);
    this.picture.setSize(size.x, size.y);
    this.leaves.setSize(size.x, size.y);
    (this.overlay.material.uniforms.texel!.value as THREE.Vector2).set(1 / size.x, 1 / size.y);
  }

  /** A picture with the light of the sun as it is set. */
  private draw(share: number): void {
    this.setShare(share);
    this.lights.first(share < 1);
    this.drawShadows();
    this.detail?.select(this.camera, this.canvas.clientHeight, this.posed ? POSED : MOVING);
    this.renderer.info.reset();
    this.renderScene(this.picture);
    this.drawnWith = {
      calls: this.renderer.info.render.calls,
      triangles: this.renderer.info.render.triangles,
    };
    this.shown = this.picture;
    this.edges = 0;
    this.cornered = false;
    this.present();
  }

  private renderScene(target: THREE.WebGLRenderTarget, over = false): void {
    // Each sun knows whether its shadows are stale.
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.setRenderTarget(target);
    const { background } = this.scene;
    // A background clears.
    if (over) this.scene.background = null;
    else this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    this.scene.background = background;
    this.renderer.setRenderTarget(null);
    this.renderer.shadowMap.needsUpdate = false;
  }

  /** Puts the latest picture on the canvas, with outlines. */
  private present(): void {
    this.renderer.setRenderTarget(null);
    this.copy.material.map = this.shown.texture;
    this.copy.material.opacity = 1;
    this.renderer.clear();
    this.renderer.render(this.copy, this.flat);
    if (this.cornered) this.ambient.draw();
    const outlined = this.selected.to > this.selected.from || this.hovered.to > this.hovered.from;
    if (this.edges > 0 || outlined) this.drawOverlay(this.edges);
  }

  /**
   * Of a large model, the shadows of all that is large enough for them, where they are to be drawn
   * anew.
   */
  private drawShadows(): void {
    if (!this.detail || !this.lights.stale) return;
    this.detail.selectForShadow(this.lights.texel);
    // Drawing on one pixel draws the shadow map as well.
    this.renderScene(this.onePixel);
  }

  private drawOverlay(edges: number): void {
    this.leaves.update(this.camera);
    const uniforms = this.overlay.material.uniforms;
    uniforms.leaves!.value = this.leaves.target.texture;
    (uniforms.selected!.value as THREE.Vector2).set(this.selected.from, this.selected.to);
    (uniforms.hovered!.value as THREE.Vector2).set(this.hovered.from, this.hovered.to);
    uniforms.edges!.value = edges;
    this.renderer.render(this.overlay, this.flat);
  }

  /** One more step towards the best picture, then room for whatever else the page has to do. */
  private refine(): void {
    if (this.dirty || this.pass >= this.passes || !this.canvas.isConnected) return;
    // A model that no longer fits is framed once it stays as it is.
    if (!this.posed && this.navigation.mode === 'orbit' && this.framing.outgrown(this.bounds))
      return this.frameAll(false);
    const began = performance.now();
    if (this.coarse && this.detail) this.addHelping();
    else if (this.coarse) this.settle();
    else if (this.detail) this.finishPlace();
    else this.addPass();
    this.whenDrawn(() => {
      const took = performance.now() - began;
      // Where passes are slow, fewer have to do.
      if (took > SLOW_PASS_MS) this.passes = Math.min(this.passes, SHOWN_AFTER);
      if (this.pass >= this.passes) this.refined?.();
      else this.quiet = window.setTimeout(() => this.refine(), Math.max(8, took));
    });
  }

  /** The picture in full, as it was moved. */
  private settle(): void {
    this.coarse = false;
    this.draw(1);
    this.leaves.forget();
  }

  /** Of a large model one more helping, over those that are there. */
  private addHelping(): void {
    const first = !this.helpings;
    if (!this.helpings) {
      this.setShare(1);
      this.lights.first(false);
      this.lights.soften(true);
      this.drawShadows();
      this.helpings = this.detail!.helpings(this.camera, this.canvas.clientHeight);
    }
    const last = this.helpings.next().value ?? true;
    const marks = last ? [] : [this.scopes, this.manyScopes, this.ghosts];
    without(first ? marks : [...marks, this.dome, this.ground.group], () =>
      this.renderScene(this.picture, !first),
    );
    this.leaves.draw(this.camera, !first);
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
      this.ambient.read(this.leaves.target.depthTexture!, this.camera, this.size);
      this.cornered = true;
    }
    this.present();
  }

  private addPass(): void {
    const i = this.pass + 1;
    this.still.add(i, this.size, this.camera, this.lights, (target) => this.renderScene(target));
    this.pass = i;
    if (i % SHOWN_AFTER !== 0) return;
    this.shown = this.still.sum;
    this.edges = FINE_EDGES;
    this.present();
  }

  /** Calls back when the graphics card has drawn what was queued, without waiting for it. */
  private whenDrawn(then: () => void): void {
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    if (this.waiting) gl.deleteSync(this.waiting);
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.waiting = fence;
    if (!fence) return then();
    gl.flush();
    const look = () => {
      if (this.waiting !== fence || this.dirty) return;
      const state = gl.clientWaitSync(fence, 0, 0);
      if (state === gl.TIMEOUT_EXPIRED) this.quiet = window.setTimeout(look, 4);
      else then();
    };
    this.quiet = window.setTimeout(look, 2);
  }

  /** What the latest picture cost, and what the model holds of the graphics card's memory. */
  cost(): Cost {
    let bytes = 0;
    for (const { mesh } of this.batches) {
      const geometry = mesh.geometry as THREE.BufferGeometry;
      for (const name of Object.keys(geometry.attributes))
        bytes += geometry.attributes[name]!.array.byteLength;
      bytes += geometry.index?.array.byteLength ?? 0;
      if (mesh instanceof THREE.InstancedMesh) bytes += mesh.instanceMatrix.array.byteLength;
    }
    return { ...this.drawnWith, bytes };
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    clearTimeout(this.quiet);
    this.navigation.dispose();
    this.controls.dispose();
    this.ambient.dispose();
    this.still.dispose();
    this.leaves.dispose();
    this.onePixel.dispose();
    this.renderer.dispose();
  }
}
