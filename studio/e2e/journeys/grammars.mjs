// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Grammars of other notations. Journeys that begin with the name of an acceptance row prove that
// row.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { asText, form, openByPalette, palette, text } from '../hands.mjs';
import { caretBehind, drawn, ready, root, status, untilDrawn, viewPixels } from '../studio.mjs';

const TEST_BUILDING = readFileSync(join(root, 'tests/dialects/data/test_building.gbbg'), 'utf8');
const SMALL_GBBG = `# A small house.
axiom START size (12, 10, 9)

terminal Wall 2D [3, 3, 0], Window 2D [3, 3, 0], Slab
shape Floor [0, 3, 0]

START  -> Split(Y, {1}, ToRoot) {Slab | Floors}
Floors -> Repeat(Y) {Floor}
Floor  -> Component(Y, Sides) {Facade}
Facade -> Repeat(X) {Wall 1, Window 2}
`;

export default {
  async G17_seedsAreSignedIntegers({ page }) {
    await ready(page);
    await caretBehind(page, 'extrude(height');
    await page.keyboard.type(' + rand(0, 20)');
    const size = () => page.locator('.tree .tr').first().innerText();
    const set = async (seed) => {
      const before = await drawn(page);
      await page.locator('#seed').press('Enter');
      await page.keyboard.type(String(seed));
      await page.keyboard.press('Enter');
      await untilDrawn(page, before);
      await page.waitForTimeout(900);
      assert.equal(await page.locator('#seed').getAttribute('aria-valuenow'), String(seed));
      return viewPixels(page);
    };
    const least = await set(-2147483648);
    await set(2147483647);
    assert.ok(await size());
    assert.ok(least);
    const before = await drawn(page);
    await page.getByRole('button', { name: 'New seed' }).click();
    await untilDrawn(page, before);
    assert.notEqual(await page.locator('#seed').getAttribute('aria-valuenow'), '2147483647');
  },

  async G20_aGrammarIsMadeInTheForm({ page, folder }) {
    writeFileSync(join(folder, 'small.gbbg'), SMALL_GBBG);
    await ready(page);
    await openByPalette(page, 'small.gbbg');
    await form(page);
    // A form is read by the server: what it shows comes a moment later.
    const says = (selector, value) =>
      page.waitForFunction(([s, v]) => document.querySelector(s)?.value === v, [selector, value]);
    const types = (list) =>
      page.waitForFunction(
        (wanted) =>
          [...document.querySelectorAll('.rule-list .tr .chip')]
            .map((n) => n.textContent)
            .join() === wanted,
        list.join(),
      );
    await types(['Split', 'Repeat', 'Component', 'Repeat']);
    // Search, inspect.
    await page.getByLabel('Find a rule').fill('aca');
    assert.equal(await page.locator('.rule-list .tr').count(), 1);
    await page.getByLabel('Find a rule').fill('');
    await page.locator('.rule-list .tr', { hasText: 'Facade' }).click();
    await says('#rule-name', 'Facade');
    await says('#gbbg-type', 'Repeat');
    assert.equal(await page.getByLabel('Successor successor 2').inputValue(), 'Window');
    // Duplicate: a new name, equal parameters.
    await page.getByRole('button', { name: 'Duplicate' }).click();
    await says('#rule-name', 'Facade_2');
    await says('#gbbg-type', 'Repeat');
    // Rename, and all that use it.
    await page.locator('.rule-list .tr', { hasText: 'Floors' }).click();
    await says('#rule-name', 'Floors');
    await page.locator('#rule-name').fill('Storeys');
    await page.locator('#rule-name').press('Enter');
    await page.waitForFunction(() =>
      [...document.querySelectorAll('.rule-list .tr')].some((r) => /Storeys/.test(r.textContent)),
    );
    // New rule of a type; delete with undo; a shape.
    await page.getByRole('button', { name: 'New rule' }).click();
    await page
      .getByRole('group', { name: 'Type of the new rule' })
      .getByRole('button', { name: 'Margin' })
      .click();
    await says('#gbbg-type', 'Margin');
    await page.getByRole('button', { name: 'Delete', exact: true }).click();
    await page.waitForSelector('.toast:has-text("Deleted Rule")');
    await types(['Split', 'Repeat', 'Component', 'Repeat', 'Repeat']);
    await page.getByRole('button', { name: 'New rule' }).click();
    await page.getByRole('button', { name: 'New shape' }).click();
    await page.getByLabel('Name of the new shape').fill('Sill');
    await page.getByRole('button', { name: '2D' }).click();
    await page.waitForSelector('.toast:has-text("Sill")');
    await page.locator('.rule-list .tr', { hasText: 'Facade_2' }).click();
    await says('#rule-name', 'Facade_2');
    await page.getByRole('button', { name: 'Delete', exact: true }).click();
    await page.waitForSelector('.toast:has-text("Deleted Facade_2")');
    await page.locator('.toast').getByRole('button', { name: 'Undo' }).click();
    await says('#rule-name', 'Facade_2');
    await asText(page);
    const after = await text(page);
    assert.match(
      after,
      /Split\(Y, \{1\}, ToRoot\) \{Slab \| Storeys\}\nStoreys -> Repeat\(Y\) \{Floor\}/,
    );
    assert.match(after, /Facade_2 -> Repeat\(X\) \{Wall 1, Window 2\}/);
    assert.match(after, /shape Sill 2D/);
    assert.doesNotMatch(after, /Margin/);
    await form(page);
    await page.locator('.rule-list .tr', { hasText: 'START' }).click();
    await page.waitForTimeout(600);
  },

  async G21_wrongGrammarsAreTold({ page, folder }) {
    writeFileSync(
      join(folder, 'wrong.gbbg'),
      SMALL_GBBG.replace('{Wall 1, Window 2}', '{Wall 0, Window 2}') +
        'Nowhere -> Repeat(X) {Wall}\n',
    );
    await ready(page);
    await openByPalette(page, 'wrong.gbbg');
    await page.keyboard.press('Control+j');
    await page.waitForSelector('.prob');
    const problems = await page.locator('.problems').innerText();
    assert.match(problems, /Nowhere/);
    assert.match(problems, /chance/i);
    await form(page);
    await page.locator('.rule-list .tr', { hasText: 'Nowhere' }).click();
    await page.waitForSelector('.said-small');
    // A split with too many pieces cannot be read: the form says so and shows the text.
    await asText(page);
    await caretBehind(page, 'Split(Y, {1');
    await page.keyboard.type(', 2');
    await page.waitForSelector('.cm-lintRange-error');
    assert.match(await page.locator('.problems').innerText(), /Split|split/);
  },

  async G22_aGrammarIsSavedAsItWas({ page, folder }) {
    writeFileSync(join(folder, 'small.gbbg'), SMALL_GBBG);
    await ready(page);
    await openByPalette(page, 'small.gbbg');
    await form(page);
    await page.locator('.rule-list .tr', { hasText: 'START' }).click();
    await page.getByRole('button', { name: 'from the root' }).click();
    await page.waitForSelector('.crumb .dirty');
    await page.keyboard.press('Control+s');
    await page.waitForSelector('.crumb .dirty', { state: 'detached' });
    assert.match(
      readFileSync(join(folder, 'small.gbbg'), 'utf8'),
      /START {2}-> Split\(Y, \{1\}, FromRoot\)/,
    );
    await page.getByRole('button', { name: 'Undo', exact: true }).first().click();
    await page.waitForSelector('.crumb .dirty');
    await page.keyboard.press('Control+s');
    await page.waitForSelector('.crumb .dirty', { state: 'detached' });
    assert.equal(readFileSync(join(folder, 'small.gbbg'), 'utf8'), SMALL_GBBG);
  },

  async G23_theAuthorsBuildingStands({ page, folder }) {
    writeFileSync(join(folder, 'test_building.gbbg'), TEST_BUILDING);
    await ready(page);
    await openByPalette(page, 'test_building.gbbg');
    for (const [symbol, count] of [
      ['FacadeSegment', 96],
      ['RoofTopSegment', 36],
      ['FootingEdgeSegment', 24],
      ['RoofEdgeSegment', 16],
    ]) {
      await palette(page, `#${symbol}`);
      assert.match(
        await page.locator('.pal-list [role=option]').first().innerText(),
        new RegExp(`${symbol}\\s*${count} of them`),
      );
      await page.keyboard.press('Escape');
    }
    await palette(page, '#RoofEdgeSegment');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.tr.on');
  },

  async P43_aParkIsEditedAndSeen({ page, folder, pictured }) {
    writeFileSync(
      join(folder, 'square.park'),
      readFileSync(join(root, 'examples/park/square.park')),
    );
    await ready(page);
    await openByPalette(page, 'square.park');
    const before = await viewPixels(page);
    const count = await drawn(page);
    await caretBehind(page, 'Grid(2');
    await page.keyboard.press('Backspace');
    await page.keyboard.type('3');
    await untilDrawn(page, count);
    await page.waitForTimeout(1200);
    assert.ok(!before.equals(await viewPixels(page)));
    assert.match(await status(page), /Park/);
    await pictured();
    await page.getByText('Grid', { exact: true }).first().hover();
    await page.waitForSelector('.hover-card');
    assert.match(
      await page.locator('.hover-card').innerText(),
      /Grid\(columns, rows\)[\s\S]*Done by grid/,
    );
  },
};
