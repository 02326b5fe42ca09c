// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SceneView: a draw list on a canvas, seen by a camera that people move. Where things are and what
// is shown is told here; Painter makes the pictures, Schedule says when, Marking points at parts,
// and Surroundings are what the model stands in.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { PictureView } from '../lib/client';
import type { DrawList } from '../lib/protocol';
import { BatchMaker, type Batched } from './batches';
import type { ScopeBox } from './boxes';
import { Detail } from './detail';
import { Framing, type Bounds, type Standpoint } from './framing';
import { Marking, type Range } from './marking';
import { Materials } from './materials';
import { Navigation, type Mode } from './navigation';
import { isSoftware, Pace } from './pace';
import { Painter } from './painter';
import { Schedule, type Work } from './schedule';
import { compassAzimuth } from './sun_time';
import { Surroundings, type ViewColors } from './surroundings';

export type { Range, ViewColors };

/** What a picture costs. */
export interface Cost {
  calls: number;
  triangles: number;
  /** Of all buffers on the graphics card. */
  bytes: number;
}

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
  readonly scene = new THREE.Scene();
  readonly surroundings: Surroundings;
  readonly marking = new Marking();
  /** The processor draws, as on a machine without a graphics card. */
  readonly software: boolean;

  private readonly model = new THREE.Group();
  private readonly painter: Painter;
  private readonly schedule: Schedule;
  private readonly materials = new Materials(this.marking.marks, () => {
    this.painter.leaves.forget();
    this.redraw();
  });
  readonly pictures = this.materials.pictures;
  private readonly batchMaker = new BatchMaker(this.marking.marks);
  private readonly framing: Framing;
  private batches: Batched[] = [];
  private bounds: Bounds = { min: [0, 0, 0], max: [20, 0, 20] };
  /** Counts models, so that one that was sorted too late is not shown. */
  private models = 0;
  /** As the view counts it: see sun_time. */
  private sun = { elevation: 44, azimuth: -28 };
  private wireframe = false;

  /** `posed`: for pictures that are taken as soon as they are drawn, so that all are in full. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly posed = false,
  ) {
    this.renderer = new THREE.WebGLRenderer({
      canvas,
      antialias: false,
      preserveDrawingBuffer: true,
    });
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    this.software = isSoftware(gl);
    this.surroundings = new Surroundings(this.scene, this.software && !posed);
    this.scene.add(this.model, ...this.marking.boxes);
    this.painter = new Painter(this.renderer, this);
    this.schedule = new Schedule(gl, new Pace(this.software), posed, this.work());
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

  private work(): Work {
    return {
      draw: (share) => this.painter.begin(share),
      unfinished: () => this.painter.unfinished && this.canvas.isConnected,
      refine: () => {
        // A model that no longer fits is framed once it stays as it is.
        const turned = !this.posed && this.navigation.mode === 'orbit';
        if (turned && this.framing.outgrown(this.bounds)) this.frameAll(false);
        else this.painter.refine();
      },
      hurry: () => this.painter.hurry(),
      drawn: () => this.drawn?.(),
      timed: (seconds) => this.timed?.(seconds),
      refined: () => this.refined?.(),
    };
  }

  cameraMoved(): void {
    this.painter.leaves.forget();
    this.schedule.cameraMoved();
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
    const height = this.painter.leaves.heightBelow(
      at,
      this.surroundings.ground.height,
      (base, range) => this.batchMaker.heights(base, range),
    );
    return height ?? Math.min(0, this.bounds.min[1]);
  }

  setColors(colors: ViewColors): void {
    this.surroundings.setColors(colors);
    this.marking.setColors(colors);
    this.fitGround();
    this.redraw();
  }

  /** With the sky the ground fades into the horizon; without, into a ground without end. */
  setSky(on: boolean): void {
    this.surroundings.setSky(on);
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
      lives || !Detail.worthIt(batches)
        ? null
        : await Detail.of(batches, () => number !== this.models);
    if (number !== this.models) return false;
    this.painter.detail = detail;
    for (const { mesh } of this.batches) {
      mesh.geometry.dispose();
      if (mesh instanceof THREE.InstancedMesh) mesh.dispose();
    }
    this.model.clear();
    this.batches = this.painter.leaves.batches = batches;
    for (const { mesh } of this.batches) this.model.add(mesh);
    this.fitWires();
    this.bounds = bounds;
    this.framing.know(list, bounds);
    this.fitGround();
    this.surroundings.fitSun(this.centre, this.radius);
    this.surroundings.lights.forget();
    if (this.framing.fresh && list.leaves > 0) this.frameAll();
    this.painter.leaves.forget();
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
    const within = !!this.navigation && this.navigation.mode !== 'orbit';
    this.surroundings.fitGround(this.centre, r, this.bounds.min[1], within);
    const near = this.navigation?.mode === 'walk' ? 0.08 : 0.05;
    this.camera.near = within ? near : Math.max(near, r / 300);
    this.camera.far = r * 60;
    this.camera.updateProjectionMatrix();
  }

  setSun(elevation: number, azimuth: number): void {
    this.sun = { elevation, azimuth };
    this.surroundings.setSun(elevation, azimuth);
    this.marking.marks.lit.value = this.surroundings.lights.day.lit;
    this.redraw();
  }

  setSelected(range: Range | null): void {
    if (!this.marking.select(range)) return;
    // The picture of a large model stays, below the outline.
    if (this.painter.detail && !this.schedule.dirty) this.painter.present();
    else this.redraw(true);
  }

  setHovered(range: Range | null): void {
    if (!this.marking.hover(range)) return;
    // The picture itself stays; one that is about to be drawn has the outline anyway.
    if (!this.schedule.dirty) this.painter.present();
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
    if (this.painter.detail) box = null;
    if (this.marking.setScope(box)) this.redraw(true);
  }

  /** The scopes of many shapes, thinly. */
  setScopes(boxes: ScopeBox[]): void {
    if (this.marking.setScopes(boxes)) this.redraw(true);
  }

  /** Shows a derivation as it is after a step, and what the step has replaced. */
  setStep(step: number, ghost: ScopeBox | null): void {
    if (!this.marking.setStep(step, ghost)) return;
    this.painter.leaves.forget();
    this.surroundings.lights.forget();
    this.redraw();
  }

  standpoint(): Standpoint {
    return this.framing.standpoint();
  }

  /** What a picture shows that is taken from here. */
  pictureView(): PictureView {
    // Who walks does not look at what an orbit turns about.
    const { position, target: middle } = this.framing.standpoint();
    const ahead = this.camera.getWorldDirection(new THREE.Vector3());
    const far = Math.max(1, this.camera.position.distanceTo(new THREE.Vector3(...middle)));
    const target = this.camera.position.clone().addScaledVector(ahead, far).toArray();
    const half = Math.tan((this.camera.fov * Math.PI) / 360) * this.camera.aspect;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const angle = (Math.atan(half) * 360) / Math.PI;
    const sun = { elevation: this.sun.elevation, azimuth: compassAzimuth(this.sun.azimuth) };
    return { eye: position, target, angle, width, height, sun };
  }

  /** Stands where somebody stood before, over the model that comes next. */
  lookFrom(from: Standpoint): void {
    this.framing.lookFrom(from, this.bounds);
    this.painter.leaves.forget();
    this.redraw();
  }

  frameAll(reset = true): void {
    this.framing.model(this.bounds, reset);
    this.painter.leaves.forget();
    this.redraw();
  }

  frameBox(bounds: Bounds, reset = false): void {
    this.framing.box(bounds, reset);
    this.painter.leaves.forget();
    this.redraw();
  }

  /** The leaf under a point of the canvas in CSS pixels; -1 for none. */
  pick(x: number, y: number): number {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { leaves, detail } = this.painter;
    return leaves.leafAt({ x, y }, { width, height }, this.camera, !!detail);
  }

  /**
   * The leaf under a point of the canvas, and where it is there; the ground where there is none.
   * Null for the sky.
   */
  surfaceAt(x: number, y: number): { point: [number, number, number]; leaf: number } | null {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    const depth = this.painter.leaves.depthAt(x / w, 1 - y / h, this.camera);
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
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.painter.resized();
    this.schedule.drawNow();
  }

  /**
   * Draws anew; `fine`: what changes does not move, so that the picture may take a little longer.
   */
  redraw(fine = false): void {
    this.schedule.redraw(fine);
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
    return { ...this.painter.cost, bytes };
  }

  dispose(): void {
    this.schedule.dispose();
    this.navigation.dispose();
    this.controls.dispose();
    this.painter.dispose();
    this.renderer.dispose();
  }
}
