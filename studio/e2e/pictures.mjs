// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Makes the pictures of docs/studio: `node e2e/pictures.mjs FOLDER [NAME...]`, then
// tools/shrink_png.py.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import {
  clean,
  launch,
  openPage,
  project,
  ready,
  serve,
  untilDrawn,
  untilRefined,
  drawn,
} from './studio.mjs';

const [folder, ...only] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });

async function open(page, name) {
  const before = await drawn(page);
  await page.keyboard.press('Control+k');
  await page.getByRole('combobox', { name: 'Search or run' }).fill(name);
  await page.locator('.pal-list [role=option]', { hasText: name }).first().click();
  await page.waitForFunction(
    (n) => document.querySelector('.crumb b')?.textContent === n,
    name.split('/').pop(),
  );
  await untilDrawn(page, before);
  await ready(page);
  await page.waitForTimeout(2500);
}

const canvas = (page) => page.locator('.stage canvas');

/** The middle of the view, or a share of it to the right and down. */
async function click(page, right = 0.5, below = 0.5, options = {}) {
  const box = await canvas(page).boundingBox();
  await page.mouse.click(box.x + box.width * right, box.y + box.height * below, options);
}

/** With the sky, and the light of an hour in June. */
async function atHour(page, hour) {
  await page.getByRole('button', { name: 'Sun', exact: true }).click();
  await page.getByLabel('Sky').check();
  await page.getByLabel('By time').check();
  await page.getByLabel('Hour').fill(String(hour));
  await page.waitForTimeout(1500);
}

const pictures = {
  async rules({ page }) {
    await open(page, 'suburb_house/suburb_house.cga');
    await canvas(page).focus();
    for (const key of ['+', '+', 'ArrowDown']) await page.keyboard.press(key);
  },
  async selection({ page }) {
    await open(page, 'haussmann/haussmann.cga');
    await page.getByRole('tab', { name: 'Shape' }).click();
    for (let i = 0; i < 4; ++i) await click(page, 0.42, 0.55);
    await canvas(page).focus();
    for (const key of ['+', '+']) await page.keyboard.press(key);
  },
  async guide({ page }) {
    await open(page, 'suburb_house/suburb_house.cga');
    await page.getByRole('tab', { name: 'Shape' }).click();
    await canvas(page).focus();
    for (const key of ['+', '+', 'g']) await page.keyboard.press(key);
    await page.waitForSelector('.guide .lane');
    await page.waitForTimeout(1500);
    const lane = await page.locator('.guide .lane').boundingBox();
    await page.mouse.click(lane.x + lane.width * 0.4, lane.y + 20);
  },
  async walk({ page }) {
    await open(page, 'rowhouse/rowhouse.cga');
    await canvas(page).focus();
    await page.keyboard.press('3');
    for (let i = 0; i < 3; ++i) await page.keyboard.press('w', { delay: 500 });
  },
  async handles({ page }) {
    await open(page, 'rowhouse/rowhouse.cga');
    await page.waitForSelector('[data-handle]');
  },
  async light({ page }) {
    await open(page, 'tower/tower.cga');
    await page.getByRole('button', { name: 'Light or dark' }).click();
  },
  async evening({ page }) {
    await open(page, 'haussmann/haussmann.cga');
    await atHour(page, 19.75);
  },
  async night({ page }) {
    await open(page, 'haussmann/haussmann.cga');
    await atHour(page, 22);
  },
  async form({ page }) {
    await open(page, 'gbbg/gbbg.gbbg');
    await page.getByRole('button', { name: 'Form', exact: true }).click();
    await page.locator('.rule-list .tr', { hasText: 'RoofBox' }).first().click();
  },
  async lot({ page }) {
    await open(page, 'rowhouse/rowhouse.cga');
    await page.keyboard.press('l');
    await page.waitForSelector('.corner');
  },
  async variations({ page }) {
    await open(page, 'tower/tower.cga');
    await page.keyboard.press('Alt+2');
    await page.waitForFunction(() =>
      /12 of 12 drawn/.test(document.querySelector('.wall-state')?.textContent ?? ''),
    );
  },
  async assets({ page }) {
    await page.keyboard.press('Alt+3');
    await page.locator('.asset', { hasText: 'Balcony.glb' }).first().click();
    await page.waitForSelector('.bench .handle');
  },
  async palette({ page }) {
    await open(page, 'tower/tower.cga');
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox', { name: 'Search or run' }).fill('storeys');
  },
};

const browser = await launch();
for (const name of only.length ? only : Object.keys(pictures)) {
  const place = project('gbbg', 'rowhouse', 'tower', 'suburb_house', 'haussmann');
  const server = await serve(place);
  const { page, context } = await openPage(browser, server.url, {
    viewport: { width: 1440, height: 810 },
  });
  await ready(page);
  await pictures[name]({ page });
  await page.waitForTimeout(500);
  // No ring around what was used last; pages without the view are never refined.
  await page.evaluate(() => document.activeElement?.blur());
  await untilRefined(page, 20_000).catch(() => undefined);
  await page.screenshot({ path: join(folder, `${name}.png`) });
  await context.close();
  await server.stop();
  clean(place);
  console.log(name);
}
await browser.close();
