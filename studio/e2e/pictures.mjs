// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Makes the pictures of docs/studio: `node e2e/pictures.mjs FOLDER [NAME...]`, then tools/shrink_png.py.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { clean, launch, openPage, project, ready, serve, untilDrawn, drawn } from './studio.mjs';

const [folder, ...only] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });

async function open(page, name) {
  const before = await drawn(page);
  await page.keyboard.press('Control+k');
  await page.getByRole('combobox', { name: 'Search or run' }).fill(name);
  await page.locator('.pal-list [role=option]', { hasText: name }).first().click();
  await page.waitForFunction((n) => document.querySelector('.crumb b')?.textContent === n, name.split('/').pop());
  await untilDrawn(page, before);
  await ready(page);
  await page.waitForTimeout(2500);
}

const pictures = {
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
    await page.waitForFunction(() => /12 of 12 drawn/.test(document.querySelector('.wall-state')?.textContent ?? ''));
  },
  async assets({ page }) {
    await page.keyboard.press('Alt+3');
    await page.locator('.asset', { hasText: 'Balcony.glb' }).first().click();
    await page.waitForSelector('.bench .handle');
  },
  async palette({ page }) {
    await open(page, 'tower/tower.cga');
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox', { name: 'Search or run' }).fill('floor');
  },
};

const browser = await launch();
for (const name of only.length ? only : Object.keys(pictures)) {
  const place = project('gbbg', 'rowhouse', 'tower');
  const server = await serve(place);
  const { page, context } = await openPage(browser, server.url, { viewport: { width: 1440, height: 810 } });
  await ready(page);
  await pictures[name]({ page });
  await page.waitForTimeout(5000);
  await page.screenshot({ path: join(folder, `${name}.png`) });
  await context.close();
  await server.stop();
  clean(place);
  console.log(name);
}
await browser.close();
