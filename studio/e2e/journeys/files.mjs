// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What comes in and goes out: models, variations, shared places, exports. G16 and C15 are
// acceptance rows.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { palette, toast } from '../hands.mjs';
import { caretBehind, drawn, gable, openPage, ready, untilDrawn, viewPixels } from '../studio.mjs';

/** A box with its least corner at the origin. */
function boxObj(x, y, z) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(
    (i) => `v ${i & 1 ? x : 0} ${i & 2 ? y : 0} ${i & 4 ? z : 0}`,
  );
  return `${corners.join('\n')}\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n`;
}

export default {
  async G16_aModelBecomesATerminalShape({ page, folder }) {
    writeFileSync(join(folder, 'corner.obj'), boxObj(8, 9, 8));
    await ready(page);
    await page.keyboard.press('Alt+3');
    await page.waitForSelector('.drop-large');
    await page.waitForFunction(() => document.querySelector('.asset'), null, { timeout: 15_000 });
    await page.locator('.asset', { hasText: 'corner.obj' }).click();
    await page.waitForSelector('.bench .handle');
    const value = (label) =>
      page.getByLabel(label, { exact: true }).getAttribute('aria-valuenow').then(Number);
    assert.deepEqual(
      [await value('Size X'), await value('Size Y'), await value('Size Z')],
      [8, 9, 8],
    );
    // Drag the upper face, then set it back by a number.
    await page.waitForTimeout(600);
    const top = await page.locator('.grab-y').boundingBox();
    await page.mouse.move(top.x + 5, top.y + 5);
    await page.mouse.down();
    await page.mouse.move(top.x + 5, top.y - 35, { steps: 6 });
    await page.mouse.up();
    assert.ok((await value('Size Y')) > 9.5, String(await value('Size Y')));
    await page.getByLabel('Size Y', { exact: true }).press('Enter');
    await page.keyboard.type('9');
    await page.keyboard.press('Enter');
    await page.getByLabel('back left').click();
    assert.match(await page.locator('.workshop').innerText(), /covers 100 % × 100 % × 100 %/);
    await page.locator('#asset-name').fill('');
    assert.match(await page.locator('.workshop').innerText(), /needs a name/);
    await page.locator('#asset-name').fill('Corner');
    await page.getByRole('button', { name: 'Save shape' }).click();
    await page.waitForSelector('text=Saved assets/Corner.glb');
    assert.equal(readFileSync(join(folder, 'assets/Corner.glb')).toString('latin1', 0, 4), 'glTF');
    // An 8 x 9 x 8 model fills a scope of 7 x 7 x 7 exactly.
    writeFileSync(
      join(folder, 'roof.gbbg'),
      'axiom START size (7, 7, 7)\nterminal Corner\nSTART -> Scope() {Corner}\npostprocess {\n  Corner : "assets/Corner.glb"\n}\n',
    );
    const run = spawnSync(
      gable,
      ['generate', join(folder, 'roof.gbbg'), '-o', join(folder, 'roof.glb'), '--stats', '-'],
      { encoding: 'utf8' },
    );
    const { bbox } = JSON.parse(run.stdout);
    for (let i = 0; i < 3; ++i)
      assert.ok(Math.abs(bbox.max[i] - bbox.min[i] - 7) < 1e-4, run.stdout);
  },

  async aVariationIsTaken({ page }) {
    await ready(page);
    await palette(page, '>vary height');
    await page.keyboard.press('Enter');
    await page.waitForFunction(
      () => /12 of 12 drawn/.test(document.querySelector('.wall-state')?.textContent ?? ''),
      null,
      { timeout: 120_000 },
    );
    assert.equal(await page.locator('.th').count(), 12);
    const last = page.locator('.th').nth(11);
    assert.match(await last.innerText(), /height 30/);
    await page.locator('#variant-9').focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    assert.match(await toast(page), /Took height 30/);
    await page.waitForFunction(() =>
      document.querySelectorAll('.th')[11]?.classList.contains('now'),
    );
    await page.keyboard.press('Alt+1');
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '30',
    );
    await page.keyboard.press('Alt+2');
    await page.waitForFunction(
      () => /12 of 12 drawn/.test(document.querySelector('.wall-state')?.textContent ?? ''),
      null,
      { timeout: 120_000 },
    );
  },

  async C15_seedsArePreviewedAndPictured({ page, folder }) {
    await ready(page);
    await caretBehind(page, 'extrude(height');
    await page.keyboard.type(' + rand(0, 20)');
    await page.waitForTimeout(1500);
    // Shaded, and as wires.
    const shaded = await viewPixels(page);
    await page.getByRole('button', { name: 'Wireframe' }).click();
    await page.waitForTimeout(900);
    assert.ok(!shaded.equals(await viewPixels(page)));
    await page.getByRole('button', { name: 'Wireframe' }).click();
    // A picture of the view.
    await page.keyboard.press('Control+e');
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('menuitem', { name: 'A picture of the view' }).click(),
    ]);
    await download.saveAs(join(folder, 'view.png'));
    const png = readFileSync(join(folder, 'view.png'));
    assert.equal(png.toString('latin1', 1, 4), 'PNG');
    assert.ok(png.length > 20_000, String(png.length));
    // The next seed, and a grid of seeds.
    const count = await drawn(page);
    await page.locator('.head h2').first().click();
    await page.keyboard.press('r');
    await untilDrawn(page, count);
    await page.keyboard.press('Alt+2');
    await page.waitForFunction(
      () => /12 of 12 drawn/.test(document.querySelector('.wall-state')?.textContent ?? ''),
      null,
      { timeout: 120_000 },
    );
    const pictures = await page
      .locator('.th .pic canvas')
      .evaluateAll((all) => all.map((c) => c.toDataURL().length));
    assert.equal(pictures.length, 12);
    assert.ok(new Set(pictures).size > 6, String(pictures));
  },

  async aPlaceIsSharedAndOpened({ page, folder, server }) {
    await ready(page);
    await page.locator('#attr-height').press('Enter');
    await page.keyboard.type('21');
    await page.keyboard.press('Enter');
    await page.getByRole('button', { name: 'Share' }).click();
    await page.waitForFunction(() =>
      /#share=/.test(document.querySelector('#share-link')?.value ?? ''),
    );
    const link = await page.locator('#share-link').inputValue();
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Download' }).click(),
    ]);
    assert.equal(download.suggestedFilename(), 'journey.gable.json');
    await page.getByLabel('Link to open').fill('nothing of the kind');
    await page.getByLabel('Link to open').press('Enter');
    assert.match(await page.getByRole('alert').innerText(), /no link to a shared place/);
    await page.getByLabel('Link to open').fill(link);
    await page.getByLabel('Link to open').press('Enter');
    await page.waitForFunction(() =>
      /shared-journey/.test(document.querySelector('.crumb')?.textContent ?? ''),
    );
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '21',
    );
    assert.ok(existsSync(join(folder, 'shared-journey/journey.cga')));
    // The same link as the address of a page.
    const second = await openPage(
      page.context().browser(),
      `${server.url}#share=${link.split('#share=')[1]}`,
    );
    await second.page.waitForFunction(() =>
      /shared-journey-2/.test(document.querySelector('.crumb')?.textContent ?? ''),
    );
    await ready(second.page);
    await second.context.close();
    await page.getByRole('button', { name: 'Share' }).click();
    await page.waitForFunction(() =>
      /#share=/.test(document.querySelector('#share-link')?.value ?? ''),
    );
  },

  async everyFormatIsExported({ page, folder }) {
    mkdirSync(join(folder, 'out'));
    await ready(page);
    const starts = { glb: 'glTF', obj: 'PK', ply: 'ply', stl: '', gltf: '' };
    for (const [format, start] of Object.entries(starts)) {
      await page.keyboard.press('Control+e');
      const item = page
        .getByRole('menuitem')
        .filter({ has: page.locator('b', { hasText: new RegExp(`^\\.${format}$`) }) })
        .first();
      const [download] = await Promise.all([
        page.waitForEvent('download', { timeout: 120_000 }),
        item.click(),
      ]);
      const file = join(folder, 'out', download.suggestedFilename());
      await download.saveAs(file);
      const bytes = readFileSync(file);
      assert.ok(bytes.length > 200, format);
      assert.equal(bytes.toString('latin1', 0, start.length), start, format);
    }
    // A traced picture takes a while: it tells how far it is, and stops when told to.
    await page.keyboard.press('Control+e');
    await page.getByRole('menuitem', { name: 'A picture, traced' }).click();
    await page.waitForFunction(() =>
      /\d %/.test(document.querySelector('.btn.progress')?.textContent ?? ''),
    );
    await page.getByRole('button', { name: 'Stop writing png' }).click();
    await page.getByRole('button', { name: 'Export' }).waitFor();
    await page.keyboard.press('Control+e');
    await page.waitForSelector('[role=menu]');
  },

  /** An address names the file that the page opens with. */
  async anAddressNamesTheFileToOpen({ page, server, folder }) {
    await ready(page);
    writeFileSync(join(folder, 'other file.cga'), '@StartRule\nLot --> extrude(2) X.\n');
    const opened = async (address) => {
      await page.goto('about:blank');
      await page.goto(`${server.url}${address}`);
      await ready(page);
    };
    await opened('#file=other%20file.cga');
    await page.waitForFunction(
      () => document.querySelector('.crumb b')?.textContent === 'other file.cga',
    );
    await opened('#file=gone.cga');
    await page.getByText("There is no rule file 'gone.cga'").waitFor();
  },
};
