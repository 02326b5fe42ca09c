// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Handles of attributes: dimensions in the view that are dragged, pressed and reached with keys.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openByPalette } from '../hands.mjs';
import { ready } from '../studio.mjs';

const RULES = `@Handle(shape=Mass, axis=y) @Range(min=3, max=15) @Distance attr height = 9
@Handle(shape=Mass, axis=x) @Range(min=4, max=16, stepsize=3) attr width = 10
@Handle(shape=Mass, axis=z, skin=diameterArrow) attr depth = 8
@Handle(shape=Mass, axis=y, align=left) @Range(min=1, max=9, stepsize=1) attr storeys = 3
@Handle(type=toggle, shape=Mass, align=right) attr flat = false
@Handle(type=selector, shape=Mass, align=left) @Enum("brick", "stone") attr kind = "brick"
@Handle(type=angular, shape=Top, reference=center) @Angle attr turn = 20
@Hidden @Handle(shape=Mass) attr secret = 3
@Handle(shape=Nowhere) attr lost = 3
@Handle(shape=Wall) attr wallDepth = 3

@StartRule Lot --> s(width, 0, depth) center(xz) extrude(height) Mass
Mass --> split(y) { ~1 : Floor }*
Floor --> comp(f) { side : Wall(1) | top : Top | all : NIL }
Wall(n) --> color(case kind == "brick" : "#b4674c" else : "#6d8aa3") X.
Top --> case flat : Y. else : rotateScope(0, turn, 0) Z.
`;

async function opened(page, folder, text = RULES) {
  await ready(page);
  writeFileSync(join(folder, 'handled.cga'), text);
  await openByPalette(page, 'handled.cga');
  await page.waitForSelector('[data-handle]');
  // What is hidden is found when the view rests.
  await page.waitForTimeout(400);
}

const knob = (page, name) => page.locator(`[data-handle=${name}]`);
const now = (page, name) => knob(page, name).getAttribute('aria-valuenow').then(Number);
const field = (page, name) =>
  page.locator(`#attr-${name}`).getAttribute('aria-valuenow').then(Number);
const undo = (page) => page.getByRole('button', { name: 'Undo', exact: true });

async function middle(page, name) {
  const box = await knob(page, name).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}

/** Presses a knob and moves it, slowly; lets it go unless told otherwise. */
async function drag(page, name, by, { up = true, pause = 30 } = {}) {
  const [x, y] = await middle(page, name);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (const share of [0.3, 0.6, 1]) {
    await page.mouse.move(x + by[0] * share, y + by[1] * share, { steps: 3 });
    await page.waitForTimeout(pause);
  }
  if (up) await page.mouse.up();
}

export default {
  /** A dimension is dragged: value, field, model and knob go together, in one step of undo. */
  async aHandleIsDragged({ page, folder, pictured }) {
    await opened(page, folder);
    const before = await middle(page, 'height');
    await drag(page, 'height', [0, -60], { pause: 600 });
    const dragged = await now(page, 'height');
    assert.ok(dragged > 9.5 && dragged < 20, String(dragged));
    assert.equal(await field(page, 'height'), dragged);
    assert.match(await knob(page, 'height').getAttribute('aria-valuetext'), /^[\d.]+\u2009m$/);
    await pictured();
    // The knob is where it was let go.
    const after = await middle(page, 'height');
    assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1] + 60) < 12, String(after));
    await undo(page).click();
    assert.equal(await now(page, 'height'), 9);
    assert.ok(await undo(page).isDisabled(), 'one step');
  },

  /** A drag ends at the range, and on its steps; Esc gives it up. */
  async aHandleKeepsToItsRange({ page, folder }) {
    await opened(page, folder);
    await drag(page, 'height', [0, -330]);
    assert.equal(await now(page, 'height'), 15);
    await undo(page).click();
    await page.waitForTimeout(700);
    await drag(page, 'width', [-110, -40], { up: false });
    const narrow = await now(page, 'width');
    assert.ok(narrow === 7 || narrow === 4, String(narrow));
    assert.equal(await field(page, 'width'), narrow);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    assert.equal(await now(page, 'width'), 10);
    assert.ok(await undo(page).isDisabled(), 'nothing is left of it');
  },

  /** What is no length grows with one; both ends of a diameter move. */
  async handlesOfNumbersAndDiameters({ page, folder }) {
    await opened(page, folder);
    assert.match(await knob(page, 'storeys').getAttribute('aria-valuetext'), /^3 \(9\u2009m\)$/);
    const from = await middle(page, 'storeys');
    const foot = await middle(page, 'height');
    await drag(page, 'storeys', [0, -90]);
    const storeys = await now(page, 'storeys');
    assert.ok(Number.isInteger(storeys) && storeys > 3 && storeys <= 9, String(storeys));
    assert.ok(from[0] < foot[0], 'it stands at the left');
    const depth = await now(page, 'depth');
    await drag(page, 'depth', [-30, 12]);
    assert.notEqual(await now(page, 'depth'), depth);
  },

  /** Switches, choices and circles. */
  async handlesAreSwitchedChosenAndTurned({ page, folder, pictured }) {
    await opened(page, folder);
    await drag(page, 'turn', [34, 40]);
    assert.notEqual(await field(page, 'turn'), 20);
    await knob(page, 'kind').selectOption('stone');
    assert.equal(await page.locator('#attr-kind').inputValue(), 'stone');
    await pictured();
    await knob(page, 'flat').click();
    assert.equal(await page.locator('#attr-flat').getAttribute('aria-checked'), 'true');
    await undo(page).click();
    assert.equal(await knob(page, 'flat').getAttribute('aria-checked'), 'false');
  },

  /** Hidden attributes, rules that made nothing and rules of other parameters have no handle. */
  async onlyWhatIsThereHasAHandle({ page, folder }) {
    await opened(page, folder);
    for (const name of ['secret', 'lost', 'wallDepth'])
      assert.equal(await knob(page, name).count(), 0, name);
    assert.equal(await knob(page, 'height').count(), 1);
    await page.locator('.stage canvas').press('h');
    assert.equal(await page.locator('[data-handle]').count(), 0);
    await page.getByRole('button', { name: 'Handles', exact: true }).click();
    await page.waitForSelector('[data-handle]');
    await page.locator('.stage canvas').press('m');
    assert.equal(await page.locator('[data-handle]').count(), 0, 'another tool has the view');
    await page.locator('.stage canvas').press('v');
    // Far away they would be smaller than a hand.
    await page.waitForSelector('[data-handle]');
    for (let i = 0; i < 60; ++i) await page.locator('.stage canvas').press('-');
    await page.waitForFunction(() => !document.querySelector('[data-handle=height]'));
  },

  /** Handles are reached and moved with keys, and say what they are. */
  async handlesAreReachedWithKeys({ page, folder }) {
    await opened(page, folder);
    const handle = page.getByRole('slider', { name: 'height, in the view' });
    await handle.focus();
    await page.keyboard.press('ArrowUp');
    assert.equal(await now(page, 'height'), 9.1);
    await page.keyboard.press('End');
    assert.equal(await now(page, 'height'), 15);
    await page.keyboard.press('Home');
    assert.equal(await handle.getAttribute('aria-valuetext'), '3\u2009m');
    assert.ok(await page.locator('.fld.handled', { hasText: 'height' }).count(), 'its field');
    await page.keyboard.press('Enter');
    assert.equal(await page.evaluate(() => document.activeElement?.id), 'attr-height');
    await knob(page, 'flat').focus();
    await page.keyboard.press('Space');
    assert.equal(await knob(page, 'flat').getAttribute('aria-checked'), 'true');
  },
};
