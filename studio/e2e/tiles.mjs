// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tiles in a browser: a small place is written with its page, all tiles load without an error, and
// a click on a building reads its attributes. `node e2e/tiles.mjs [FOLDER]` opens tiles that are
// there instead, and prints figures. Ends with 77, which counts as skipped, without Chromium.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import {
  createReadStream,
  existsSync,
  mkdtempSync,
  readdirSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { CHROMIUM, gable, hasBrowser, launch, openPage } from './studio.mjs';

if (!hasBrowser()) {
  console.log(`skipped: no Chromium at ${CHROMIUM}; GABLE_CHROMIUM names another`);
  process.exit(77);
}

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json' };

/** Any static server does; this one gives the files of a folder. */
function serveFiles(folder) {
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url, 'http://x').pathname);
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    if (!existsSync(file)) return response.writeHead(404).end();
    response.setHeader('Content-Type', TYPES[extname(file)] ?? 'application/octet-stream');
    createReadStream(file).pipe(response);
  });
  return new Promise((resolve) => {
    server.listen(0, '127.0.0.1', () => resolve(server));
  });
}

const square = (x, y, size) => [
  [x, y],
  [x + size, y],
  [x + size, y + size],
  [x, y + size],
  [x, y],
];
const building = (x, y, size, tags) => ({
  type: 'Feature',
  properties: { building: 'yes', ...tags },
  geometry: { type: 'Polygon', coordinates: [square(x, y, size)] },
});

/** Four towers around a large one, which is in the middle of the picture. */
function makePlace() {
  const folder = mkdtempSync(join(tmpdir(), 'gable-tiles-'));
  const features = [building(40, 40, 40, { name: 'Town hall', height: '30' })];
  for (const [x, y] of [
    [0, 0],
    [100, 0],
    [0, 100],
    [100, 100],
  ]) {
    features.push(building(x, y, 20, { 'building:levels': '4' }));
  }
  const crs = { type: 'name', properties: { name: 'EPSG:25832' } };
  writeFileSync(
    join(folder, 'map.geojson'),
    JSON.stringify({ type: 'FeatureCollection', crs, features }),
  );
  execFileSync(gable, [
    'city',
    join(folder, 'map.geojson'),
    '-o',
    `${folder}/`,
    '--viewer',
    '--tile-triangles',
    '2000',
  ]);
  return folder;
}

/** After so many frames without anything new the page waits in vain; seconds depend on the load. */
const MOST_STILL = 900;

/** Runs in the page. */
async function allHasCome(most) {
  let [still, last] = [0, ''];
  for (;;) {
    await new Promise((resolve) => requestAnimationFrame(resolve));
    const { dataset, textContent } = document.querySelector('#told');
    if (dataset.quiet === 'true') return;
    const now = `${textContent}, ${dataset.loaded} loaded`;
    still = now === last ? still + 1 : 0;
    last = now;
    if (still > most) throw new Error(`tiles do not come: ${now}`);
  }
}

const given = process.argv[2];
const folder = given ?? makePlace();
const server = await serveFiles(folder);
const browser = await launch();
try {
  const url = `http://127.0.0.1:${server.address().port}/`;
  const { page, complaints } = await openPage(browser, url);
  const outside = [];
  page.on(
    'request',
    (r) => r.url().startsWith(url) || r.url().startsWith('blob:') || outside.push(r.url()),
  );
  const told = page.locator('#told');
  const quiet = () => page.evaluate(allHasCome, MOST_STILL);
  await quiet().catch((e) => {
    throw new Error(complaints.join(' '), { cause: e });
  });
  // Near enough for the finest tiles.
  for (let i = 0; i < 6; ++i) {
    await page.mouse.move(640, 360);
    await page.mouse.wheel(0, -400);
    await page.waitForTimeout(300);
  }
  await page.waitForTimeout(500);
  await quiet();
  if (process.env.GABLE_SHOTS)
    await page.screenshot({ path: join(process.env.GABLE_SHOTS, 'tiles.png') });
  console.log(await told.textContent(), 'of', readdirSync(join(folder, 'tiles')).length);
  assert.equal(await told.getAttribute('data-failed'), '0');
  assert.ok(Number(await told.getAttribute('data-loaded')) > 1);
  await page.mouse.click(640, 360);
  const feature = await page.locator('#feature').innerText();
  console.log(feature);
  if (!given) {
    assert.match(feature, /Town hall/);
    assert.match(feature, /shape\s+Building/);
    assert.match(feature, /height\s+3\d/);
  }
  // What the library says of every tileset of version 1.1.
  assert.deepEqual(
    complaints.filter((c) => !c.includes('versions at 1.1')),
    [],
  );
  assert.deepEqual(outside, []);
} finally {
  await browser.close();
  server.close();
  if (!given) rmSync(folder, { recursive: true });
}
