// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rows of the compatibility tables that need an interface, each a journey named after its row.

import assert from 'node:assert/strict';
import { caretBehind, drawn, ready, status, untilDrawn, viewPixels } from '../studio.mjs';

const shapesOf = async (page) =>
  Number(/([\d\s\u2009\u202f]+) shapes/.exec(await status(page))[1].replace(/\D/g, ''));

export default {
  /** A ProGen3d grammar: edit, run, view. */
  async R26_progen3dIsEditedRunAndSeen({ page }) {
    await ready(page);
    await page.keyboard.press('Alt+4');
    await page.waitForSelector('.gc');
    await page
      .getByRole('button', { name: /Old town/ })
      .first()
      .click();
    await page.waitForSelector('text=progen3d.grammar', { timeout: 60_000 });
    await ready(page);
    assert.match(await status(page), /ProGen3d/);
    const before = await shapesOf(page);
    const picture = await viewPixels(page, '.stage canvas');
    const count = await drawn(page);
    await caretBehind(page, 'Row 9');
    await page.keyboard.press('Backspace');
    await page.keyboard.type('4');
    await untilDrawn(page, count);
    await page.waitForFunction((n) => {
      const text = document.querySelector('.status')?.textContent ?? '';
      return (
        !/Deriving/.test(text) && Number(/([\d\s]+) shapes/.exec(text)?.[1].replace(/\D/g, '')) < n
      );
    }, before);
    assert.ok(!picture.equals(await viewPixels(page, '.stage canvas')));
  },
};
