// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SceneView: a draw list on a canvas. It draws when something changed and then, while nothing does,
// refines the picture: further passes with a moved sun and moved pixels are averaged into soft
// shadows, light from the whole sky and smooth edges. The first picture never waits for that.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Batch, DrawList, Look } from '../lib/protocol';
import { groundMaterial, leafMaterial, lookMaterial, outlineMaterial, type Marks } from './shading';

export interface ViewColors {
  ground: string;
  line: string;
  accent: string;
  text: string;
}

export interface Bounds {
  min: [number, number, number];
  max: [number, number, number];
}

export interface Range {
  from: number;
  to: number;
}

const NOTHING: Range = { from: 0, to: 0 };
/** Passes that a still picture is made of. */
const PASSES = 40;
const QUIET_MS = 220;
const SLOW_PASS_MS = 180;

interface Batched {
  mesh: THREE.Mesh;
  plain: THREE.Material;
  leaf: THREE.Material;
}

/** The i-th number of the radical inverse sequence: evenly spread however many are taken. */
function spread(i: number, base: number): number {
  let out = 0;
  for (let f = 1 / base, n = i; n > 0; n = Math.floor(n / base), f /= base) out += f * (n % base);
  return out;
}

export class SceneView {
  readonly renderer: THREE.WebGLRenderer;
  readonly camera = new THREE.PerspectiveCamera(28, 1, 0.1, 5000);
  readonly controls: OrbitControls;
  /** Called after each first picture of a change, not after refinements. */
  drawn: (() => void) | null = null;
  /** Called when the camera has moved. */
  moved: (() => void) | null = null;
  loadTexture: ((path: string) => Promise<Blob>) | null = null;

  private readonly scene = new THREE.Scene();
  private readonly model = new THREE.Group();
  private readonly sun = new THREE.DirectionalLight(0xfff1dc, 2.9);
  private readonly sky = new THREE.HemisphereLight(0xe4edf4, 0x9a948a, 1.7);
  private readonly ground: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshLambertMaterial>;
  private readonly grid: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  private readonly marks: Marks = {
    selected: { value: new THREE.Vector2() },
    accent: { value: new THREE.Color() },
  };
  private readonly overlay = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), outlineMaterial());
  private readonly copy: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>;
  private readonly flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly leafMerged = leafMaterial(false);
  private readonly leafInstanced = leafMaterial(true);
  private readonly scopes = new THREE.Group();
  private leafTarget = new THREE.WebGLRenderTarget(1, 1, { type: THREE.UnsignedByteType });
  private passTarget = new THREE.WebGLRenderTarget(1, 1, { type: THREE.HalfFloatType });
  private sumTarget = new THREE.WebGLRenderTarget(1, 1, { type: THREE.HalfFloatType });
  private readonly pickTarget = new THREE.WebGLRenderTarget(1, 1);
  private batches: Batched[] = [];
  private bounds: Bounds = { min: [0, 0, 0], max: [20, 0, 20] };
  private selected = NOTHING;
  private hovered = NOTHING;
  private sunAngles = { elevation: 44, azimuth: -28 };
  private dirty = false;
  private leavesStale = true;
  private pass = 0;
  private quiet = 0;
  private frame = 0;
  private framed = false;
  /** Refinement has left the sun elsewhere. */
  private sunMoved = false;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.autoClear = false;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.04;
    this.ground = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), new THREE.MeshLambertMaterial());
    this.ground.rotation.x = -Math.PI / 2;
    this.ground.receiveShadow = true;
    this.grid = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), groundMaterial());
    this.grid.rotation.x = -Math.PI / 2;
    this.copy = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2),
      new THREE.MeshBasicMaterial({ transparent: true, depthTest: false, depthWrite: false, toneMapped: false }),
    );
    for (const screen of [this.overlay, this.copy]) screen.frustumCulled = false;
    this.scene.add(this.model, this.sun, this.sun.target, this.sky, this.ground, this.grid, this.scopes);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.addEventListener('change', () => {
      this.leavesStale = true;
      this.camera.updateMatrixWorld();
      this.moved?.();
      this.redraw();
    });
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  setColors(colors: ViewColors): void {
    const ground = new THREE.Color(colors.ground);
    this.scene.background = ground;
    this.scene.fog = new THREE.Fog(ground, 100, 1000);
    this.ground.material.color.copy(ground).multiplyScalar(1.05);
    (this.grid.material.uniforms.line!.value as THREE.Color).set(colors.line);
    this.marks.accent.value.set(colors.accent);
    const uniforms = this.overlay.material.uniforms;
    (uniforms.accent!.value as THREE.Color).set(colors.accent);
    (uniforms.text!.value as THREE.Color).set(colors.text);
    this.fitGround();
    this.redraw();
  }

  setModel(list: DrawList, bounds: Bounds): void {
    for (const { mesh } of this.batches) {
      mesh.geometry.dispose();
      if (mesh instanceof THREE.InstancedMesh) mesh.dispose();
    }
    for (const each of this.batches) each.plain.dispose();
    this.model.clear();
    const materials = list.looks.map((look) => this.materialOf(look));
    this.batches = list.batches.map((batch) => this.batched(batch, materials[batch.look]!));
    for (const { mesh } of this.batches) this.model.add(mesh);
    this.bounds = bounds;
    this.fitGround();
    this.fitSun();
    if (!this.framed && list.leaves > 0) {
      this.framed = true;
      this.frameAll();
    }
    this.leavesStale = true;
    this.redraw();
  }

  private materialOf(look: Look): THREE.MeshLambertMaterial {
    const material = lookMaterial(look, this.marks);
    if (look.map && this.loadTexture) void this.applyTexture(material, look, this.loadTexture);
    return material;
  }

  private async applyTexture(
    material: THREE.MeshLambertMaterial,
    look: Look,
    load: (path: string) => Promise<Blob>,
  ): Promise<void> {
    try {
      const picture = await createImageBitmap(await load(look.map ?? ''), { imageOrientation: 'flipY' });
      const texture = new THREE.Texture(picture);
      texture.flipY = false;
      texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
      texture.colorSpace = THREE.SRGBColorSpace;
      texture.generateMipmaps = true;
      texture.anisotropy = 4;
      const [su, sv, tu, tv, rw] = look.uv ?? [1, 1, 0, 0, 0];
      texture.repeat.set(su, sv);
      texture.offset.set(tu, tv);
      texture.rotation = (rw * Math.PI) / 180;
      texture.needsUpdate = true;
      material.map = texture;
      material.needsUpdate = true;
      this.redraw();
    } catch {
      // Without its picture a face keeps its colour.
    }
  }

  private batched(batch: Batch, plain: THREE.Material): Batched {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(batch.position, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(batch.normal, 3));
    if (batch.uv) geometry.setAttribute('uv', new THREE.BufferAttribute(batch.uv, 2));
    geometry.setIndex(new THREE.BufferAttribute(batch.index, 1));
    let mesh: THREE.Mesh;
    if (batch.matrix) {
      geometry.setAttribute('tint', new THREE.InstancedBufferAttribute(batch.color, 4, true));
      geometry.setAttribute('leaf', new THREE.InstancedBufferAttribute(batch.leaf, 1));
      const many = new THREE.InstancedMesh(geometry, plain, batch.leaf.length);
      many.instanceMatrix = new THREE.InstancedBufferAttribute(batch.matrix, 16);
      mesh = many;
    } else {
      geometry.setAttribute('tint', new THREE.BufferAttribute(batch.color, 4, true));
      geometry.setAttribute('leaf', new THREE.BufferAttribute(batch.leaf, 1));
      mesh = new THREE.Mesh(geometry, plain);
    }
    mesh.frustumCulled = false;
    mesh.castShadow = !plain.transparent;
    mesh.receiveShadow = true;
    return { mesh, plain, leaf: batch.matrix ? this.leafInstanced : this.leafMerged };
  }

  private get centre(): THREE.Vector3 {
    const { min, max } = this.bounds;
    return new THREE.Vector3((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2);
  }

  private get radius(): number {
    const { min, max } = this.bounds;
    return Math.max(1, Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]) / 2);
  }

  private fitGround(): void {
    const r = this.radius;
    const c = this.centre;
    const y = Math.min(0, this.bounds.min[1]) - Math.max(0.02, r * 4e-4);
    for (const plane of [this.ground, this.grid]) {
      plane.position.set(c.x, y, c.z);
      plane.scale.set(r * 60, r * 60, 1);
    }
    this.grid.position.y = y + r * 1e-4;
    const uniforms = this.grid.material.uniforms;
    (uniforms.centre!.value as THREE.Vector2).set(c.x, c.z);
    uniforms.reach!.value = Math.max(30, r * 3.2);
    uniforms.cell!.value = r < 12 ? 1 : 10;
    if (this.scene.fog instanceof THREE.Fog) {
      this.scene.fog.near = r * 5;
      this.scene.fog.far = r * 22;
    }
    this.camera.near = Math.max(0.05, r / 300);
    this.camera.far = r * 60;
    this.camera.updateProjectionMatrix();
  }

  private fitSun(direction?: THREE.Vector3): void {
    const { elevation, azimuth } = this.sunAngles;
    const e = (elevation * Math.PI) / 180;
    const a = (azimuth * Math.PI) / 180;
    const to = direction ?? new THREE.Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
    const r = this.radius * 1.08;
    this.sun.position.copy(this.centre).addScaledVector(to, r * 3);
    this.sun.target.position.copy(this.centre);
    const camera = this.sun.shadow.camera;
    camera.left = camera.bottom = -r;
    camera.right = camera.top = r;
    camera.near = r;
    camera.far = r * 5;
    camera.updateProjectionMatrix();
    this.sun.shadow.normalBias = r / 700;
    this.renderer.shadowMap.needsUpdate = true;
  }

  setSun(elevation: number, azimuth: number): void {
    this.sunAngles = { elevation, azimuth };
    this.fitSun();
    this.redraw();
  }

  setSelected(range: Range | null): void {
    this.selected = range ?? NOTHING;
    this.marks.selected.value.set(this.selected.from, this.selected.to);
    this.redraw();
  }

  setHovered(range: Range | null): void {
    const next = range ?? NOTHING;
    if (next.from === this.hovered.from && next.to === this.hovered.to) return;
    this.hovered = next;
    this.redraw();
  }

  setWireframe(on: boolean): void {
    for (const { plain } of this.batches) (plain as THREE.MeshLambertMaterial).wireframe = on;
    this.redraw();
  }

  /** A box in the accent colour with its axes; null hides it. */
  setScope(frame: ArrayLike<number> | null, size: ArrayLike<number> | null): void {
    this.scopes.traverse((o) => {
      if (o instanceof THREE.LineSegments) (o.geometry as THREE.BufferGeometry).dispose();
    });
    this.scopes.clear();
    if (frame && size) this.scopes.add(...scopeLines(frame, size, this.marks.accent.value));
    this.redraw();
  }

  frameAll(): void {
    this.frameBox(this.bounds, true);
  }

  frameBox(bounds: Bounds, reset = false): void {
    const box = new THREE.Box3(new THREE.Vector3(...bounds.min), new THREE.Vector3(...bounds.max));
    const centre = box.getCenter(new THREE.Vector3());
    const radius = Math.max(0.5, box.getSize(new THREE.Vector3()).length() / 2);
    const direction = reset
      ? new THREE.Vector3(0.52, 0.5, 0.82).normalize()
      : this.camera.position.clone().sub(this.controls.target).normalize();
    const vertical = (this.camera.fov * Math.PI) / 360;
    const across = Math.atan(Math.tan(vertical) * Math.min(1, this.camera.aspect));
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(direction, (radius * 1.02) / Math.sin(across));
    this.controls.update();
    this.leavesStale = true;
    this.redraw();
  }

  /** The leaf under a point of the canvas in CSS pixels; -1 for none. */
  pick(x: number, y: number): number {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    this.camera.setViewOffset(w, h, x, y, 1, 1);
    this.renderLeaves(this.pickTarget);
    this.camera.clearViewOffset();
    const bytes = new Uint8Array(4);
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, 1, 1, bytes);
    return bytes[0]! + bytes[1]! * 256 + bytes[2]! * 65536 - 1;
  }

  private renderLeaves(target: THREE.WebGLRenderTarget): void {
    const background = this.scene.background;
    this.scene.background = null;
    this.ground.visible = this.grid.visible = this.scopes.visible = false;
    for (const b of this.batches) b.mesh.material = b.leaf;
    this.renderer.setRenderTarget(target);
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    this.renderer.setRenderTarget(null);
    for (const b of this.batches) b.mesh.material = b.plain;
    this.ground.visible = this.grid.visible = this.scopes.visible = true;
    this.scene.background = background;
  }

  private resize(): void {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    if (!w || !h) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(w, h, false);
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    for (const target of [this.leafTarget, this.passTarget, this.sumTarget]) target.setSize(size.x, size.y);
    (this.overlay.material.uniforms.texel!.value as THREE.Vector2).set(1 / size.x, 1 / size.y);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.leavesStale = true;
    this.render();
  }

  redraw(): void {
    this.dirty = true;
    if (!this.frame) this.frame = requestAnimationFrame(() => this.tick());
  }

  private tick(): void {
    this.frame = 0;
    if (this.dirty) {
      this.render();
      this.drawn?.();
      clearTimeout(this.quiet);
      this.quiet = window.setTimeout(() => this.refine(), QUIET_MS);
    }
  }

  private render(): void {
    this.dirty = false;
    this.pass = 0;
    if (this.sunMoved) this.fitSun();
    this.sunMoved = false;
    this.renderer.setRenderTarget(null);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    if (this.selected.to > this.selected.from || this.hovered.to > this.hovered.from) this.drawOverlay(0);
  }

  private drawOverlay(edges: number): void {
    if (this.leavesStale) {
      this.renderLeaves(this.leafTarget);
      this.leavesStale = false;
    }
    const uniforms = this.overlay.material.uniforms;
    uniforms.leaves!.value = this.leafTarget.texture;
    (uniforms.selected!.value as THREE.Vector2).set(this.selected.from, this.selected.to);
    (uniforms.hovered!.value as THREE.Vector2).set(this.hovered.from, this.hovered.to);
    uniforms.edges!.value = edges;
    this.renderer.render(this.overlay, this.flat);
  }

  /** One more pass of a still picture, then room for whatever else the page has to do. */
  private refine(): void {
    if (this.dirty || this.pass >= PASSES || !this.canvas.isConnected) return;
    const began = performance.now();
    const i = this.pass + 1;
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    // Four passes in ten look from the sun, spread over its disc; the others are light of the sky.
    const fromSun = i % 5 < 2;
    const sunlight = this.sun.intensity;
    const skylight = this.sky.intensity;
    this.sunMoved = true;
    this.fitSun(fromSun ? this.aroundSun(i) : this.inSky(i));
    this.sun.color.set(fromSun ? 0xfff1dc : 0xe6eef4);
    this.sun.intensity = fromSun ? sunlight * 2.1 : 2.9;
    this.sky.intensity = 0.5;
    this.camera.setViewOffset(size.x, size.y, spread(i, 2) - 0.5, spread(i, 3) - 0.5, size.x, size.y);
    this.renderer.setRenderTarget(this.sumTarget);
    if (this.pass === 0) this.renderer.clear();
    this.accumulate(i);
    this.camera.clearViewOffset();
    this.sun.intensity = sunlight;
    this.sun.color.set(0xfff1dc);
    this.sky.intensity = skylight;
    this.pass = i;
    if (i % 10 === 0 || i === PASSES) this.showSum();
    // Reading a pixel waits for the drawing itself, which calls only queue.
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, 1, 1, new Uint8Array(4));
    const took = performance.now() - began;
    // Where a pass is slow, refining would hold up the page: the picture stays as it is.
    if (took > SLOW_PASS_MS) this.pass = PASSES;
    this.quiet = window.setTimeout(() => this.refine(), Math.max(8, took));
  }

  private aroundSun(i: number): THREE.Vector3 {
    const { elevation, azimuth } = this.sunAngles;
    const e = ((elevation + (spread(i, 5) - 0.5) * 2.4) * Math.PI) / 180;
    const a = ((azimuth + (spread(i, 7) - 0.5) * 2.4) * Math.PI) / 180;
    return new THREE.Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
  }

  private inSky(i: number): THREE.Vector3 {
    const y = Math.sqrt(0.03 + 0.95 * spread(i, 2));
    const a = 2 * Math.PI * spread(i, 3);
    const r = Math.sqrt(1 - y * y);
    return new THREE.Vector3(Math.sin(a) * r, y, Math.cos(a) * r);
  }

  private accumulate(i: number): void {
    this.renderer.setRenderTarget(this.passTarget);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    this.renderer.setRenderTarget(this.sumTarget);
    this.copy.material.map = this.passTarget.texture;
    this.copy.material.opacity = 1 / i;
    this.renderer.render(this.copy, this.flat);
    this.renderer.setRenderTarget(null);
  }

  private showSum(): void {
    this.renderer.setRenderTarget(null);
    this.copy.material.map = this.sumTarget.texture;
    this.copy.material.opacity = 1;
    this.renderer.clear();
    this.renderer.render(this.copy, this.flat);
    this.drawOverlay(0.22);
  }

  get drawCalls(): number {
    return this.batches.length;
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    clearTimeout(this.quiet);
    this.controls.dispose();
    this.renderer.dispose();
  }
}

function scopeLines(frame: ArrayLike<number>, size: ArrayLike<number>, accent: THREE.Color): THREE.LineSegments[] {
  const at = (x: number, y: number, z: number) =>
    [0, 1, 2].map((i) => frame[i]! + frame[3 + i]! * x + frame[6 + i]! * y + frame[9 + i]! * z);
  const [w, h, d] = [size[0]!, size[1]!, size[2]!];
  const corner = (i: number) => at(i & 1 ? w : 0, i & 2 ? h : 0, i & 4 ? d : 0);
  const box: number[] = [];
  for (let i = 0; i < 8; ++i) for (const bit of [1, 2, 4]) if (!(i & bit)) box.push(...corner(i), ...corner(i | bit));
  const length = Math.max(w, h, d) * 0.25;
  const lines = (points: number[], color: THREE.ColorRepresentation) => {
    const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color, depthTest: false, transparent: true }));
  };
  const axis = (x: number, y: number, z: number) => [...at(0, 0, 0), ...at(x * length, y * length, z * length)];
  return [lines(box, accent), lines(axis(1, 0, 0), 0xe0564e), lines(axis(0, 1, 0), 0x69b545), lines(axis(0, 0, 1), 0x4f86e0)];
}
