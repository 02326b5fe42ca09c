// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A page that shows the tileset beside it: drag to turn, right drag to move, wheel to come nearer,
// click for what something is, Home or the button for the whole place. It asks for nothing but the
// tiles.

import {
  AmbientLight,
  Box3,
  Color,
  DirectionalLight,
  type Intersection,
  type Mesh,
  Matrix4,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Sphere,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { TilesRenderer } from '3d-tiles-renderer/three';
import { GLTFExtensionsPlugin } from '3d-tiles-renderer/three/plugins';
import { featureAt, rowsOf, titleOf, type Feature } from './features';

const SKY = '#dfe6ec';
/** Pixels that a tile may be wrong by: ?error=8. */
const ERROR = Number(new URLSearchParams(location.search).get('error') ?? 8);

const told = document.querySelector<HTMLElement>('#told');
const panel = document.querySelector<HTMLElement>('#feature');
const whole = document.querySelector<HTMLButtonElement>('#whole');

/** From the frame of the tileset to metres with y up, about the place itself. */
async function framed(url: string): Promise<Matrix4> {
  const tileset = (await (await fetch(url)).json()) as { root: { transform?: number[] } };
  const toEarth = new Matrix4();
  if (tileset.root.transform) toEarth.fromArray(tileset.root.transform);
  return new Matrix4().makeRotationX(-Math.PI / 2).multiply(toEarth.invert());
}

/** At the root of a server the renderer asks for `//tiles/0.glb`. */
const oneSlash = (address: string | URL) => {
  const at = new URL(address);
  at.pathname = at.pathname.replace(/^\/\/+/, '/');
  return at.href;
};

function show(feature: Feature | undefined) {
  if (!panel) return;
  panel.hidden = !feature;
  panel.replaceChildren();
  if (!feature) return;
  const title = document.createElement('h1');
  title.textContent = titleOf(feature);
  const table = document.createElement('table');
  for (const [name, value] of rowsOf(feature)) {
    const row = table.insertRow();
    row.insertCell().textContent = name;
    row.insertCell().textContent = value;
  }
  panel.append(title, table);
}

class Viewer {
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(50, 1, 1, 100_000);
  private readonly renderer = new WebGLRenderer({ antialias: true });
  private readonly controls = new OrbitControls(this.camera, this.renderer.domElement);
  private readonly raycaster = new Raycaster();
  private placed = false;
  private changed = true;
  private loading = false;
  private loaded = 0;
  private shown = 0;
  private failures = 0;

  constructor(
    private readonly tiles: TilesRenderer,
    toPlace: Matrix4,
  ) {
    this.scene.background = new Color(SKY);
    const sun = new DirectionalLight('#fff4e2', 2.4);
    sun.position.set(0.5, 1, 0.3);
    this.scene.add(new AmbientLight('#cfdcec', 1.5), sun);
    toPlace.decompose(tiles.group.position, tiles.group.quaternion, tiles.group.scale);
    this.scene.add(tiles.group);
    tiles.group.updateMatrixWorld(true);
    tiles.errorTarget = ERROR;
    tiles.setCamera(this.camera);
    tiles.addEventListener('load-model', () => {
      this.loaded += 1;
      this.tell();
    });
    tiles.addEventListener('load-error', () => {
      this.failures += 1;
      this.tell();
    });
    tiles.addEventListener('tiles-load-start', () => (this.loading = true));
    tiles.addEventListener('tiles-load-end', () => (this.loading = false));
    tiles.addEventListener('tile-visibility-change', ({ visible }) => {
      this.shown += visible ? 1 : -1;
      this.changed = true;
      this.tell();
    });
    this.controls.addEventListener('change', () => (this.changed = true));
    this.controls.maxPolarAngle = 0.49 * Math.PI;
    document.body.prepend(this.renderer.domElement);
    addEventListener('resize', () => this.resize());
    this.renderer.domElement.addEventListener('click', (e) => this.pick(e));
    whole?.addEventListener('click', () => this.place());
    addEventListener('keydown', (e) => {
      if (e.key === 'Home') this.place();
    });
    this.resize();
    this.renderer.setAnimationLoop(() => this.draw());
  }

  private tell() {
    if (!told) return;
    const failed = this.failures > 0 ? `, ${this.failures} could not be read` : '';
    told.textContent = `${this.shown} tiles${failed}`;
    told.dataset.loaded = String(this.loaded);
    told.dataset.failed = String(this.failures);
  }

  private resize() {
    this.camera.aspect = innerWidth / innerHeight;
    this.camera.updateProjectionMatrix();
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(innerWidth, innerHeight);
    this.tiles.setResolutionFromRenderer(this.camera, this.renderer);
    this.changed = true;
  }

  /** The whole place in the picture, from the south and above. */
  private place() {
    const ball = new Sphere();
    const box = new Box3();
    const turn = new Matrix4();
    if (!this.tiles.getBoundingSphere(ball)) return;
    ball.applyMatrix4(this.tiles.group.matrixWorld);
    if (this.tiles.getOrientedBoundingBox(box, turn)) {
      ball.radius = box.getSize(new Vector3()).length() / 2;
    }
    this.placed = true;
    this.controls.target.copy(ball.center);
    this.camera.position
      .copy(ball.center)
      .add(new Vector3(0, 0.75, 1).setLength(ball.radius * 1.7));
    // Farther out is nothing to see, and no way back.
    this.controls.minDistance = ball.radius / 500;
    this.controls.maxDistance = ball.radius * 6;
    this.camera.near = Math.max(ball.radius / 2000, 0.1);
    this.camera.far = ball.radius * 20;
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  private draw() {
    if (!this.placed) this.place();
    this.camera.updateMatrixWorld();
    this.tiles.update();
    if (this.changed) this.renderer.render(this.scene, this.camera);
    this.changed = false;
    if (told) told.dataset.quiet = String(this.loaded > 0 && !this.loading);
  }

  private pick(event: MouseEvent) {
    const at = new Vector2(
      (event.clientX / innerWidth) * 2 - 1,
      1 - (event.clientY / innerHeight) * 2,
    );
    this.raycaster.setFromCamera(at, this.camera);
    const hits = this.raycaster.intersectObject(this.tiles.group, true) as Intersection<Mesh>[];
    show(hits[0] && featureAt(hits[0]));
  }
}

// An absolute address: relative ones are looked up wrongly.
const url = new URL('tileset.json', location.href).href;
framed(url).then(
  (toPlace) => {
    const tiles = new TilesRenderer(url);
    tiles.registerPlugin(
      new GLTFExtensionsPlugin({
        metadata: true,
        meshoptDecoder: MeshoptDecoder,
        autoDispose: false,
      }),
    );
    tiles.registerPlugin({ preprocessURL: oneSlash });
    new Viewer(tiles, toPlace);
  },
  (e: unknown) => {
    if (told) told.textContent = `tileset.json cannot be read: ${String(e)}`;
  },
);
