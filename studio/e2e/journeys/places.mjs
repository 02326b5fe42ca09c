// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lots, shapes, seeds and reports.

import assert from 'node:assert/strict';
import { existsSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openByPalette } from '../hands.mjs';
import { caretBehind, drawn, ready, status, untilDrawn } from '../studio.mjs';

const LOTS = JSON.stringify({
  type: 'FeatureCollection',
  features: ['west', 'middle', 'east'].map((id, i) => {
    const x = 7.42 + i * 0.0004;
    return {
      type: 'Feature',
      id,
      properties: {},
      geometry: {
        type: 'Polygon',
        coordinates: [
          [
            [x, 43.73],
            [x + 0.0002, 43.73],
            [x + 0.0002, 43.7302],
            [x, 43.7302],
            [x, 43.73],
          ],
        ],
      },
    };
  }),
});

/** 3600 houses of 103 shapes, of which one is to be seen. */
const LARGE = `@StartRule
Lot --> split(z) { '0.01666 : Street }*
Street --> split(x) { '0.01666 : House }*
House --> extrude(0.3) [ comp(f) { bottom : Cellar } ] Mass.
Cellar --> split(x) { '0.01 : NIL }*
`;

export default {
  async aLotIsDrawn({ page }) {
    await ready(page);
    await page.keyboard.press('Escape');
    await page
      .locator('canvas')
      .first()
      .click({ position: { x: 300, y: 600 } });
    await page.keyboard.press('l');
    await page.waitForSelector('.corner');
    assert.equal(await page.locator('.corner').count(), 4);
    const box = await page.locator('canvas').first().boundingBox();
    const at = (x, y) => [box.x + box.width * x, box.y + box.height * y];
    for (const [x, y] of [
      [0.3, 0.75],
      [0.72, 0.75],
      [0.68, 0.45],
    ])
      await page.mouse.click(...at(x, y));
    await page.mouse.move(...at(0.35, 0.48));
    await page.waitForSelector('.dimtag');
    assert.match(await page.locator('.lot-help').innerText(), /3 corners, .* m²/);
    await page.mouse.click(...at(0.35, 0.48));
    const count = await drawn(page);
    await page.keyboard.press('Enter');
    await untilDrawn(page, count);
    assert.equal(await page.locator('#shapes').inputValue(), 'drawn');
    assert.equal(await page.locator('.corner').count(), 4);
    // A corner by keys, then a length by typing.
    await page.locator('.corner').first().focus();
    await page.keyboard.press('Shift+ArrowLeft');
    await page.waitForTimeout(900);
  },

  async shapesAreLoadedAndChosen({ page, folder }) {
    await ready(page);
    await page.getByLabel('Load shapes from a file').setInputFiles({
      name: 'some-lots.geojson',
      mimeType: 'application/json',
      buffer: Buffer.from(LOTS),
    });
    await page.waitForFunction(
      () => document.querySelector('#shapes')?.value === 'some-lots.geojson',
    );
    await page.waitForFunction(() => document.querySelectorAll('.tree .tr').length >= 3);
    assert.ok(existsSync(join(folder, 'some-lots.geojson')));
    await page.locator('.choose-shapes').click();
    await page.waitForSelector('.chooser polygon');
    assert.match(await page.locator('.shape-list').innerText(), /west[\s\S]*middle[\s\S]*east/);
    await page.getByLabel(/middle/).check();
    await page.waitForFunction(() =>
      /1 chosen/.test(document.querySelector('.choose-shapes')?.textContent ?? ''),
    );
    await page.waitForFunction(
      () => document.querySelectorAll('.tree .tr[aria-level="1"]').length === 1,
    );
  },

  async aLotKeepsItsSeed({ page, folder }) {
    writeFileSync(join(folder, 'lots.geojson'), LOTS);
    await ready(page);
    await page.waitForFunction(
      () =>
        [...document.querySelectorAll('#shapes option')].some((o) => o.value === 'lots.geojson'),
      null,
      { timeout: 15_000 },
    );
    await page.locator('#shapes').selectOption('lots.geojson');
    await page.waitForFunction(
      () => document.querySelectorAll('.tree .tr[aria-level="1"]').length === 3,
    );
    await page.locator('.tree .tr[aria-level="1"]').nth(1).click();
    await page.getByRole('button', { name: 'Pin the seed of the lot' }).click();
    await page.waitForSelector('[aria-label="Pin the seed of the lot"][aria-pressed=true]');
    const held = await page.locator('#seed').getAttribute('aria-valuenow');
    await page.locator('.head h2').first().click();
    await page.keyboard.press('Shift+R');
    await page.waitForTimeout(1500);
    assert.equal(await page.locator('#seed').getAttribute('aria-valuenow'), held);
    await page.locator('.tree .tr[aria-level="1"]').nth(0).click();
    assert.notEqual(await page.locator('#seed').getAttribute('aria-valuenow'), held);
  },

  async reportsAreATableAndCharts({ page }) {
    await ready(page);
    await caretBehind(page, 'color("#7c8085")');
    await page.keyboard.type(' report("area.roof", geometry.area) report("use", "attic")');
    await caretBehind(page, '"#6d8aa3")');
    await page.keyboard.type(' report("area.wall", geometry.area) report("use", "flat")');
    await page.getByRole('tab', { name: 'Reports' }).click();
    await page.waitForSelector('.stack');
    assert.match(await page.locator('.scroll').last().innerText(), /area\.roof[\s\S]*area\.wall/);
    await page.getByRole('button', { name: 'Table' }).click();
    await page.getByRole('button', { name: 'sum' }).click();
    assert.match(await page.locator('.rep-table tbody tr').first().innerText(), /area\.wall\s+4/);
    await page.getByRole('button', { name: 'Charts' }).click();
  },

  /** A place with more shapes than a tree holds has one that is fetched as it is opened. */
  async aLargePlaceHasATreeByLevel({ page, folder, pictured }) {
    await ready(page);
    writeFileSync(join(folder, 'large.cga'), LARGE);
    await openByPalette(page, 'large.cga');
    const shapes = () =>
      status(page).then((s) =>
        Number(s.replace(/[^]*?([\d\s]+) shapes[^]*/, '$1').replace(/\s/g, '')),
      );
    await page.waitForFunction(() =>
      /[3-9]\d\d\s\d\d\d shapes/.test(document.querySelector('.status')?.textContent ?? ''),
    );
    assert.ok((await shapes()) > 300_000);
    const row = (name) => page.locator('.tree .tr', { hasText: name }).first();
    await row(/Street\s*× 61/).waitFor();
    await row(/Street\s*× 61/)
      .locator('.tw')
      .click();
    await page.waitForFunction(() => document.querySelectorAll('.tree .tr').length > 10);
    await page.locator('.tree .tr[aria-level="2"]').nth(1).locator('.tw').click();
    await row(/House\s*× 61/).waitFor();
    await row(/House\s*× 61/).click();
    await page.waitForFunction(() =>
      /House/.test(document.querySelector('.tree .tr.on')?.textContent ?? ''),
    );
    assert.match(await page.locator('.path').innerText(), /Street[^]*House/);
    // A face leads to its row, and the keys go on from there.
    const box = await page.locator('.stage canvas').boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await page.waitForFunction(() =>
      /Mass/.test(document.querySelector('.tree .tr.on')?.textContent ?? ''),
    );
    assert.equal(await page.locator('.tree .tr.on').count(), 1);
    await pictured();
    await page.locator('.tree').focus();
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction(() =>
      /House/.test(document.querySelector('.tree .tr.on')?.textContent ?? ''),
    );
  },
};
