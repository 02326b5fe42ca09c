// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A model that the reader turns, in a figure of its own. It is drawn again when something has moved, and
// not otherwise.

import {
  ACESFilmicToneMapping,
  Box3,
  Color,
  DirectionalLight,
  HemisphereLight,
  type Object3D,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

declare global {
  var gableTurn: ((figure: HTMLElement, address: string) => Promise<void>) | undefined;
}

/** Steepness of the first look, and its side, in radians. */
const kDown = 0.5;
const kAround = 0.7;

function light(scene: Scene, size: number): void {
  scene.add(new HemisphereLight('#dfeaf5', '#8d8672', 1.6));
  const sun = new DirectionalLight('#fff1dd', 2.6);
  sun.position.set(0.5 * size, 0.9 * size, 0.7 * size);
  scene.add(sun);
}

/** A camera that sees the whole model from above its corner. */
function look(camera: PerspectiveCamera, box: Box3): Vector3 {
  const centre = box.getCenter(new Vector3());
  const radius = box.getSize(new Vector3()).length() / 2;
  const far = (0.8 * radius) / Math.tan((camera.fov * Math.PI) / 360);
  camera.position
    .set(Math.sin(kAround) * Math.cos(kDown), Math.sin(kDown), Math.cos(kAround) * Math.cos(kDown))
    .multiplyScalar(far)
    .add(centre);
  camera.near = radius / 500;
  camera.far = radius * 20;
  camera.updateProjectionMatrix();
  return centre;
}

globalThis.gableTurn = async (figure, address) => {
  const model: Object3D = (await new GLTFLoader().loadAsync(address)).scene;
  const canvas = document.createElement('canvas');
  canvas.tabIndex = 0;
  canvas.setAttribute('aria-label', 'The model; arrow keys move it');
  figure.prepend(canvas);

  const renderer = new WebGLRenderer({ canvas, antialias: true });
  renderer.toneMapping = ACESFilmicToneMapping;
  const scene = new Scene();
  scene.background = new Color('#c9d8e4');
  scene.add(model);
  const box = new Box3().setFromObject(model);
  light(scene, box.getSize(new Vector3()).length());
  const camera = new PerspectiveCamera(40);
  const controls = new OrbitControls(camera, canvas);
  controls.target.copy(look(camera, box));
  controls.listenToKeyEvents(canvas);

  const draw = () => renderer.render(scene, camera);
  const fit = () => {
    const width = figure.clientWidth;
    const height = Math.round(Math.min(width * 0.6, window.innerHeight * 0.75));
    renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  };
  controls.addEventListener('change', draw);
  new ResizeObserver(fit).observe(figure);
  controls.update();
  fit();
};
