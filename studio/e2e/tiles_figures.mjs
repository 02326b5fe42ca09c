// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What tiles promise, measured in a headless Chromium: `node e2e/tiles_figures.mjs FOLDER [COUNT]`.
//
// errors: each of COUNT coarse tiles is drawn beside the full model below it, from where a viewer
// would change from the one to the other when tiles may be wrong by 16 pixels. Of every point that
// is seen it is told how far, in pixels, the nearest point is that is seen of the other.
//
// times: the COUNT largest tiles go through 3d-tiles-renderer, one at a time. The seconds of the
// processor that the page's main thread has spent on a tile are told, from the request to the
// picture, and the longest task of it. Ends with 1 where a tile takes more than 30 ms.

import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { dirname, extname, join, normalize } from 'node:path';
import { hasBrowser, launch, openPage, root } from './studio.mjs';

const MOST_MS = 30;
const TYPES = {
  '.js': 'text/javascript',
  '.mjs': 'text/javascript',
  '.json': 'application/json',
  '.png': 'image/png',
  '.jpg': 'image/jpeg',
};

const PAGE = `<!doctype html><link rel="icon" href="data:,"><script type="importmap">{"imports":{
"three":"/modules/three/build/three.module.js",
"three/addons/":"/modules/three/examples/jsm/","three/examples/jsm/":"/modules/three/examples/jsm/",
"3d-tiles-renderer/three":"/modules/3d-tiles-renderer/build/index.three.js",
"3d-tiles-renderer/three/plugins":"/modules/3d-tiles-renderer/build/index.three-plugins.js"}}
</script><script type="module" src="/page.mjs"></script>`;

/** The tileset of a tile alone, from the address that it is asked by. */
function alone(tile) {
  const root = { boundingVolume: { box: tile.box }, geometricError: 0, refine: 'REPLACE' };
  root.content = { uri: `/tiles/${tile.uri}` };
  return JSON.stringify({ asset: { version: '1.1' }, geometricError: 1e6, root });
}

function serveTiles(folder, tiles) {
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url, 'http://x').pathname).replace(/^\/+/, '/');
    response.setHeader('Content-Type', TYPES[extname(path)] ?? 'text/html');
    try {
      const [, kind, rest] = path.match(/^\/(\w+)\/(.*)$/) ?? [];
      if (kind === 'tiles') return response.end(readFileSync(join(folder, rest)));
      if (kind === 'alone') return response.end(alone(tiles[Number.parseInt(rest, 10)]));
      if (kind === 'modules')
        return response.end(readFileSync(join(root, 'studio/node_modules', rest)));
      if (path === '/page.mjs')
        return response.end(readFileSync(join(root, 'studio/e2e/tiles_page.mjs')));
      return response.end(PAGE);
    } catch {
      return response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

/** All tiles, those of tilesets within the tileset among them; children after parents. */
function tilesOf(folder) {
  const tiles = [];
  const add = (node, from) => {
    const uri = node.content ? join(from, node.content.uri) : undefined;
    if (uri?.endsWith('.json')) {
      return add(JSON.parse(readFileSync(join(folder, uri))).root, dirname(uri));
    }
    const tile = { uri, box: node.boundingVolume.box, error: node.geometricError, leaves: [] };
    tile.bytes = uri ? readFileSync(join(folder, uri)).length : 0;
    tiles.push(tile);
    for (const child of node.children ?? []) tile.leaves.push(...add(child, from).leaves);
    if (!node.children?.length && uri) tile.leaves.push(uri);
    return tile;
  };
  add(JSON.parse(readFileSync(join(folder, 'tileset.json'))).root, '');
  return tiles;
}

const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];
const percent = (v) => `${(100 * v).toFixed(2)} %`;

async function errors(page, tiles, count) {
  const coarse = tiles.filter((t) => t.error > 0 && t.uri && t.leaves.length <= 64);
  const step = Math.max(1, Math.floor(coarse.length / count));
  const all = [];
  for (const tile of coarse.filter((_, i) => i % step === 0).slice(0, count)) {
    const views = await page.evaluate((t) => window.compare(t), tile);
    all.push(...views);
    const mean = (name) => views.reduce((sum, v) => sum + v[name], 0) / views.length;
    console.log(
      `  ${tile.uri}: error ${tile.error.toFixed(2)} m, seen from ${views[0].distance.toFixed(0)} m; ` +
        `coarse to full: median ${mean('median').toFixed(1)} px, 99 of 100 within ` +
        `${mean('most').toFixed(1)} px, beyond 16 px ${percent(mean('beyond'))}; full to coarse: beyond 16 px ` +
        `${percent(mean('lost'))}; colour ${mean('color').toFixed(1)} of 255`,
    );
  }
  const middle = (name) => median(all.map((v) => v[name]));
  const worst = (name) => Math.max(...all.map((v) => v[name]));
  for (const name of ['median', 'most', 'beyond', 'lost', 'color', 'outline'])
    console.log(`${name}: median ${middle(name).toFixed(4)}, worst ${worst(name).toFixed(4)}`);
}

/** The tasks of a page's main thread in a trace, in milliseconds of the processor. */
async function tasksDuring(page, work) {
  const session = await page.context().newCDPSession(page);
  const events = [];
  session.on('Tracing.dataCollected', (e) => events.push(...e.value));
  const ended = new Promise((resolve) => session.once('Tracing.tracingComplete', resolve));
  await session.send('Tracing.start', {
    transferMode: 'ReportEvents',
    categories: '__metadata,toplevel,disabled-by-default-devtools.timeline,devtools.timeline',
  });
  await work();
  await session.send('Tracing.end');
  await ended;
  await session.detach();
  const threads = new Set(
    events
      .filter((e) => e.name === 'thread_name' && e.args.name === 'CrRendererMain')
      .map((e) => `${e.pid} ${e.tid}`),
  );
  return events
    .filter((e) => e.ph === 'X' && e.name === 'RunTask' && threads.has(`${e.pid} ${e.tid}`))
    .map((e) => (e.tdur ?? e.dur) / 1000);
}

async function times(page, tiles, count) {
  const number = new Map(tiles.map((t, i) => [t, i]));
  const largest = tiles.filter((t) => t.uri).sort((a, b) => b.bytes - a.bytes);
  const sums = [];
  const longest = [];
  // The first two warm the page up, and stay, as with them the programs for their materials stay.
  for (const [i, tile] of [
    largest[0],
    largest[1] ?? largest[0],
    ...largest.slice(0, count),
  ].entries()) {
    const idle = await tasksDuring(page, () => page.evaluate(() => window.frames(8)));
    let shown;
    const tasks = await tasksDuring(page, async () => {
      shown = await page.evaluate((url) => window.load(url), `/alone/${number.get(tile)}.json`);
    });
    if (i < 2) continue;
    await page.evaluate(() => window.unload());
    const frame = idle.reduce((a, b) => a + b, 0) / 8;
    const sum = tasks.reduce((a, b) => a + b, 0) - frame * shown.frames;
    sums.push(sum);
    longest.push(Math.max(...tasks));
    console.log(
      `  ${tile.uri}: ${(tile.bytes / 2 ** 20).toFixed(2)} MiB, ${shown.triangles} triangles: ` +
        `${sum.toFixed(1)} ms, longest task ${longest.at(-1).toFixed(1)} ms`,
    );
  }
  console.log(
    `main thread: a tile ${median([...sums]).toFixed(1)} ms (median), ${Math.max(...sums).toFixed(1)} ms (worst); ` +
      `longest task ${Math.max(...longest).toFixed(1)} ms`,
  );
  return Math.max(...longest) <= MOST_MS;
}

if (!hasBrowser()) process.exit(77);
const [folder, given] = process.argv.slice(2);
const tiles = tilesOf(folder);
const server = await serveTiles(folder, tiles);
const browser = await launch();
let held = true;
try {
  const { page, complaints } = await openPage(
    browser,
    `http://127.0.0.1:${server.address().port}/`,
  );
  await page.waitForFunction(() => window.compare !== undefined, null, { timeout: 20_000 });
  held = await times(page, tiles, Number(given ?? 8));
  await errors(page, tiles, Number(given ?? 8));
  for (const c of complaints) if (!c.includes('versions at 1.1')) console.error(c);
} finally {
  await browser.close();
  server.close();
}
process.exit(held ? 0 : 1);
