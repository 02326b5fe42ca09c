// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What journeys do again and again.

import { code, ready, untilDrawn } from './studio.mjs';

/** Opens a file of the project by the palette; waits for its model. */
export async function openByPalette(page, name) {
  const before = await page.locator('canvas').first().getAttribute('data-drawn');
  await page.keyboard.press('Control+k');
  for (let tries = 0; tries < 12; ++tries) {
    await page.getByRole('combobox', { name: 'Search or run' }).fill(name);
    if (await page.locator('.pal-list [role=option]', { hasText: name }).count()) break;
    await page.waitForTimeout(500);
  }
  await page.locator('.pal-list [role=option]', { hasText: name }).first().click();
  await page.waitForFunction((n) => document.querySelector('.crumb b')?.textContent === n, name);
  await untilDrawn(page, Number(before));
  await ready(page);
}

export async function palette(page, query) {
  await page.keyboard.press('Control+k');
  await page.getByRole('combobox', { name: 'Search or run' }).fill(query);
  await page.waitForSelector('.pal-list [role=option]');
}

export const text = (page) =>
  code(page).evaluate((n) =>
    [...n.querySelectorAll('.cm-line')]
      .map((l) => l.textContent.replace(/× \d+.*$/, ''))
      .join('\n'),
  );
export const form = (page) => page.getByRole('button', { name: 'Form', exact: true }).click();
export const asText = (page) => page.getByRole('button', { name: 'Text', exact: true }).click();
export const toast = (page) => page.locator('.toast').innerText();
