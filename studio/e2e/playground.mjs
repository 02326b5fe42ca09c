// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node e2e/playground.mjs FOLDER PICTURES: the playground in a browser, from a server of files and
// nothing else. An example opens by its address and is derived in under two seconds; a change goes
// into the address, and another page that opens it shows the same. Mistakes, rules without an end
// and rules that are too large are told of, and the page goes on.

import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { code, launch, openPage, ready, status, untilRefined } from './studio.mjs';

const [folder, pictures] = process.argv.slice(2);
const MOST_MS = 2000;
const TYPES = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.wasm': 'application/wasm',
};

const server = createServer((request, response) => {
  // Below a folder, as on a site.
  const path = normalize(new URL(request.url, 'http://x').pathname).replace(/^\/try\//, '/');
  readFile(join(folder, path.endsWith('/') ? `${path}index.html` : path)).then(
    (bytes) => {
      response.setHeader('Content-Type', TYPES[extname(path || '.html')] ?? 'text/html');
      response.end(bytes);
    },
    () => response.writeHead(404).end(),
  );
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
const address = `http://127.0.0.1:${server.address().port}/try/`;
const browser = await launch();

/** Needs some gigabytes. */
const TOO_MUCH = `Lot --> extrude(9) split(x) { 0.01 : A }*
A --> split(z) { 0.02 : B }*
B --> s('rand(0.5, 1), '1, '1) primitiveSphere(32, 32) Ball.`;

/** Writes other rules in the place of those of the editor. */
async function write(page, rules) {
  await code(page).focus();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText(`${rules}\n`);
}

async function shot(page, name) {
  await untilRefined(page);
  await page.screenshot({ path: join(pictures, `${name}.png`) });
}

try {
  const { page, complaints } = await openPage(browser, `${address}#example=haussmann`);
  await ready(page);
  const ms = Number(/(\d+) ms/.exec(await status(page))?.[1]);
  console.log(`haussmann: ${ms} ms in the worker`);
  assert.ok(ms > 0 && ms < MOST_MS, `the example takes ${ms} ms`);
  await shot(page, 'playground-haussmann');

  // What needs a disk or the program is not offered.
  assert.equal(await page.getByRole('button', { name: 'Save', exact: true }).count(), 0);

  await code(page).focus();
  await page.keyboard.press('Control+Home');
  await page.keyboard.type('// written in a browser\n');
  await page.waitForFunction(() => location.hash.startsWith('#share='));
  const link = page.url();
  console.log(`a changed example: a link of ${link.length} characters`);
  const other = await openPage(browser, link);
  await ready(other.page);
  assert.match(await code(other.page).innerText(), /^\/\/ written in a browser/);

  // A mistake is told, and the model stays.
  await write(other.page, 'Lot --> extrude(9) extrud(3)');
  await other.page.waitForSelector('.status .err');
  await other.page.screenshot({ path: join(pictures, 'playground-mistake.png') });

  // Rules that are too much for a page are told of, those that are long at work are
  // stopped, and the page goes on with others.
  await write(other.page, TOO_MUCH);
  await other.page.getByText('A limit ended').first().waitFor({ timeout: 120_000 });
  await other.page.screenshot({ path: join(pictures, 'playground-memory.png') });
  await write(other.page, TOO_MUCH.replace('0.02', '0.021'));
  await other.page.getByText('stops').waitFor();
  await other.page.keyboard.press('Escape');
  await write(other.page, 'Lot --> extrude(9) comp(f) { side : Wall. | top : Roof. }');
  await other.page.waitForFunction(() =>
    /No problems\s+\d+ ms/.test(document.querySelector('.status').innerText),
  );

  assert.deepEqual(complaints.concat(other.complaints), []);
  console.log('playground: passed');
} finally {
  await browser.close();
  server.close();
}
