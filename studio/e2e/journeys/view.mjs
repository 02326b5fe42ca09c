// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The view: ways to move, what it shows, what a picked face tells.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { HOUSE, drawn, gable, ready, untilDrawn, untilRefined, viewPixels } from '../studio.mjs';

const picture = (page) => viewPixels(page, '.stage canvas');

/** Does something to the view and asserts that the picture is another. */
async function changes(page, what, act) {
  const before = await picture(page);
  const count = await drawn(page);
  await act();
  await untilDrawn(page, count);
  assert.ok(!before.equals(await picture(page)), what);
}

/** The colour of the picture's middle at a height from 0, above, to 1, in 0..255. */
function colorAt(page, share) {
  return page.evaluate((y) => {
    const from = document.querySelector('.stage canvas');
    const copy = document.createElement('canvas');
    copy.width = from.width;
    copy.height = from.height;
    const g = copy.getContext('2d');
    g.drawImage(from, 0, 0);
    return [
      ...g.getImageData(Math.floor(from.width / 2), Math.floor((from.height - 1) * y), 1, 1).data,
    ];
  }, share);
}

/**
 * The colours of the largest even areas of the view, how much of it each has, and which pixels are
 * theirs; `at`: the middle colours of such pixels.
 */
async function colours(page, at = null) {
  return page.locator('.stage canvas').evaluate((canvas, at) => {
    const flat = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
    flat.drawImage(canvas, 0, 0);
    const { data, width, height } = flat.getImageData(0, 0, canvas.width, canvas.height);
    const middle = (list) => list.sort((a, b) => a - b)[list.length >> 1];
    if (!at) {
      const areas = new Map();
      const key = (p) => (data[p] << 16) | (data[p + 1] << 8) | data[p + 2];
      for (let p = 4; p + width * 4 < data.length; p += 4) {
        const k = key(p);
        if (key(p - 4) !== k || key(p + 4) !== k || key(p + width * 4) !== k) continue;
        if (!areas.has(k)) areas.set(k, []);
        areas.get(k).push(p);
      }
      const place = (p) => [((p / 4) % width) / width, Math.floor(p / 4 / width) / height];
      at = [...areas.values()].sort((a, b) => b.length - a.length).slice(0, 6);
      at = at.map((all) => all.map(place));
    }
    const seen = at.map((all) => {
      const pixels = all.map(
        ([x, y]) => (Math.round(y * height) * width + Math.round(x * width)) * 4,
      );
      return [0, 1, 2].map((c) => middle(pixels.map((p) => data[p + c])));
    });
    const share = at.map((all) => (all.length / (width * height)).toFixed(3));
    return { at, seen, share };
  }, at);
}

export default {
  /** Row S20: orbit, pan, zoom; sky, ground, pictures a second. */
  async S20_theViewOrbitsPansZoomsUnderASky({ page }) {
    await ready(page);
    const canvas = page.locator('.stage canvas');
    await canvas.focus();
    await changes(page, 'orbit', () => page.keyboard.press('ArrowLeft'));
    await changes(page, 'pan', () => page.keyboard.press('Shift+ArrowUp'));
    await changes(page, 'zoom', () => page.keyboard.press('+'));
    const box = await canvas.boundingBox();
    await changes(page, 'drag', async () => {
      await page.mouse.move(box.x + 200, box.y + 200);
      await page.mouse.down();
      await page.mouse.move(box.x + 260, box.y + 220, { steps: 3 });
      await page.mouse.up();
    });
    const below = await colorAt(page, 0.02);
    await page.getByRole('button', { name: 'Sun' }).click();
    await changes(page, 'sky', () => page.getByLabel('Sky').check());
    const sky = await colorAt(page, 0.02);
    assert.ok(sky[2] > below[2] + 25, `blue above: ${sky} after ${below}`);
    await changes(page, 'frame', () => canvas.press('Shift+F'));
    assert.match(await page.locator('.status').innerText(), /\d+ fps/);
  },

  /**
   * What changes is drawn at once, coarsely where that is slow; what stands still is drawn in full.
   */
  async aPictureIsRefinedWhenNothingMoves({ page }) {
    await ready(page);
    const canvas = page.locator('.stage canvas');
    await untilRefined(page, 240_000);
    await canvas.focus();
    await changes(page, 'turn', () => page.keyboard.press('ArrowLeft'));
    const first = await picture(page);
    await untilRefined(page, 240_000);
    const pixels = await canvas.evaluate((c) => ({
      width: c.width,
      height: c.height,
      wide: c.clientWidth,
      high: c.clientHeight,
    }));
    assert.ok(pixels.width >= pixels.wide && pixels.height >= pixels.high, JSON.stringify(pixels));
    assert.ok(!first.equals(await picture(page)), 'the first picture is finer later');
  },

  /** What lies in the sun or in even shade looks the same before and after; only corners darken. */
  async refiningKeepsColours({ page, folder }) {
    await ready(page);
    const canvas = page.locator('.stage canvas');
    // Plaster that is as bright as paper in the sun.
    const before = await drawn(page);
    writeFileSync(join(folder, 'journey.cga'), HOUSE.replace('#b4674c', '#efdcc0'));
    await untilDrawn(page, before);
    await untilRefined(page, 240_000);
    await canvas.focus();
    await changes(page, 'turn', () => page.keyboard.press('ArrowLeft'));
    const first = await colours(page);
    await untilRefined(page, 240_000);
    const then = await colours(page, first.at);
    const told = first.seen.map((c, i) => `${c} -> ${then.seen[i]}: ${first.share[i]}`).join('; ');
    const sum = (c) => c[0] + c[1] + c[2];
    let even = 0;
    let bright = 0;
    first.seen.forEach((was, i) => {
      // The cast shadow is darker where the sky is hidden as well.
      if (sum(was) < 140 || first.share[i] < 0.01) return;
      even += 1;
      if (was[0] > 225) bright += 1;
      for (const c of [0, 1, 2]) assert.ok(Math.abs(was[c] - then.seen[i][c]) <= 4, told);
    });
    assert.ok(even >= 4 && bright >= 1, told);
  },

  /** Row C15: shaded and wireframe, next seed. */
  async C15_theViewShowsWiresAndScopes({ page, pictured }) {
    await ready(page);
    const canvas = page.locator('.stage canvas');
    await canvas.focus();
    await changes(page, 'wireframe', () => page.keyboard.press('w'));
    await changes(page, 'shaded', () => page.keyboard.press('w'));
    await page.locator('.tree .tr').first().click();
    await canvas.focus();
    await changes(page, 'scopes below', () => page.keyboard.press('s'));
    await pictured();
    await changes(page, 'no scopes', () => page.keyboard.press('s'));
    const seed = await page.locator('#seed').getAttribute('aria-valuenow');
    await page.keyboard.press('r');
    await page.waitForFunction(
      (old) => document.querySelector('#seed')?.getAttribute('aria-valuenow') !== old,
      seed,
    );
  },

  async onePlaceIsWalkedAndFlown({ page, pictured }) {
    await ready(page);
    const canvas = page.locator('.stage canvas');
    await canvas.focus();
    await changes(page, 'walk', () => page.keyboard.press('3'));
    assert.equal(
      await page.getByRole('radio', { name: 'walk' }).getAttribute('aria-checked'),
      'true',
    );
    // At eye height the horizon is in the middle: sky above, ground below.
    const [up, down] = [await colorAt(page, 0.1), await colorAt(page, 0.95)];
    assert.ok(up[2] > down[2] + 20, `${up} above ${down}`);
    await changes(page, 'ahead', () => page.keyboard.press('w', { delay: 300 }));
    await changes(page, 'turn', () => page.keyboard.press('ArrowLeft', { delay: 300 }));
    await pictured();
    await changes(page, 'fly', async () => {
      await page.keyboard.press('2');
      await page.keyboard.press('e', { delay: 300 });
    });
    await changes(page, 'orbit', async () => {
      await page.keyboard.press('1');
      await page.keyboard.press('Shift+F');
    });
  },

  async aLeafTellsItsMaterialAndPlace({ page }) {
    await ready(page);
    const box = await page.locator('.stage canvas').boundingBox();
    await page.getByRole('tab', { name: 'Shape' }).click();
    await page.keyboard.down('Control');
    await page.mouse.click(box.x + box.width * 0.3, box.y + box.height * 0.68);
    await page.keyboard.up('Control');
    await page.waitForFunction(() =>
      /Material/.test(document.querySelector('aside .scroll')?.textContent ?? ''),
    );
    const said = await page.locator('aside .scroll').innerText();
    assert.match(said, /#b4674c/);
    assert.match(said, /journey\.cga:\d+/);
    assert.match(await page.locator('.path').innerText(), /Lot[^]*Wall[^]*Face/);
  },

  /** Corner to corner with the pointer, then with keys alone. */
  async lengthsAreMeasured({ page }) {
    await ready(page);
    await untilRefined(page, 240_000);
    const canvas = page.locator('.stage canvas');
    const box = await canvas.boundingBox();
    // The nearest upright edge of the house is 9 m, whatever the camera: its ends are found by
    // their snapping.
    await canvas.focus();
    await page.keyboard.press('m');
    await page.waitForSelector('.lot-help');
    const snaps = async (y) => {
      await page.mouse.move(box.x + box.width * 0.5, box.y + y);
      await page.waitForTimeout(120);
      return (await page.locator('.cursor.hit').count()) > 0;
    };
    const found = [];
    for (let y = box.height * 0.1; y < box.height; y += 9) {
      if (!(await snaps(y))) continue;
      const at = await page
        .locator('.cursor.hit')
        .evaluate((c) => [c.cx.baseVal.value, c.cy.baseVal.value]);
      if (!found.some((f) => Math.hypot(f[0] - at[0], f[1] - at[1]) < 3)) found.push(at);
    }
    assert.ok(found.length >= 2, `${found.length} corners`);
    for (const [x, y] of [found[0], found.at(-1)]) await page.mouse.click(box.x + x, box.y + y);
    assert.match(await page.locator('.dimtag').innerText(), /^[\d.]+ m$/);
    assert.match(await page.locator('.lot-help').innerText(), /m across, .* m (up|down), .*°/);
    await page.keyboard.press('Escape');
    await page.waitForSelector('.dimtag', { state: 'detached' });
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
    for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.dimtag');
    // Last, the picture: an edge of the house.
    await page.keyboard.press('Escape');
    for (const [x, y] of [found.at(-2), found.at(-1)]) await page.mouse.click(box.x + x, box.y + y);
    assert.match(await page.locator('.dimtag').innerText(), /^9 m$/);
  },

  /** The sun of a day, an hour and a place; at night it is dark. */
  async theSunStandsWhereItDoesAtAnHour({ page }) {
    await ready(page);
    await page.getByRole('button', { name: 'Sun', exact: true }).click();
    const card = page.locator('.sun-card');
    await card.getByLabel('Sky').check();
    await card.getByLabel('By time').check();
    // A lot lies on no map.
    await page.waitForFunction(
      () => document.querySelector('[placeholder="that of the map"]')?.value,
    );
    await card.getByLabel('Place').fill('50, 8');
    /** The height of the sun comes to lie between two at an hour. */
    const stands = async (hour, low, high) => {
      await card.getByLabel('Hour').fill(String(hour));
      await page.waitForFunction(
        ([least, most]) => {
          const height = Number(document.querySelector('.sun-card input')?.value);
          return height >= least && height <= most;
        },
        [low, high],
      );
    };
    // Noon of the longest day.
    await stands(12, 62, 65);
    await page.waitForTimeout(1500);
    const day = await colorAt(page, 0.02);
    await stands(0, -18, -10);
    await page.waitForTimeout(1500);
    const night = await colorAt(page, 0.02);
    assert.ok(night[2] < day[2] / 2, `the sky is dark: ${night} after ${day}`);
    await card.getByLabel('Place').fill('here');
    await page.getByText('Write latitude and longitude').waitFor();
    await card.getByLabel('Turn').press('ArrowRight');
    assert.ok(!(await card.getByLabel('By time').isChecked()), 'a hand takes over');
  },

  /** Stops of a camera path are taken, played and saved for gable render. */
  async aCameraPathIsTakenPlayedAndSaved({ page, folder }) {
    await ready(page);
    await page.getByRole('button', { name: 'Camera path' }).click();
    const canvas = page.locator('.stage canvas');
    for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowUp']) {
      await page.getByRole('button', { name: 'Add this view' }).click();
      await canvas.focus();
      for (let i = 0; i < 3; ++i) await page.keyboard.press(key);
    }
    await page.getByRole('button', { name: 'Leave out stop 3' }).click();
    assert.equal(await page.getByRole('button', { name: /^Stop \d/ }).count(), 2);
    await page.getByLabel('Speed').fill('30');
    await changes(page, 'playing moves the camera', async () => {
      await page.getByRole('button', { name: /^Play/ }).click();
      await page.getByRole('button', { name: /^Play/ }).waitFor();
    });
    await page.getByRole('button', { name: 'Save', exact: true }).last().click();
    await page.getByText(/Saved .*-walk\.json/).waitFor();
    const command = await page.locator('.path-card code').innerText();
    const [, rules, , name] = /gable render (\S+) (.* )?--walk (\S+)/.exec(command);
    assert.match(command, /--lot 20x30 --sun 44,208 /);
    const file = join(folder, name);
    const path = JSON.parse(readFileSync(file, 'utf-8'));
    assert.equal(path.stops.length, 2);
    assert.equal(path.speed, 30);
    const words = ['render', join(folder, rules), '--walk', file, '--size', '64x36'];
    execFileSync(gable, [...words, '--samples', '1', '-o', join(folder, 'walk.png')]);
  },
};
