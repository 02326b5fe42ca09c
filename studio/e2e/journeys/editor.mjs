// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Names, history, palette and the form of rules.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { legible } from './access.mjs';
import { asText, form, palette, text, toast } from '../hands.mjs';
import { caretBehind, code, drawn, openPage, ready, untilDrawn } from '../studio.mjs';

export default {
  /**
   * Two pages have changed the same line: both are shown, and one side of each difference is taken.
   */
  async aConflictIsComparedLineByLine({ page, server, folder, pictured }) {
    await ready(page);
    const other = await openPage(page.context().browser(), server.url);
    await ready(other.page);
    for (const [p, more] of [
      [page, '.5'],
      [other.page, '.25'],
    ]) {
      await caretBehind(p, 'attr height = 9');
      await p.keyboard.type(more);
    }
    await caretBehind(page, 'color("#7c8085")');
    await page.keyboard.type(' // slate');
    await other.page.keyboard.press('Control+s');
    await page.waitForSelector('.conflict', { timeout: 15_000 });
    await page.getByRole('button', { name: 'Compare' }).click();
    const dialog = page.getByRole('dialog', { name: /Compare/ });
    assert.match(await dialog.innerText(), /2 differences[^]*height = 9\.5[^]*height = 9\.25/);
    await dialog.getByRole('radio', { name: 'Take theirs' }).first().click();
    assert.equal(await dialog.locator('code.taken').count(), 2);
    await other.context.close();
    await legible(page, 'comparing');
    await pictured();
    await dialog.getByRole('button', { name: 'Save these' }).click();
    await page.waitForSelector('.crumb .dirty', { state: 'detached' });
    assert.match(readFileSync(join(folder, 'journey.cga'), 'utf8'), /height = 9\.25[^]*\/\/ slate/);
  },

  async aNameIsFoundRenamedAndUndone({ page }) {
    await ready(page);
    await caretBehind(page, 'side : Wa');
    await page.keyboard.press('F12');
    await page.waitForFunction(() =>
      /^Wall/.test(document.querySelector('.cm-activeLine')?.textContent ?? ''),
    );
    await page.keyboard.press('Shift+F12');
    await page.waitForSelector('.uses .prob');
    assert.equal(await page.locator('.uses .prob').count(), 2);
    await page.keyboard.press('Escape');
    await code(page).focus();
    await page.keyboard.press('F2');
    await page.waitForSelector('.rename input');
    await page.keyboard.type('Roof');
    await page.waitForSelector('.rename >> text=already something called Roof');
    await page.keyboard.press('Control+a');
    await page.keyboard.type('Facade');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() =>
      /side : Facade/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    assert.match(await text(page), /\nFacade -->/);
    await page.waitForFunction(() =>
      /No problems/.test(document.querySelector('.status')?.textContent ?? ''),
    );
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() =>
      /side : Wall/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    assert.match(await text(page), /\nWall -->/);
  },

  async oneHistoryHoldsTextAndValues({ page, server }) {
    await ready(page);
    await caretBehind(page, 'attr height = 9');
    await page.keyboard.type('5');
    await page.locator('#attr-paint').selectOption('blue');
    await page.waitForTimeout(700);
    await page.getByRole('button', { name: 'Undo', exact: true }).first().click();
    await page.waitForFunction(() => document.querySelector('#attr-paint')?.value === 'red');
    assert.match(await toast(page), /Undid: paint/);
    await page.getByRole('button', { name: 'Undo', exact: true }).first().click();
    await page.waitForFunction(() =>
      /height = 9\n?@/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await page.getByRole('button', { name: 'Redo', exact: true }).click();
    await page.waitForFunction(() =>
      /height = 95/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await page.waitForTimeout(800);
    // Kept beside the project: another page can undo what this one did.
    const second = await openPage(page.context().browser(), server.url);
    await ready(second.page);
    await second.page.getByRole('button', { name: 'Undo', exact: true }).first().click();
    await second.page.waitForFunction(() =>
      /height = 9@|height = 9$/m.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await second.context.close();
  },

  async aMistakeIsMendedByKeys({ page }) {
    await ready(page);
    await caretBehind(page, 'extrude');
    await page.keyboard.press('Backspace');
    await page.keyboard.press('Backspace');
    await page.keyboard.type('ed');
    await page.waitForSelector('.cm-lintRange');
    await page.keyboard.press('Control+.');
    await page.waitForFunction(() =>
      /extrude\(height\)/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await page.waitForFunction(() =>
      /No problems/.test(document.querySelector('.status')?.textContent ?? ''),
    );
  },

  async thePaletteRunsAndSets({ page }) {
    await ready(page);
    await palette(page, 'wal');
    assert.match(
      await page.locator('.pal').innerText(),
      /Rules[\s\S]*Wall[\s\S]*journey\.cga:11 · 4 shapes/,
    );
    await page.keyboard.press('Control+Enter');
    await page.waitForFunction(() =>
      /Wall/.test(document.querySelector('.tr.on')?.textContent ?? ''),
    );
    await palette(page, '=hei 14/2');
    await page.keyboard.press('Enter');
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '7',
    );
    await palette(page, '>light');
    await page.keyboard.press('Enter');
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'light');
    await palette(page, 'o');
  },

  async aRuleIsEditedInAForm({ page }) {
    await ready(page);
    await form(page);
    await page.waitForSelector('.rule-list .tr');
    assert.equal(await page.locator('.rule-list .tr').count(), 3);
    await page.locator('.rule-list .tr', { hasText: 'Lot' }).click();
    const count = await drawn(page);
    await page.getByLabel('comp 1', { exact: true }).fill('front');
    await page.getByLabel('comp 1', { exact: true }).press('Enter');
    await page.getByRole('textbox', { name: 'extrude distance' }).fill('height * 2');
    await page.getByRole('textbox', { name: 'extrude distance' }).press('Enter');
    await untilDrawn(page, count);
    await page.locator('.rule-list .tr', { hasText: 'Roof' }).click();
    await page.getByRole('button', { name: 'Choose by chance' }).click();
    await page.waitForSelector('[aria-label="Chance in percent"]');
    await page.locator('.rule-list .tr', { hasText: 'Lot' }).click();
    await asText(page);
    const after = await text(page);
    assert.match(after, /extrude\(height \* 2\)\n {4}comp\(f\) { front : Wall \| top : Roof }/);
    assert.match(after, /Roof -->\n {4}50% : color\("#7c8085"\)\n {4}Slab\. else : NIL/);
    await form(page);
  },

  async aValueGoesToTheRules({ page }) {
    await ready(page);
    await page.locator('#attr-height').press('Enter');
    await page.keyboard.type('17');
    await page.keyboard.press('Enter');
    await page.locator('#attr-paint').selectOption('blue');
    await page.getByRole('button', { name: 'write to rules' }).click();
    await page.waitForFunction(() =>
      /attr height = 17[\s\S]*attr paint = "blue"/.test(
        document.querySelector('.cm-content')?.textContent ?? '',
      ),
    );
    await page.waitForFunction(
      () => !/changed/.test(document.querySelector('.sec h3')?.textContent ?? ''),
    );
    await page.getByRole('button', { name: 'Undo', exact: true }).first().click();
    await page.waitForFunction(() =>
      /attr height = 9/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await page.waitForFunction(() =>
      /2 changed/.test(document.querySelector('.sec h3')?.textContent ?? ''),
    );
  },
};
