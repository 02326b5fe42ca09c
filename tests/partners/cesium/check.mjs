// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tiles in Cesium: check.mjs TILES [PICTURE]. Serves the folder of a tileset, loads it in Cesium in
// a headless Chromium, waits until all that is seen has come, as long as something comes, picks what
// stands in the middle and reads its attributes. Ends with an error where Cesium tells one, a tile fails, or nothing is
// picked. It runs in the folder that has its packages: tests/partners/cesium.sh.

import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join, normalize } from 'node:path';

const require = createRequire(join(process.cwd(), 'package.json'));
const { chromium } = require('playwright-core');
const cesium = join(dirname(require.resolve('cesium/package.json')), 'Build', 'Cesium');
const [tiles, picture] = process.argv.slice(2);

const TYPES = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.json': 'application/json',
  '.css': 'text/css',
  '.wasm': 'application/wasm',
};

const PAGE = `<!doctype html><html><head><script>window.CESIUM_BASE_URL = '/cesium/';</script>
<script src="/cesium/Cesium.js"></script>
<style>html, body, #view, #view * { width: 100%; height: 100%; margin: 0 }
.cesium-widget-credits { display: none !important }</style></head>
<body><div id="view"></div></body></html>`;

const server = createServer((request, response) => {
  const path = normalize(new URL(request.url, 'http://x').pathname);
  if (path === '/favicon.ico') return response.writeHead(204).end();
  if (path === '/') return response.setHeader('Content-Type', 'text/html').end(PAGE);
  const file = path.startsWith('/cesium/') ? join(cesium, path.slice(8)) : join(tiles, path.slice(7));
  if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
  response.setHeader('Content-Type', TYPES[extname(file)] ?? 'application/octet-stream');
  createReadStream(file).pipe(response);
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));

/** Runs in the page. */
async function look() {
  const { Cesium } = window;
  const failures = [];
  const viewer = new Cesium.CesiumWidget('view', {
    baseLayer: false,
    globe: false,
    skyBox: false,
    requestRenderMode: false,
  });
  viewer.scene.requestRenderMode = false;
  const tileset = await Cesium.Cesium3DTileset.fromUrl('/tiles/tileset.json', {
    maximumScreenSpaceError: 4,
  });
  let loaded = 0;
  const spent = [];
  tileset.tileFailed.addEventListener((e) => failures.push(`${e.url}: ${e.message}`));
  tileset.tileLoad.addEventListener(() => (loaded += 1));
  let left = '';
  tileset.loadProgress.addEventListener((asked, read) => (left = `${asked} asked, ${read} read`));
  viewer.scene.primitives.add(tileset);
  const ball = tileset.boundingSphere;
  viewer.camera.lookAt(ball.center, new Cesium.HeadingPitchRange(0.4, -0.8, ball.radius * 0.25));
  // Counted in frames and not in seconds: a machine with other work draws fewer.
  const MOST_STILL = 1500;
  const settled = () =>
    new Promise((resolve, reject) => {
      let [still, last] = [0, ''];
      const wait = () => {
        const before = performance.now();
        viewer.render();
        spent.push(performance.now() - before);
        if (tileset.tilesLoaded && loaded > 0) return resolve();
        const now = `${loaded} tiles loaded, ${left}`;
        still = now === last ? still + 1 : 0;
        last = now;
        if (still > MOST_STILL) return reject(new Error(`tiles do not settle: ${now}`));
        setTimeout(wait, 20);
      };
      wait();
    });
  await settled();
  viewer.render();
  const { width, height } = viewer.canvas;
  // From the middle outwards, until something is met.
  for (let ring = 0; ring < 12; ring += 1) {
    for (let turn = 0; turn < 8; turn += 1) {
      const angle = (turn * Math.PI) / 4;
      const at = new Cesium.Cartesian2(
        width / 2 + Math.cos(angle) * ring * 20,
        height / 2 + Math.sin(angle) * ring * 20,
      );
      const feature = viewer.scene.pick(at);
      if (feature?.getPropertyIds === undefined) continue;
      const names = feature.getPropertyIds();
      if (names.length === 0) continue;
      const row = Object.fromEntries(names.map((name) => [name, feature.getProperty(name)]));
      return { loaded, failures, row, longest: Math.max(...spent) };
    }
  }
  return { loaded, failures, longest: Math.max(...spent) };
}

const browser = await chromium.launch({
  executablePath: process.env.GABLE_CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=gl-egl', '--ignore-gpu-blocklist'],
});
let wrong = 0;
try {
  const page = await browser.newPage({ viewport: { width: 960, height: 600 } });
  const complaints = [];
  page.on('pageerror', (e) => complaints.push(String(e)));
  page.on('console', (m) => m.type() === 'error' && complaints.push(m.text()));
  page.setDefaultTimeout(0);
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  const seen = await page.evaluate(look);
  if (picture) await page.screenshot({ path: picture });
  console.log(`${seen.loaded} tiles, longest frame ${Math.round(seen.longest)} ms`);
  for (const [name, value] of Object.entries(seen.row ?? {})) console.log(`  ${name}: ${value}`);
  for (const what of [...complaints, ...seen.failures]) console.error(`error: ${what}`);
  if (!seen.row) console.error('error: nothing was picked');
  wrong = complaints.length + seen.failures.length + (seen.row ? 0 : 1);
} finally {
  await browser.close();
  server.close();
}
process.exit(wrong > 0 ? 1 : 0);
