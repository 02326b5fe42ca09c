// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The editor as a client of the language server, and forms that write through it.

import assert from 'node:assert/strict';
import { cpSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { asText, form, openByPalette, palette, text } from '../hands.mjs';
import { caretBehind, code, ready, root } from '../studio.mjs';

const BOXES = `# A small house.
axiom START size (12, 10, 9)
terminal Wall 2D [3, 3, 0], Slab

START  -> Split(Y, {1},  # the plinth
                FromRoot) {Slab | Floors}
Floors -> Repeat(Y) {Wall}
`;

/** What the page has sent to the language server, by method. */
async function listening(page) {
  const sent = [];
  page.on('websocket', (socket) =>
    socket.on('framesent', ({ payload }) => sent.push(JSON.parse(payload).method)),
  );
  await page.reload();
  await ready(page);
  await page.waitForSelector('.t-rule');
  return sent;
}

/** Chooses the first offer; one that comes for the last key takes a choice back. */
async function choose(page) {
  const chosen = page.locator('.cm-tooltip-autocomplete li[aria-selected]');
  await page.waitForSelector('.cm-tooltip-autocomplete');
  await page.waitForTimeout(400);
  for (let tries = 0; tries < 20 && !(await chosen.count()); ++tries) {
    await page.keyboard.press('ArrowDown');
    await page.waitForTimeout(200);
  }
}

export default {
  /** Words have colours in each notation, and those of one that was just opened as well. */
  async wordsAreColouredInEveryNotation({ page, folder, pictured }) {
    writeFileSync(join(folder, 'boxes.gbbg'), BOXES);
    cpSync(join(root, 'examples/park/square.park'), join(folder, 'square.park'));
    await ready(page);
    const has = (kind, word) =>
      page.waitForFunction(
        ([k, w]) => [...document.querySelectorAll(`.t-${k}`)].some((n) => n.textContent === w),
        [kind, word],
      );
    await has('declared', 'Lot');
    await has('operation', 'extrude');
    await has('attribute', 'height');
    await openByPalette(page, 'boxes.gbbg');
    await has('declared', 'Floors');
    await has('operation', 'Repeat');
    await has('keyword', 'terminal');
    await has('comment', '# the plinth');
    await openByPalette(page, 'square.park');
    await has('operation', 'Grid');
    await pictured();
  },

  async aCallTellsItsParameters({ page, pictured }) {
    await ready(page);
    await caretBehind(page, 'extrude(height)');
    await page.keyboard.press('Enter');
    await page.keyboard.type('split(');
    await page.waitForSelector('.hover-card.signature');
    await page.waitForFunction(() =>
      document.querySelector('.hover-card.signature b')?.textContent?.startsWith('axis'),
    );
    await pictured();
    await page.keyboard.type('y, ');
    await page.waitForFunction(
      () => !/^axis/.test(document.querySelector('.hover-card.signature b')?.textContent ?? 'axis'),
    );
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await page.waitForSelector('.hover-card.signature', { state: 'detached' });
  },

  async rulesAreFolded({ page, pictured }) {
    await ready(page);
    await page.locator('.cm-foldGutter [title="Fold line"]:visible').first().click();
    await page.waitForSelector('.cm-foldPlaceholder');
    assert.doesNotMatch(await code(page).innerText(), /extrude/);
    await pictured();
    await page.locator('.cm-foldPlaceholder').click();
    await page.waitForFunction(() =>
      /extrude/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
  },

  async aColourIsPicked({ page }) {
    await ready(page);
    await page.waitForSelector('input.swatch');
    assert.equal(await page.locator('input.swatch').count(), 3);
    await page.locator('input.swatch[aria-label="Colour #7c8085"]').evaluate((input) => {
      input.value = '#102030';
      input.dispatchEvent(new Event('change'));
    });
    await page.waitForFunction(() =>
      /"#102030"/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await page.waitForSelector('input.swatch[aria-label="Colour #102030"]');
  },

  /** What an attribute is in the model stands beside what the rules say of it. */
  async valuesAndNamesStandInTheText({ page, pictured }) {
    await ready(page);
    await page.locator('#attr-height').press('Enter');
    await page.keyboard.type('14');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.inlay.value[data-hint="= 14"]');
    await caretBehind(page, 'extrude(height)');
    await page.keyboard.press('Enter');
    await page.keyboard.type('roofHip(30, 0.5)');
    await page.waitForSelector('.inlay:not(.value)');
    // They are no part of the text.
    assert.match(await text(page), /attr height = 9\n/);
    await pictured();
  },

  async assetsAreOfferedWithTheirPictures({ page, folder, pictured }) {
    mkdirSync(join(folder, 'assets'));
    cpSync(join(root, 'examples/tower/tower.png'), join(folder, 'assets/brick.png'));
    writeFileSync(
      join(folder, 'assets/bench.obj'),
      'v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n',
    );
    await page.reload();
    await ready(page);
    await caretBehind(page, 'color("#7c8085")');
    await page.keyboard.press('Enter');
    await page.keyboard.type('texture("br');
    await choose(page);
    // It is not only there: it is what stands at its place on the screen.
    await page.waitForFunction(() => {
      const picture = document.querySelector('.cm-completionInfo .preview img');
      const box = picture?.getBoundingClientRect();
      return (
        box && document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2) === picture
      );
    });
    await pictured();
    await page.keyboard.press('Tab');
    await page.waitForFunction(() =>
      /texture\("brick\.png/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await page.keyboard.press('End');
    await page.keyboard.press('Enter');
    await page.keyboard.type('i("ben');
    await choose(page);
    await page.waitForSelector('.cm-completionInfo .preview canvas');
    assert.match(await page.locator('.preview figcaption').innerText(), /2 × 1 × 0 m/);
    // There is no picture by half of its name, and the browser says so.
    return { complaintsExpected: true };
  },

  /** While one types words go out that are asked for, and the rest once the text rests. */
  async aKeyCostsWhatItAsks({ page }) {
    await ready(page);
    const sent = await listening(page);
    await caretBehind(page, 'Slab.');
    await page.waitForTimeout(1500);
    sent.length = 0;
    await page.keyboard.type(' // twelve keys', { delay: 25 });
    await page.waitForTimeout(1500);
    const count = (method) => sent.filter((m) => m === `textDocument/${method}`).length;
    // However slow the machine: a change is sent once, and looked at once.
    const keys = ' // twelve keys'.length;
    const changes = count('didChange');
    assert.ok(changes >= 1 && changes <= keys, sent.join(' '));
    for (const method of ['semanticTokens/range', 'inlayHint', 'documentColor', 'foldingRange'])
      assert.ok(count(method) >= 1 && count(method) <= changes + 1, sent.join(' '));
    assert.ok(count('completion') <= keys, sent.join(' '));
    assert.equal(sent.filter((m) => m === 'gable/values').length, 0, 'the values are the same');
  },

  /** Files that are open are looked at, whether they are derived or not. */
  async mistakesOfAnyOpenFileAreMarked({ page, folder, pictured }) {
    writeFileSync(join(folder, 'other.cga'), 'Part --> extrud(3) X.\n');
    await ready(page);
    await palette(page, 'other.cga');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.cm-lintRange-error');
    await page.locator('.cm-lintRange-error').first().hover();
    await page.waitForSelector('.cm-diagnosticAction');
    assert.match(await page.locator('.cm-diagnosticAction').first().innerText(), /Write 'extrude'/);
    await pictured();
    await page.locator('.cm-diagnosticAction').first().click();
    await page.waitForFunction(() =>
      /extrude\(3\)/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await page.waitForSelector('.cm-lintRange-error', { state: 'detached' });
  },

  /** A form changes the words that it is about; comments and layout stay. */
  async aFormKeepsCommentsAndLayout({ page, folder }) {
    writeFileSync(join(folder, 'boxes.gbbg'), BOXES);
    await ready(page);
    await openByPalette(page, 'boxes.gbbg');
    await form(page);
    await page.locator('.rule-list .tr', { hasText: 'START' }).click();
    await page.getByRole('button', { name: 'to the root' }).click();
    await page.waitForSelector('button[aria-pressed=true]:has-text("to the root")');
    await page.locator('.rule-list .tr', { hasText: 'Floors' }).click();
    await page.waitForFunction(() => document.querySelector('#rule-name')?.value === 'Floors');
    await page.getByRole('group', { name: 'Axis' }).getByRole('button', { name: 'X' }).click();
    await page.waitForSelector('.seg button[aria-pressed=true]:has-text("X")');
    await asText(page);
    const expected = BOXES.replace('FromRoot', 'ToRoot').replace('Repeat(Y)', 'Repeat(X)');
    assert.equal((await text(page)).trimEnd(), expected.trimEnd());
    await form(page);
  },
};
