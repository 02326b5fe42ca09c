// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Whole journeys in a browser: those below, and those of journeys/*.mjs, each of which exports an
// object of functions. `node e2e/journeys.mjs [first|STEM...]`: those below, of some files, or all.
// A journey gets { page, folder, server, again, context, pictured }: a page on a project with HOUSE
// in it; its picture is taken at its end, or when it calls pictured(). Ends with 77, which counts
// as skipped, where there is no Chromium. GABLE_SHOTS=FOLDER keeps a picture of each journey's end;
// GABLE_JOURNEY=NAME runs one.

import assert from 'node:assert/strict';
import { mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import {
  CHROMIUM,
  HOUSE,
  caretBehind,
  clean,
  code,
  drawn,
  hasBrowser,
  launch,
  openPage,
  project,
  ready,
  serve,
  status,
  untilDrawn,
  untilRefined,
  viewPixels,
} from './studio.mjs';

if (!hasBrowser()) {
  console.log(`skipped: no Chromium at ${CHROMIUM}; GABLE_CHROMIUM names another`);
  process.exit(77);
}

const shots = process.env.GABLE_SHOTS;
if (shots) mkdirSync(shots, { recursive: true });

const journeys = {
  async opensAndDraws({ page }) {
    await ready(page);
    assert.match(await status(page), /No problems/);
    assert.match(await status(page), /\d shapes/);
    assert.ok((await drawn(page)) > 0);
  },

  async editChangesTheModel({ page }) {
    await ready(page);
    const pixels = () => viewPixels(page);
    const before = await pixels();
    const count = await drawn(page);
    await caretBehind(page, 'attr height = 9');
    await page.keyboard.type('5');
    await untilDrawn(page, count);
    assert.ok(!before.equals(await pixels()));
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '95',
    );
  },

  async aBrokenRuleIsMarkedAndTheModelStays({ page, pictured }) {
    await ready(page);
    await caretBehind(page, 'extrude(height');
    await page.keyboard.press('Delete');
    await page.waitForSelector('.cm-lintRange-error');
    await page.waitForSelector('.banner');
    assert.match(await page.locator('.banner').innerText(), /Last model that worked/);
    assert.match(await status(page), /1 error/);
    assert.ok((await page.locator('.prob').count()) >= 1);
    await pictured();
    await page.keyboard.type(')');
    await page.waitForSelector('.banner', { state: 'detached' });
    assert.match(await status(page), /No problems/);
  },

  async aFaceLeadsToItsRule({ page }) {
    await ready(page);
    const box = await page.locator('canvas').boundingBox();
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.click(...middle);
    await page.waitForSelector('.tr.on');
    assert.match(await page.locator('.tr.on').innerText(), /Lot/);
    await page.mouse.click(...middle);
    await page.waitForFunction(() =>
      /Wall|Roof/.test(document.querySelector('.tr.on')?.textContent ?? ''),
    );
    await page.waitForSelector('.cm-hit');
    assert.match(await page.locator('.cm-hit').innerText(), /(Wall|Roof) -->/);
    await page.getByRole('tab', { name: 'Shape' }).click();
    assert.match(await page.locator('.who').innerText(), /journey\.cga:\d+/);
    await page.keyboard.press('Escape');
    await page.waitForFunction(() =>
      /Lot/.test(document.querySelector('.tr.on')?.textContent ?? ''),
    );
  },

  async anAttributeIsDraggedTypedAndReset({ page }) {
    await ready(page);
    const field = page.locator('#attr-height');
    const box = await field.boundingBox();
    const count = await drawn(page);
    await page.mouse.move(box.x + 40, box.y + 10);
    await page.mouse.down();
    await page.mouse.move(box.x + 90, box.y + 10, { steps: 5 });
    await page.mouse.up();
    await untilDrawn(page, count);
    const dragged = Number(await field.getAttribute('aria-valuenow'));
    assert.ok(dragged > 12 && dragged < 20, String(dragged));
    await field.press('Enter');
    await page.keyboard.type('3*7');
    await page.keyboard.press('Enter');
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '21',
    );
    await page.getByRole('button', { name: 'Reset height' }).click();
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '9',
    );
    await page.getByRole('button', { name: 'Undo', exact: true }).click();
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '21',
    );
    await page.locator('#attr-paint').selectOption('blue');
    await page.waitForFunction(() =>
      /2 changed/.test(document.querySelector('.sec h3')?.textContent ?? ''),
    );
  },

  async completionAndHoverKnowTheOperations({ page }) {
    await ready(page);
    await caretBehind(page, 'extrude(height)');
    await page.keyboard.press('Enter');
    await page.keyboard.type('roofH');
    await page.waitForSelector('.cm-tooltip-autocomplete');
    assert.match(await page.locator('.cm-tooltip-autocomplete').innerText(), /roofHip/);
    await page.keyboard.press('Escape');
    for (let i = 0; i < 6; ++i) await page.keyboard.press('Backspace');
    await page.getByText('extrude', { exact: true }).first().hover();
    await page.waitForSelector('.hover-card');
    assert.match(await page.locator('.hover-card').innerText(), /extrude\(/);
  },

  async savesAndKeepsWhatWasBefore({ page, folder }) {
    await ready(page);
    await caretBehind(page, 'attr height = 9');
    await page.keyboard.type('.5');
    await page.waitForSelector('.crumb .dirty');
    await page.keyboard.press('Control+s');
    await page.waitForSelector('.crumb .dirty', { state: 'detached' });
    assert.match(readFileSync(join(folder, 'journey.cga'), 'utf8'), /height = 9\.5/);
    assert.equal(readFileSync(join(folder, '.gable/previous/journey.cga'), 'utf8'), HOUSE);
  },

  async nothingIsLostWhenTheServerDies({ page, folder, server, again }) {
    await ready(page);
    await caretBehind(page, 'attr height = 9');
    await page.keyboard.type('.25');
    await page.waitForTimeout(700);
    await server.stop();
    await page.keyboard.type('1');
    await page.waitForSelector('text=Not connected', { timeout: 15_000 });
    assert.match(await code(page).innerText(), /height = 9\.251/);
    const next = await again();
    const second = await openPage(page.context().browser(), next.url);
    await ready(second.page);
    assert.match(await code(second.page).innerText(), /height = 9\.25/);
    assert.equal(readFileSync(join(folder, 'journey.cga'), 'utf8'), HOUSE);
    await second.context.close();
    return { complaintsExpected: true };
  },

  async twoPagesDoNotLoseEachOthersEdits({ page, server, folder }) {
    await ready(page);
    const other = await openPage(page.context().browser(), server.url);
    await ready(other.page);
    const text = (p) => p.locator('.cm-content').innerText();
    // Edits of different lines are joined, on both pages and in the file.
    await caretBehind(page, 'Roof -->');
    await page.keyboard.type(' // flat');
    await caretBehind(other.page, 'attr height = 9');
    await other.page.keyboard.type('7');
    await other.page.keyboard.press('Control+s');
    await other.page.waitForSelector('.crumb .dirty', { state: 'detached' });
    await page.waitForFunction(
      () => /height = 97/.test(document.querySelector('.cm-content')?.innerText ?? ''),
      null,
      { timeout: 15_000 },
    );
    assert.match(await text(page), /Roof --> \/\/ flat/);
    assert.equal(await page.locator('.conflict').count(), 0);
    await page.keyboard.press('Control+s');
    await page.waitForSelector('.crumb .dirty', { state: 'detached' });
    assert.match(
      readFileSync(join(folder, 'journey.cga'), 'utf8'),
      /height = 97[^]*Roof --> \/\/ flat/,
    );
    await other.page.waitForFunction(
      () => /flat/.test(document.querySelector('.cm-content')?.innerText ?? ''),
      null,
      { timeout: 15_000 },
    );
    // Edits of one line are a question.
    await caretBehind(page, 'attr height = 97');
    await page.keyboard.type('.5');
    await caretBehind(other.page, 'attr height = 97');
    await other.page.keyboard.type('.25');
    await other.page.keyboard.press('Control+s');
    await page.waitForSelector('.conflict', { timeout: 15_000 });
    assert.match(await text(page), /height = 97\.5/);
    await page.getByRole('button', { name: 'Take theirs' }).click();
    await page.waitForFunction(() =>
      /height = 97\.25/.test(document.querySelector('.cm-content')?.innerText ?? ''),
    );
    assert.deepEqual(
      other.complaints.filter((c) => !/409/.test(c)),
      [],
    );
    await other.context.close();
  },

  async exportsAModelThatOthersRead({ page, folder }) {
    await ready(page);
    await page.getByRole('button', { name: 'Export' }).click();
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('menuitem', { name: '.glb' }).click(),
    ]);
    const file = join(folder, 'model.glb');
    await download.saveAs(file);
    const bytes = readFileSync(file);
    assert.equal(bytes.toString('latin1', 0, 4), 'glTF');
    assert.equal(bytes.readUInt32LE(8), statSync(file).size);
  },

  async theGalleryOpensACopy({ page, folder }) {
    await ready(page);
    await page.keyboard.press('Alt+4');
    await page.waitForSelector('.gc img');
    await page
      .getByRole('button', { name: /^Tower/ })
      .first()
      .click();
    await page.waitForSelector('text=tower.cga', { timeout: 60_000 });
    await ready(page);
    assert.ok(statSync(join(folder, 'tower/tower.cga')).size > 100);
  },

  async worksInTheLight({ page }) {
    await ready(page);
    await page.getByRole('button', { name: 'Light or dark' }).click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'light');
    await page.keyboard.press('?');
    assert.match(await page.getByRole('dialog').innerText(), /frame the selection/);
    await page.keyboard.press('Escape');
    await page.waitForSelector('[role=dialog]', { state: 'detached' });
  },
};

const wanted = process.argv.slice(2);
const chosen = wanted.length && !wanted.includes('first') ? {} : { ...journeys };
const more = new URL('journeys/', import.meta.url);
for (const file of readdirSync(more).sort()) {
  const stem = file.replace(/\.mjs$/, '');
  if (stem === file || (wanted.length && !wanted.includes(stem))) continue;
  Object.assign(chosen, (await import(new URL(file, more))).default);
}

async function travel(browser, name) {
  const folder = project();
  writeFileSync(join(folder, 'journey.cga'), HOUSE);
  let server = await serve(folder);
  const again = async () => (server = await serve(folder));
  let opened;
  let taken = false;
  /** The picture of a journey, where its end is not what it is about. */
  const pictured = async (page = opened.page) => {
    if (!shots || taken) return;
    taken = true;
    await untilRefined(page, 30_000).catch(() => undefined);
    await page.screenshot({ path: join(shots, `${name}.png`) }).catch(() => undefined);
  };
  try {
    opened = await openPage(browser, server.url);
    const { page, context, complaints } = opened;
    const outcome = await chosen[name]({ page, folder, server, again, context, pictured });
    if (!outcome?.complaintsExpected) assert.deepEqual(complaints, []);
    return null;
  } catch (error) {
    return error;
  } finally {
    if (opened) await pictured();
    await opened?.context.close();
    await server.stop();
    clean(folder);
  }
}

const only = process.env.GABLE_JOURNEY;
const browser = await launch();
let failed = 0;
for (const name of Object.keys(chosen)) {
  if (only && only !== name) continue;
  const began = Date.now();
  // A machine busy with other things may starve a browser: what fails is tried once more, and told.
  let error = await travel(browser, name);
  if (error) {
    console.log(`again   ${name}: ${String(error).split('\n')[0]}`);
    error = await travel(browser, name);
  }
  console.log(
    `${error ? 'failed' : 'passed'}  ${name}  ${((Date.now() - began) / 1000).toFixed(1)} s`,
  );
  if (error) {
    ++failed;
    console.log(error.stack ?? String(error));
  }
}
await browser.close();
process.exit(failed ? 1 : 0);
