// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Looks at the site as it was made: every link leads to something, every picture says what it shows, and in
// a browser pages fit a telephone, words can be read in both themes, the search finds what people ask for,
// and a model turns.
//
//   node check/site.mjs SITE

import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { extname, join, posix, resolve } from 'node:path';
import { chromium } from 'playwright-core';

const site = resolve(process.argv[2] ?? '../build/site');
const kTypes = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.woff2': 'font/woff2',
  '.glb': 'model/gltf-binary',
};
/** What people type, and the page that they should see among the first results. */
const kAsked = [
  ['split', 'docs/reference/operations/split.html'],
  ['divide facade into floors', 'docs/guide/first-rules.html'],
  ['hip roof', 'docs/reference/operations/roof.html'],
  ['install debian', 'docs/guide/installing.html'],
  ['cityengine', 'docs/guide/cityengine.html'],
  ['blender', 'docs/guide/blender.html'],
  ['place from openstreetmap', 'docs/guide/city.html'],
];

function files(folder, prefix = '') {
  return readdirSync(join(folder, prefix)).flatMap((name) => {
    const path = posix.join(prefix, name);
    return statSync(join(folder, path)).isDirectory() ? files(folder, path) : [path];
  });
}

const all = files(site);
const pages = all.filter((path) => path.endsWith('.html'));
const texts = new Map(pages.map((path) => [path, readFileSync(join(site, path), 'utf8')]));

function checkLinks() {
  const wrong = [];
  const names = new Map(
    [...texts].map(([path, text]) => [
      path,
      new Set(Array.from(text.matchAll(/ id="([^"]+)"/g), (m) => m[1])),
    ]),
  );
  for (const [path, text] of texts) {
    for (const [, link] of text.matchAll(/ (?:href|src|data-model|data-script)="([^"]+)"/g)) {
      if (/^[a-z][a-z0-9+.-]*:/i.test(link)) continue;
      const [target, anchor] = link.split('#');
      const there = target ? posix.join(posix.dirname(path), decodeURIComponent(target)) : path;
      if (!existsSync(join(site, there))) wrong.push(`${path}: ${link} leads to nothing`);
      else if (anchor && !names.get(there)?.has(decodeURIComponent(anchor)))
        wrong.push(`${path}: ${link} names no heading`);
    }
    for (const [picture] of text.matchAll(/<img [^>]*>/g)) {
      if (!/ alt="/.test(picture)) wrong.push(`${path}: ${picture} says nothing`);
    }
    if ((text.match(/<h1/g) ?? []).length !== 1) wrong.push(`${path}: it has not one title`);
  }
  assert.deepEqual(wrong, []);
}

function serve() {
  const server = createServer((request, response) => {
    const path =
      decodeURIComponent(new URL(request.url, 'http://site').pathname).slice(1) || 'index.html';
    const known = all.includes(path);
    response.writeHead(known ? 200 : 404, {
      'content-type': kTypes[extname(path)] ?? 'text/plain',
    });
    response.end(known ? readFileSync(join(site, path)) : 'not there');
  });
  return new Promise((done) => server.listen(0, '127.0.0.1', () => done(server)));
}

/** Every page fits a telephone: nothing reaches beyond its edge. */
async function checkPhone(browser, home) {
  const page = await browser.newPage({ viewport: { width: 390, height: 800 } });
  const wide = [];
  for (const path of pages) {
    await page.goto(home + path, { waitUntil: 'domcontentloaded' });
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    if (width > 390) wide.push(`${path}: ${width}`);
  }
  assert.deepEqual(wide, []);
  await page.goto(`${home}docs/guide/first-rules.html`);
  const menu = page.locator('#menu');
  assert.equal(await menu.isVisible(), false);
  await page.click('.menu-button');
  assert.equal(await menu.isVisible(), true);
  await page.close();
}

/** Contrast of all words by WCAG AA: 4.5 to 1, and 3 to 1 where they are large. */
function faintWords() {
  const channel = (value) => {
    const share = value / 255;
    return share <= 0.03928 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  };
  const numbers = (colour) => colour.match(/[\d.]+/g).map(Number);
  const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
  const behind = (element) => {
    for (let each = element; each; each = each.parentElement) {
      const colour = numbers(getComputedStyle(each).backgroundColor);
      if (colour.length < 4 || colour[3] > 0.99) return colour;
    }
    return [255, 255, 255];
  };
  const found = new Set();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (!node.data.trim() || !element.offsetParent || element.closest('script, .skip')) continue;
    const style = getComputedStyle(element);
    const pair = [light(numbers(style.color)), light(behind(element))].sort((a, b) => b - a);
    const ratio = (pair[0] + 0.05) / (pair[1] + 0.05);
    const size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    if (ratio < (large ? 3 : 4.5))
      found.add(`${node.data.trim().slice(0, 30)}: ${ratio.toFixed(2)}`);
  }
  return [...found];
}

async function checkContrast(browser, home) {
  for (const colorScheme of ['light', 'dark']) {
    const page = await browser.newPage({ colorScheme, viewport: { width: 1400, height: 900 } });
    for (const path of pages) {
      await page.goto(home + path, { waitUntil: 'domcontentloaded' });
      assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), colorScheme);
      assert.deepEqual(await page.evaluate(faintWords), [], `${path} in ${colorScheme}`);
    }
    await page.close();
  }
}

async function checkSearch(browser, home) {
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
  for (const [query, wanted] of kAsked) {
    await page.goto(`${home}docs/design/life-of-a-rule.html`);
    await page.keyboard.press('/');
    await page.keyboard.type(query);
    const row = page.locator('#found [role=option] a');
    await row.first().waitFor();
    const first = await row.evaluateAll((links) =>
      links.slice(0, 5).map((link) => link.pathname.slice(1)),
    );
    assert.ok(first.includes(wanted), `${query}: ${first.join(', ')}`);
  }
  // The keyboard alone opens what was found.
  const before = page.url();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await page.waitForURL((url) => url.href !== before);
  await page.keyboard.press('/');
  await page.keyboard.type('qqqqxxxx');
  await page.locator('#found .nothing').waitFor();
  await page.close();
}

/** The search works on pages that were opened from a disk, too. */
async function checkDisk(browser) {
  const page = await browser.newPage();
  await page.goto(`file://${site}/index.html`);
  await page.fill('#search', 'split');
  await page.locator('#found [role=option]').first().waitFor();
  await page.close();
}

async function checkModel(browser, home) {
  const path = pages.find((each) => texts.get(each).includes('data-model='));
  if (!path) return 'no models';
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
  await page.goto(home + path);
  await page.click('.turn button');
  const canvas = page.locator('.turn canvas');
  await canvas.waitFor();
  await page.waitForTimeout(500);
  const before = await canvas.screenshot();
  const box = await canvas.boundingBox();
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 420, box.y + 230, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(300);
  const after = await canvas.screenshot();
  // A picture of one colour is a few kilobytes at most.
  assert.ok(before.length > 20_000, `the model is not seen: ${before.length} bytes`);
  assert.ok(!before.equals(after), 'the model does not turn');
  await page.close();
  return path;
}

checkLinks();
console.log(`${pages.length} pages: links, anchors and pictures hold`);
const server = await serve();
const home = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=gl-egl', '--ignore-gpu-blocklist'],
});
try {
  await checkPhone(browser, home);
  console.log('all pages fit 390 pixels');
  await checkContrast(browser, home);
  console.log('all pages have contrast in both themes');
  await checkSearch(browser, home);
  await checkDisk(browser);
  console.log(`${kAsked.length} questions are answered`);
  console.log(`model: ${await checkModel(browser, home)}`);
} finally {
  await browser.close();
  server.close();
}
