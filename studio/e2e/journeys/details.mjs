// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Small things that must not go wrong: names that are written, remedies, drags, sizes, what is
// shown.

import assert from 'node:assert/strict';
import { existsSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openByPalette, palette, text } from '../hands.mjs';
import { HOUSE, caretBehind, code, drawn, ready, status, untilDrawn } from '../studio.mjs';

const valueOf = (page) => page.locator('#attr-height').getAttribute('aria-valuenow').then(Number);

export default {
  /** Names that are new stay as they are written; what is offered comes with Tab. */
  async newNamesStayAsTheyAreWritten({ page }) {
    await ready(page);
    await caretBehind(page, 'Slab.');
    await page.keyboard.type('\nChoice -->\n30% : Round');
    await page.waitForTimeout(700);
    await page.keyboard.press('Enter');
    await page.keyboard.type('else : Roo');
    await page.waitForTimeout(700);
    await page.keyboard.press('Enter');
    await page.keyboard.type('// extr');
    await page.waitForTimeout(700);
    assert.equal(await page.locator('.cm-tooltip-autocomplete').count(), 0, 'quiet in comments');
    const written = await text(page);
    assert.match(written, /30% : Round\n\s*else : Roo\n\s*\/\/ extr/);
    // What Tab inserts is no mistake.
    await caretBehind(page, 'extrude(height)');
    await page.keyboard.press('Enter');
    await page.keyboard.type('roofG');
    await page.waitForSelector('.cm-tooltip-autocomplete');
    await page.waitForTimeout(150);
    await page.keyboard.press('Tab');
    await page.waitForFunction(() =>
      /roofGable\(30\)/.test(document.querySelector('.cm-content')?.innerText ?? ''),
    );
    await page.keyboard.press('Escape');
    await page.waitForFunction(
      () => !/error/.test(document.querySelector('.status')?.textContent ?? ''),
    );
  },

  /** Ctrl . replaces the word that is wrong, and nothing else. */
  async aRemedyChangesItsWordAlone({ page }) {
    await ready(page);
    await caretBehind(page, 'Slab.');
    await page.keyboard.type('\n');
    await page.keyboard.insertText('Parts -->\n  spilt(x) { ~1 : A. }\n');
    await page.waitForSelector('.cm-lintRange-error');
    await caretBehind(page, 'spilt');
    await page.keyboard.press('Control+.');
    await page.waitForSelector('.cm-lintRange-error', { state: 'detached' });
    assert.match(await text(page), /\n {2}split\(x\) \{ ~1 : A\. \}/);
    await code(page).focus();
    await page.keyboard.press('Control+z');
    await page.waitForSelector('.cm-lintRange-error');
    assert.match(await text(page), /\n {2}spilt\(x\) \{ ~1 : A\. \}/);
  },

  /** A drag is one step however long it takes, and Esc takes it back. */
  async aDragIsOneStepAndEscTakesItBack({ page }) {
    await ready(page);
    const box = await page.locator('#attr-height').boundingBox();
    const [x, y] = [box.x + 40, box.y + 10];
    const drag = async () => {
      await page.mouse.move(x, y);
      await page.mouse.down();
      for (const by of [20, 45, 70]) {
        await page.mouse.move(x + by, y, { steps: 3 });
        await page.waitForTimeout(650);
      }
    };
    await drag();
    await page.mouse.up();
    const dragged = await valueOf(page);
    assert.ok(dragged > 12, String(dragged));
    await drag();
    assert.ok((await valueOf(page)) > dragged);
    // The value is back before its model is.
    await page.keyboard.press('Escape');
    await page.mouse.up();
    assert.equal(await valueOf(page), dragged, 'Esc gives back the value from before');
    await page.getByRole('button', { name: 'Undo', exact: true }).click();
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '9',
    );
    assert.ok(await page.getByRole('button', { name: 'Undo', exact: true }).isDisabled());
    // Nothing was changed, so nothing is marked as changed.
    assert.equal(await page.getByRole('button', { name: 'Reset height' }).count(), 0);
  },

  /** What is set is shown at once, however long its model takes. */
  async aFieldShowsWhatIsSetAtOnce({ page }) {
    await ready(page);
    let release = () => undefined;
    const held = new Promise((resolve) => (release = resolve));
    await page.route('**/api/derive', async (route) => {
      await held;
      await route.continue().catch(() => undefined);
    });
    const field = page.locator('#attr-height');
    await field.press('Enter');
    await page.keyboard.type('21');
    await page.keyboard.press('Enter');
    assert.equal(await valueOf(page), 21);
    await field.press('ArrowUp');
    assert.equal(await valueOf(page), 21.2);
    await page.getByRole('button', { name: 'Reset height' }).click();
    assert.equal(await valueOf(page), 9);
    release();
  },

  /** Fields have the names, units and choices that the rules say; what is hidden stays hidden. */
  async fieldsAreAsTheRulesSay({ page, folder, pictured }) {
    await ready(page);
    writeFileSync(
      join(folder, 'said.cga'),
      `@Group("Late", 2) @Order(2) @Percent attr share = 0.25
@Order(1) @DisplayName("Storeys") @Range(min=2, max=9, stepsize=2, restricted=false) attr n = 4
@Group("Soon", 1) @Enum(valuesAttr=kinds) attr kind = kinds[0]
@Enum(3, 6, restricted=false) attr depth = 3
@Hidden attr kinds = ["brick", "stone"]
@Hidden Never --> NIL
@StartRule @InMesh @Out(granularity=separatedShapes) Lot --> extrude(n * 3 + share) Mass.
`,
    );
    await openByPalette(page, 'said.cga');
    assert.deepEqual(await page.locator('.sec .sec-title').allInnerTexts(), ['Soon', 'Late']);
    assert.deepEqual(await page.locator('.sec .fld label').allInnerTexts(), [
      'kind',
      'depth',
      'Storeys',
      'share',
    ]);
    assert.match(await page.locator('#attr-share').innerText(), /^25\s*%$/);
    await page.locator('#attr-share').press('ArrowUp');
    assert.match(await page.locator('#attr-share').innerText(), /^26\s*%$/);
    await page.locator('#attr-n').press('ArrowUp');
    assert.equal(await page.locator('#attr-n').getAttribute('aria-valuenow'), '6');
    assert.deepEqual(await page.locator('#attr-kind option').allInnerTexts(), ['brick', 'stone']);
    await page.locator('#attr-depth').fill('4.5');
    await page.locator('#attr-depth').press('Enter');
    await page.waitForSelector('[aria-label="Reset depth"]');
    assert.deepEqual(await page.locator('#start option').allInnerTexts(), ['Lot']);
    assert.match(await page.locator('#expects').innerText(), /on a mesh.*stay separate/);
    await pictured();
  },

  /** A style that the rules declare is chosen, undone, and given up when it is gone. */
  async aStyleIsChosen({ page, folder }) {
    await ready(page);
    assert.equal(await page.locator('#style').count(), 0, 'HOUSE has none');
    writeFileSync(join(folder, 'styled.cga'), `${HOUSE}\nstyle Tall\nattr height = 25\n`);
    await openByPalette(page, 'styled.cga');
    await page.locator('#style').selectOption('Tall');
    const height = (n) =>
      page.waitForFunction(
        (n) => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === n,
        String(n),
      );
    await height(25);
    await page.getByRole('button', { name: 'Undo', exact: true }).click();
    await height(9);
    await page.locator('#style').selectOption('Tall');
    await height(25);
    await page.locator('#style').selectOption('Default');
    await height(9);
  },

  /** Rules with errors that are opened show no model of other rules, and none that vanished. */
  async otherRulesShowNoOtherModel({ page, folder }) {
    await ready(page);
    writeFileSync(join(folder, 'wrong.cga'), '@StartRule\nLot --> extrude(\n');
    const before = await drawn(page);
    await page.keyboard.press('Control+k');
    for (let tries = 0; tries < 12; ++tries) {
      await page.getByRole('combobox', { name: 'Search or run' }).fill('wrong.cga');
      if (await page.locator('.pal-list [role=option]', { hasText: 'wrong.cga' }).count()) break;
      await page.waitForTimeout(500);
    }
    await page.locator('.pal-list [role=option]', { hasText: 'wrong.cga' }).first().click();
    await page.waitForSelector('.banner');
    assert.match(await page.locator('.banner').innerText(), /errors, and no model yet/);
    assert.equal(await page.locator('#attr-height').count(), 0);
    assert.equal(await page.locator('.tree .tr').count(), 0);
    await untilDrawn(page, before);
    // Back at rules that work, a recursion without end leaves their model in sight.
    await openByPalette(page, 'journey.cga');
    await page.waitForSelector('#attr-height');
    await caretBehind(page, 'Slab.');
    for (let i = 0; i < 5; ++i) await page.keyboard.press('Backspace');
    await page.keyboard.insertText('Roof');
    await page.waitForFunction(
      () => !/No problems/.test(document.querySelector('.status')?.textContent ?? ''),
      null,
      { timeout: 90_000 },
    );
    assert.ok(Number(/(\d+) shapes/.exec(await status(page))?.[1] ?? 1) > 0);
  },

  /** The view keeps its room: panels give way, then lie over it. */
  async panelsGiveWayToTheView({ page, pictured }) {
    await page.setViewportSize({ width: 1440, height: 800 });
    await ready(page);
    const box = (selector) => page.locator(selector).first().boundingBox();
    const fits = async (width) => {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForTimeout(400);
      const view = await box('main.view');
      assert.ok(view.width >= 420, `${width}: the view has ${view.width}`);
      const [left, right] = [await box('.stage .float'), await box('.tools-right')];
      assert.ok(left.x + left.width < right.x, `${width}: the tools lie apart`);
    };
    for (const width of [1440, 1300, 1100, 1000, 900, 760]) await fits(width);
    await page.setViewportSize({ width: 1000, height: 800 });
    await page.locator('main.view canvas').first().focus();
    await page.keyboard.press('Control+i');
    await page.waitForSelector('aside.pane.over .tree');
    await pictured();
    const scheme = await page.evaluate(
      () => getComputedStyle(document.documentElement).colorScheme,
    );
    assert.equal(scheme, 'dark');
  },

  /** A selected shape has a row, wherever it is folded away. */
  async aSelectedShapeHasARow({ page }) {
    await ready(page);
    assert.match(await page.locator('.tree').innerText(), /Wall\s*× 4/);
    const stage = await page.locator('.stage canvas').boundingBox();
    await page.keyboard.down('Control');
    await page.mouse.click(stage.x + stage.width * 0.45, stage.y + stage.height * 0.6);
    await page.keyboard.up('Control');
    await page.waitForSelector('.tree .tr.on');
    assert.match(await page.locator('.tree .tr.on').innerText(), /Face|Slab/);
  },

  /** How the view looks stays over other pages, and keys go on working after a tick. */
  async theSkyStaysAndKeysGoOn({ page, folder }) {
    await ready(page);
    await page.getByRole('button', { name: 'Sun', exact: true }).click();
    await page.getByLabel('Sky').check();
    const seed = () => page.locator('#seed').getAttribute('aria-valuenow');
    const before = await seed();
    await page.keyboard.press('r');
    await page.waitForFunction(
      (old) => document.querySelector('#seed')?.getAttribute('aria-valuenow') !== old,
      before,
    );
    await page.keyboard.press('Escape');
    await page.waitForSelector('.sun-card', { state: 'detached' });
    await page.keyboard.press('Alt+2');
    await page.waitForSelector('.wall2');
    await page.keyboard.press('Alt+1');
    await page.waitForSelector('.stage canvas');
    await page.getByRole('button', { name: 'Sun', exact: true }).click();
    assert.ok(await page.getByLabel('Sky').isChecked(), 'the sky is as it was');
    assert.ok(!existsSync(join(folder, 'nothing')));
  },

  /** A file that is dropped on the text is opened, not pasted. */
  async aDroppedFileIsOpened({ page, folder }) {
    await ready(page);
    const drop = (name, content) =>
      page.locator('.cm-content').evaluate(
        (at, [name, content]) => {
          const dataTransfer = new DataTransfer();
          dataTransfer.items.add(new File([content], name));
          for (const type of ['dragover', 'drop'])
            at.dispatchEvent(
              new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }),
            );
        },
        [name, content],
      );
    await drop('dropped.cga', HOUSE.replace('height = 9', 'height = 17'));
    await page.waitForFunction(
      () => document.querySelector('.crumb b')?.textContent === 'dropped.cga',
    );
    await page.waitForFunction(
      () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '17',
    );
    assert.ok(existsSync(join(folder, 'dropped.cga')));
    await drop('run.sh', 'echo');
    assert.match(await page.locator('.failed').innerText(), /run\.sh is no kind of file/);
    await palette(page, 'journey.cga');
    await page.keyboard.press('Enter');
    await page.waitForFunction(
      () => document.querySelector('.crumb b')?.textContent === 'journey.cga',
    );
    assert.equal(await text(page), HOUSE.trimEnd() + '\n');
  },
};
