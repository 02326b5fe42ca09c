// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// three.mjs MODEL [PICTURE]: opens a model in a page with three.js in a headless Chromium, and says
// what arrived, and after how long its first picture stood. check.sh installs what it needs.

import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join, normalize } from 'node:path';

const require = createRequire(join(process.cwd(), 'package.json'));
const { chromium } = require('playwright-core');
const three = dirname(dirname(require.resolve('three')));
const [model, picture] = process.argv.slice(2);

const PAGE = `<!doctype html><html><body style="margin:0"><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
window.open_ = async () => {
  const begin = performance.now();
  const gltf = await new GLTFLoader().loadAsync('/model' + location.hash.slice(1));
  const loaded = performance.now() - begin;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color('#cfd8e2');
  scene.add(gltf.scene, new THREE.HemisphereLight('#ffffff', '#707070', 2));
  const sun = new THREE.DirectionalLight('#ffffff', 2);
  sun.position.set(0.5, 1, 0.7);
  scene.add(sun);
  const box = new THREE.Box3().setFromObject(gltf.scene);
  const ball = box.getBoundingSphere(new THREE.Sphere());
  const camera = new THREE.PerspectiveCamera(40, 960 / 540, ball.radius / 1000, ball.radius * 10);
  camera.position.copy(ball.center).add(new THREE.Vector3(0.9, 0.8, 1.1).setLength(ball.radius * 1.6));
  camera.lookAt(ball.center);
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(960, 540);
  document.body.append(renderer.domElement);
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  const shown = performance.now() - begin;
  let nodes = 0, triangles = 0;
  gltf.scene.traverse((o) => {
    nodes += 1;
    if (o.isMesh) triangles += (o.geometry.index.count / 3) * (o.isInstancedMesh ? o.count : 1);
  });
  return { loaded, shown, nodes, triangles };
};
</script></body></html>`;

const server = createServer((request, response) => {
  const path = normalize(new URL(request.url, 'http://x').pathname);
  if (path === '/favicon.ico') return response.writeHead(204).end();
  if (path === '/') return response.setHeader('Content-Type', 'text/html').end(PAGE);
  const file = path.startsWith('/three/') ? join(three, path.slice(7)) : model;
  if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
  const type = extname(file) === '.js' ? 'text/javascript' : 'application/octet-stream';
  response.setHeader('Content-Type', type).setHeader('Content-Length', statSync(file).size);
  createReadStream(file).pipe(response);
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=gl-egl', '--ignore-gpu-blocklist'],
});
try {
  const page = await browser.newPage({ viewport: { width: 960, height: 540 } });
  const failures = [];
  page.on('console', (m) => m.type() === 'error' && failures.push(m.text()));
  page.on('pageerror', (e) => failures.push(e.message));
  await page.goto(`http://127.0.0.1:${server.address().port}/#${extname(model)}`);
  await page.waitForFunction(() => 'open_' in window);
  const r = await page.evaluate(() => window.open_());
  if (picture) await page.screenshot({ path: picture });
  if (failures.length > 0) throw new Error(failures.join('\n'));
  const seconds = (ms) => (ms / 1000).toFixed(1);
  console.log(`three.js ${seconds(r.shown)} s (loaded after ${seconds(r.loaded)} s) ${r.nodes} nodes ${r.triangles} triangles`);
} finally {
  await browser.close();
  server.close();
}
