// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Measures from keystroke to changed picture on one suburb house: `node e2e/latency.mjs [COUNT]`.
// A digit of an attribute's default is typed and removed; the clock runs from the key event in the
// page to the end of the drawing that shows the new model.

import { clean, hasBrowser, launch, openPage, project, serve, untilDrawn, drawn } from './studio.mjs';

if (!hasBrowser()) process.exit(77);
const count = Number(process.argv[2] ?? 40);
const folder = project('suburb_house');
const server = await serve(folder);
const browser = await launch();
const { page } = await openPage(browser, server.url);
await page.waitForSelector('.tree .tr', { timeout: 60_000 });
await page.locator('.cm-content').focus();
await page.keyboard.press('Control+f');
await page.locator('.cm-search input[name=search]').pressSequentially('attr pitch = 34');
await page.keyboard.press('Enter');
await page.keyboard.press('Escape');
await page.keyboard.press('ArrowRight');
await page.evaluate(() => {
  window.times = [];
  let began = 0;
  addEventListener('keydown', () => (began = performance.now()), true);
  const canvas = document.querySelector('canvas');
  new MutationObserver(() => {
    // After the frame that was drawn is finished on the (software) graphics card.
    const gl = canvas.getContext('webgl2');
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    if (began) window.times.push(performance.now() - began);
    began = 0;
  }).observe(canvas, { attributeFilter: ['data-drawn'] });
});
for (let i = 0; i < count; ++i) {
  const before = await drawn(page);
  if (i % 2) await page.keyboard.press('Backspace');
  else await page.keyboard.type('.5');
  if (i % 2) await page.keyboard.press('Backspace');
  await untilDrawn(page, before);
  await page.waitForTimeout(350);
}
const times = (await page.evaluate(() => window.times)).sort((a, b) => a - b);
const at = (share) => times[Math.min(times.length - 1, Math.floor(times.length * share))].toFixed(0);
console.log(`${times.length} keystrokes: median ${at(0.5)} ms, 95th percentile ${at(0.95)} ms, most ${at(1)} ms`);
await browser.close();
await server.stop();
clean(folder);
