// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The derivation guide: steps, ghosts, stops.

import assert from 'node:assert/strict';
import { caretBehind, drawn, ready, untilDrawn, viewPixels } from '../studio.mjs';

const stepOf = async (page) =>
  Number((await page.locator('.guide .step b').innerText()).replace(/\D/g, ''));
const untilStep = (page, n) =>
  page.waitForFunction(
    (want) =>
      Number(document.querySelector('.guide .step b')?.textContent?.replace(/\D/g, '')) === want,
    n,
  );
const picture = (page) => viewPixels(page, '.stage canvas');

async function openGuide(page) {
  await ready(page);
  const before = await drawn(page);
  await page.locator('.stage canvas').focus();
  await page.keyboard.press('g');
  await page.waitForSelector('.guide .lane');
  await page.waitForFunction(() =>
    / of 6/.test(document.querySelector('.guide .step')?.textContent ?? ''),
  );
  await untilDrawn(page, before);
}

/** Plays from the beginning, fast, and waits for the guide to stop at that shape. */
async function playUpTo(page, shape) {
  await page.getByLabel('Speed').selectOption('20');
  await page.locator('.stage canvas').focus();
  await page.keyboard.press('Home');
  await page.keyboard.press('Space');
  await page.waitForFunction(
    (name) => document.querySelector('.tr.on')?.textContent?.includes(name),
    shape,
  );
  await page.waitForSelector('button[aria-label=Play]');
}

export default {
  async theGuideGoesStepByStep({ page, pictured }) {
    await openGuide(page);
    assert.equal(await stepOf(page), 6);
    const whole = await picture(page);
    await page.keyboard.press('Home');
    await untilStep(page, 0);
    await page.waitForSelector('.tr.later');
    await page.keyboard.press('.');
    await untilStep(page, 1);
    // The lot is replaced by four walls and a roof: they show, the selection and the editor are at
    // the lot.
    assert.match(await page.locator('.tr.on').innerText(), /Lot/);
    assert.match(await page.locator('.tag.replaced').innerText(), /replaced: Lot/);
    assert.match(await page.locator('.cm-hit').innerText(), /Lot -->/);
    await page.getByRole('tab', { name: 'Shape' }).click();
    const said = await page.locator('aside .scroll').innerText();
    assert.match(said, /Replaced in this step by 5 shapes/);
    assert.match(said, /What this step changed/);
    assert.match(said, /Wall\s+4/);
    assert.match(
      said,
      /Lot became 5 shapes: 4 × Wall and Roof\. They are faces[^]*9 m along y instead of 0 m/,
    );
    assert.match(said, /Draws\s+None in this step[^]*Values seen\s+height\s+9/);
    const first = await picture(page);
    assert.ok(!whole.equals(first));
    await pictured();
    await page.locator('.stage canvas').focus();
    await page.keyboard.press('.');
    await untilStep(page, 2);
    assert.match(await page.locator('.tr.on').innerText(), /Wall/);
    assert.ok((await page.locator('.tr.was').count()) >= 1);
    await page.keyboard.press(',');
    await untilStep(page, 1);
    await page.keyboard.press('End');
    await untilStep(page, 6);
    await page.keyboard.press('g');
    await page.waitForSelector('.guide .lane', { state: 'detached' });
    await page.waitForSelector('.tree .tr');
  },

  async theGuideTellsWhatWasDrawn({ page }) {
    await ready(page);
    await caretBehind(page, 'Roof -->');
    await page.keyboard.type(' 30% : Flat. else :');
    await page.keyboard.press('Escape');
    await openGuide(page);
    await page.getByRole('tab', { name: 'Shape' }).click();
    await page.locator('.guide .lane').focus();
    const said = page.locator('aside .scroll');
    for (let step = 0; step < 6 && !/gives/.test(await said.innerText()); ++step)
      await page.keyboard.press('ArrowLeft');
    assert.match(
      await said.innerText(),
      /What this step changed[^]*Draws\s+seed 0\s+0\.\d{3} gives (the alternative, 30|else, 70) %/,
    );
    await page.locator('.note').first().click();
    assert.match(await page.locator('.cm-content').innerText(), /30%/);
  },

  async theGuidePlaysUpToAStop({ page }) {
    await openGuide(page);
    await page.getByLabel('Stop on a rule').selectOption('Roof');
    await playUpTo(page, 'Roof');
    const at = await stepOf(page);
    await page.waitForTimeout(300);
    assert.equal(await stepOf(page), at);
    await page.keyboard.press('Home');
    await page.keyboard.press('Shift+Period');
    await untilStep(page, at);
  },

  async aStopIsSetBesideTheText({ page }) {
    await ready(page);
    await caretBehind(page, 'color("#7c8085")');
    await page.keyboard.press('F9');
    await page.waitForSelector('.cm-stop');
    await openGuide(page);
    await playUpTo(page, 'Roof');
    // A click beside the line takes it away, another sets it again.
    await page.locator('.cm-stop').click();
    await page.waitForSelector('.cm-stop', { state: 'detached' });
    const line = await page.locator('.cm-line', { hasText: 'Wall -->' }).boundingBox();
    const gutter = await page.locator('.cm-stop-gutter').boundingBox();
    await page.mouse.click(gutter.x + gutter.width / 2, line.y + line.height / 2);
    await page.waitForSelector('.cm-stop');
  },

  async theGuideIsScrubbedAndStaysWhereItWasWhenTheRulesChange({ page }) {
    await openGuide(page);
    const lane = page.locator('.guide .lane');
    const box = await lane.boundingBox();
    await page.mouse.move(box.x + box.width * 0.1, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 3, box.y + 20, { steps: 4 });
    await page.mouse.up();
    await untilStep(page, 2);
    await lane.focus();
    await page.keyboard.press('ArrowRight');
    await untilStep(page, 3);
    assert.match(await lane.getAttribute('aria-valuetext'), /Step 3 of 6, replaces Wall/);
    // One more rule before: the same wall is two steps later.
    await caretBehind(page, '    extrude(height)');
    await page.keyboard.press('Enter');
    await page.keyboard.type('[ t(0, 20, 0) Roof ]');
    await page.waitForFunction(() =>
      / of 7/.test(document.querySelector('.guide .step')?.textContent ?? ''),
    );
    await untilStep(page, 4);
    assert.match(await page.locator('.tr.on').innerText(), /Wall/);
  },
};
