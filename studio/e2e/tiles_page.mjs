// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The page of tiles_figures.mjs.

import {
  AmbientLight,
  Color,
  DirectionalLight,
  DoubleSide,
  FloatType,
  Mesh,
  NearestFilter,
  PerspectiveCamera,
  Scene,
  ShaderMaterial,
  Sphere,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { TilesRenderer } from '3d-tiles-renderer/three';
import { GLTFExtensionsPlugin } from '3d-tiles-renderer/three/plugins';

const WIDTH = 960;
const HEIGHT = 720;
const FIELD = 50;
const PIXELS = 16;
/** Every so many pixels one is looked at. */
const STEP = 4;

const renderer = new WebGLRenderer({ antialias: false });
renderer.setSize(WIDTH, HEIGHT);
document.body.append(renderer.domElement);
const camera = new PerspectiveCamera(FIELD, WIDTH / HEIGHT, 1, 100_000);
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
const target = new WebGLRenderTarget(WIDTH, HEIGHT, {
  type: FloatType,
  magFilter: NearestFilter,
  minFilter: NearestFilter,
});
const places = new ShaderMaterial({
  side: DoubleSide,
  uniforms: { center: { value: new Vector3() } },
  vertexShader: `varying vec3 at; uniform vec3 center;
    void main() { vec4 p = vec4(position, 1.0);
      #ifdef USE_INSTANCING
      p = instanceMatrix * p;
      #endif
      p = modelMatrix * p; at = p.xyz - center;
      gl_Position = projectionMatrix * viewMatrix * p; }`,
  fragmentShader: `varying vec3 at; void main() { gl_FragColor = vec4(at, 1.0); }`,
});

function lit() {
  const scene = new Scene();
  const sun = new DirectionalLight('#fff4e2', 2.4);
  sun.position.set(0.5, 1, 0.3);
  scene.add(new AmbientLight('#cfdcec', 1.5), sun);
  scene.background = new Color('#dfe6ec');
  return scene;
}

async function sceneOf(uris) {
  const scene = lit();
  for (const uri of uris) scene.add((await loader.loadAsync(`/tiles/${uri}`)).scene);
  scene.updateMatrixWorld(true);
  return scene;
}

/** Positions of what is seen, and the colours. */
function look(scene) {
  const out = {
    at: new Float32Array(WIDTH * HEIGHT * 4),
    color: new Uint8Array(WIDTH * HEIGHT * 4),
  };
  scene.background = null;
  scene.overrideMaterial = places;
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.clear();
  renderer.render(scene, camera);
  renderer.readRenderTargetPixels(target, 0, 0, WIDTH, HEIGHT, out.at);
  scene.overrideMaterial = null;
  renderer.setRenderTarget(null);
  renderer.setClearColor('#dfe6ec', 1);
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  gl.readPixels(0, 0, WIDTH, HEIGHT, gl.RGBA, gl.UNSIGNED_BYTE, out.color);
  return out;
}

/** How many pixels the nearest seen point of `b` is from each of `a`; infinite where it is far. */
function distances(a, b, eye) {
  const out = [];
  for (let y = 0; y < HEIGHT; y += STEP) {
    for (let x = 0; x < WIDTH; x += STEP) {
      const i = 4 * (y * WIDTH + x);
      if (a[i + 3] === 0) continue;
      const away = Math.hypot(a[i] - eye.x, a[i + 1] - eye.y, a[i + 2] - eye.z);
      const metre = HEIGHT / (2 * Math.tan((FIELD * Math.PI) / 360) * away);
      let best = Infinity;
      for (let v = Math.max(0, y - PIXELS); v <= Math.min(HEIGHT - 1, y + PIXELS); v += 1) {
        for (let u = Math.max(0, x - PIXELS); u <= Math.min(WIDTH - 1, x + PIXELS); u += 1) {
          const j = 4 * (v * WIDTH + u);
          if (b[j + 3] === 0) continue;
          const d = (a[i] - b[j]) ** 2 + (a[i + 1] - b[j + 1]) ** 2 + (a[i + 2] - b[j + 2]) ** 2;
          if (d < best) best = d;
        }
      }
      out.push(Math.sqrt(best) * metre);
    }
  }
  return out.sort((p, q) => p - q);
}

const beyond = (list) => list.filter((d) => d > PIXELS).length / Math.max(1, list.length);

function colorDifference(a, b) {
  let sum = 0;
  let count = 0;
  for (let i = 0; i < a.color.length; i += 4) {
    if (a.at[i + 3] === 0 && b.at[i + 3] === 0) continue;
    for (let k = 0; k < 3; k += 1) sum += Math.abs(a.color[i + k] - b.color[i + k]) / 3;
    count += 1;
  }
  return sum / Math.max(1, count);
}

/** The share of the covered pixels that one of both covers alone. */
function outlineDifference(a, b) {
  let one = 0;
  let any = 0;
  for (let i = 3; i < a.at.length; i += 4) {
    one += a.at[i] !== b.at[i];
    any += a.at[i] !== 0 || b.at[i] !== 0;
  }
  return one / Math.max(1, any);
}

/** Where a box of a tileset, with z up, is as far away as `wanted`, from its middle to there. */
function eyeAt(box, direction, wanted) {
  const center = new Vector3(box[0], box[2], -box[1]);
  const half = new Vector3(box[3], box[11], box[7]);
  const distance = (t) => {
    const p = direction.clone().multiplyScalar(t);
    const out = (axis) => Math.max(0, Math.abs(p[axis]) - half[axis]);
    return Math.hypot(out('x'), out('y'), out('z'));
  };
  let low = 0;
  let high = half.length() + wanted * 2;
  for (let i = 0; i < 60; i += 1) {
    const middle = (low + high) / 2;
    if (distance(middle) < wanted) low = middle;
    else high = middle;
  }
  return { center, eye: center.clone().addScaledVector(direction, high) };
}

window.compare = async ({ uri, leaves, box, error }) => {
  const [coarse, full] = [await sceneOf([uri]), await sceneOf(leaves)];
  const wanted = (error * HEIGHT) / (PIXELS * 2 * Math.tan((FIELD * Math.PI) / 360));
  const views = [];
  for (const [turn, rise] of [
    [0.4, 0.35],
    [2.6, 0.6],
    [4.4, 0.9],
  ]) {
    const direction = new Vector3(
      Math.cos(turn) * Math.cos(rise),
      Math.sin(rise),
      Math.sin(turn) * Math.cos(rise),
    );
    const { center, eye } = eyeAt(box, direction, wanted);
    camera.position.copy(eye);
    camera.near = Math.max(wanted / 10, 0.1);
    camera.far = wanted * 100 + 10_000;
    camera.lookAt(center);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld(true);
    places.uniforms.center.value.copy(center);
    const [a, b] = [look(coarse), look(full)];
    const from = eye.clone().sub(center);
    const there = distances(a.at, b.at, from);
    views.push({
      distance: wanted,
      median: there[Math.floor(there.length / 2)] ?? 0,
      most: Math.min(there[Math.floor(there.length * 0.99)] ?? 0, 99),
      beyond: beyond(there),
      lost: beyond(distances(b.at, a.at, from)),
      color: colorDifference(a, b),
      outline: outlineDifference(a, b),
    });
  }
  for (const scene of [coarse, full]) {
    scene.traverse((o) => o instanceof Mesh && o.geometry.dispose());
  }
  return views;
};

const nextFrame = () => new Promise((resolve) => requestAnimationFrame(resolve));
let open;

/** So many frames with nothing in them. */
window.frames = async (count) => {
  const scene = lit();
  for (let i = 0; i < count; i += 1) {
    await nextFrame();
    renderer.render(scene, camera);
  }
};

/** A tile from its request to its second picture. */
window.load = async (url) => {
  const tiles = new TilesRenderer(url);
  tiles.registerPlugin(
    new GLTFExtensionsPlugin({ metadata: true, meshoptDecoder: MeshoptDecoder }),
  );
  const scene = lit();
  scene.add(tiles.group);
  tiles.setCamera(camera);
  tiles.setResolutionFromRenderer(camera, renderer);
  tiles.addEventListener('load-tileset', () => {
    const ball = new Sphere();
    tiles.getBoundingSphere(ball);
    camera.position.copy(ball.center).add(new Vector3(0, 0, 2.5 * ball.radius));
    camera.up.set(0, 1, 0);
    camera.lookAt(ball.center);
    camera.near = ball.radius / 100;
    camera.far = ball.radius * 10;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld(true);
  });
  let model;
  tiles.addEventListener('load-model', (e) => (model = e.scene));
  let frames = 0;
  let after = 0;
  while (after < 3) {
    await nextFrame();
    frames += 1;
    tiles.update();
    if (model) {
      // All of it is drawn, wherever it lies.
      model.traverse((o) => (o.frustumCulled = false));
      after += 1;
    }
    renderer.render(scene, camera);
  }
  open = tiles;
  return { frames, triangles: renderer.info.render.triangles };
};

window.unload = async () => {
  open?.dispose();
  await nextFrame();
};
