// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the page says and how it stands there: hints, fields, tabs, searches, pictures that are
// written.

import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openByPalette, text } from '../hands.mjs';
import { meter } from '../processes.mjs';
import { HOUSE, caretBehind, code, drawn, ready, root, status, untilDrawn } from '../studio.mjs';

/** The model as it is drawn, without what lies over it. */
const modelPixels = (page) =>
  page.locator('.stage canvas').evaluate((canvas) => {
    const flat = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
    flat.drawImage(canvas, 0, 0);
    const { data } = flat.getImageData(0, 0, canvas.width, canvas.height);
    const [red, green, blue] = [0, 1, 2].map(
      (c) => data[((canvas.height >> 1) * canvas.width + (canvas.width >> 1)) * 4 + c],
    );
    return { red, green, blue };
  });

/** Waits until the list of problems says all of it, and gives it. */
async function problems(page, ...said) {
  for (const each of said)
    await page.waitForFunction(
      (s) => [...document.querySelectorAll('.prob')].some((p) => p.textContent.includes(s)),
      each,
    );
  return page.locator('.prob').allInnerTexts();
}

/** Writes rules from outside and waits until the page has them. */
async function rewritten(page, folder, rules, sign) {
  writeFileSync(join(folder, 'journey.cga'), rules);
  await page.waitForFunction(
    (s) => document.querySelector('.cm-content')?.textContent?.includes(s),
    sign,
  );
}

const boxes = (page, selector) =>
  page.locator(selector).evaluateAll((all) =>
    all.map((n) => {
      const range = document.createRange();
      range.selectNodeContents(n);
      const { left, right, top, bottom } = range.getBoundingClientRect();
      return { text: n.textContent.trim(), left, right, top, bottom };
    }),
  );

export default {
  /** A hint names what can be written there, in the words of a page. */
  async hintsFitWhatIsWritten({ page, folder, pictured }) {
    await ready(page);
    const wrong = `Wall = color()
Lot --> extrude(3) comp(f) { sides : Face. }
Tall --> if extrude(9)
Late --> extrude(3) Building roofGable(30)
`;
    await rewritten(page, folder, wrong, 'Building');
    const said = (await problems(page, "no function 'color'", "'sides' is no", "'if'")).join('\n');
    assert.match(said, /operation, and those stand in rules/);
    assert.match(said, /did you mean 'side'\?/);
    assert.match(said, /conditions are written 'case condition/);
    assert.match(said, /named 'Building'; it becomes a leaf/);
    assert.doesNotMatch(said, /'size'|'floor'|'if\.'|\s--\w/);
    await pictured();
    writeFileSync(
      join(folder, 'old.grammar'),
      '# a -> b\nStart -> I ( CubeX 1 0 1 )\nO -> Start\n',
    );
    await openByPalette(page, 'old.grammar');
    const unused = (await problems(page, "runs 'O'")).join('\n');
    assert.match(unused, /make it the start rule/);
    assert.doesNotMatch(unused, /--start/);
    await page.waitForFunction(() =>
      [...document.querySelectorAll('.t-comment')].some((n) => n.textContent === '# a -> b'),
    );
  },

  /** The editor indents as the formatter does. */
  async theEditorIndentsAsTheFormatter({ page }) {
    await ready(page);
    await page.keyboard.press('Shift+Alt+F');
    await caretBehind(page, 'Slab.');
    await page.keyboard.press('Enter');
    await page.keyboard.type('// more');
    assert.match(await text(page), /\n {2}extrude\(height\)[^]*\n {2}Slab\.\n {2}\/\/ more/);
    await page.keyboard.press('Enter');
    await page.keyboard.press('Tab');
    await page.keyboard.type('// in');
    assert.match(await text(page), /\n {4}\/\/ in/);
  },

  /** Numbers, units and names of files can be read. */
  async fieldsAndTabsCanBeRead({ page, folder, pictured }) {
    await ready(page);
    const rules = HOUSE.replace('@Group', 'attr lotArea = geometry.area\n@Group');
    await rewritten(page, folder, rules, 'lotArea');
    await page.waitForSelector('#attr-lotArea');
    assert.match(await page.locator('#attr-lotArea').innerText(), /^600$/);
    // The mark of a slider stands below its digits, wherever it is.
    for (const value of ['3', '4.35', '30']) {
      await page.locator('#attr-height').press('Enter');
      await page.keyboard.type(value);
      await page.keyboard.press('Enter');
      const clear = await page.locator('#attr-height').evaluate((slider) => {
        const mark = getComputedStyle(slider, '::after');
        const box = slider.getBoundingClientRect();
        const digits = document.createRange();
        digits.selectNodeContents(slider.querySelector('.num'));
        const middle = digits.getBoundingClientRect();
        // Digits are as high as two thirds of their line.
        const low = middle.bottom - middle.height / 6;
        return box.bottom - parseFloat(mark.height) >= low - 0.5;
      });
      assert.ok(clear, `the mark covers the digits at ${value}`);
    }
    for (const name of ['terraces-of-the-old-town.cga', 'roofs.cga', 'windows.cga', 'doors.cga']) {
      writeFileSync(join(folder, name), 'Part --> extrude(1) X.\n');
      await openByPalette(page, name);
    }
    const tabs = await page
      .locator('.files .file')
      .evaluateAll((all) => all.map((t) => [t.textContent.trim(), t.scrollWidth, t.clientWidth]));
    assert.ok(tabs.length >= 5, String(tabs));
    for (const [name, needed, has] of tabs) assert.ok(needed <= has + 1, `${name}: ${has} px`);
    await pictured();
  },

  /** Rules that never end leave the last model in sight, and say so. */
  async aRecursionWithoutEndKeepsTheModel({ page, folder, pictured }) {
    await ready(page);
    const before = await modelPixels(page);
    await rewritten(page, folder, HOUSE.replace('extrude(height)', 'Lot // again'), '// again');
    await page.waitForSelector('.banner', { timeout: 90_000 });
    assert.match(await page.locator('.banner').innerText(), /limit[^]*Last model that worked/);
    const [banner, view] = await Promise.all(
      ['.banner', 'main.view'].map((s) => page.locator(s).boundingBox()),
    );
    assert.ok(banner.x >= view.x && banner.x + banner.width <= view.x + view.width);
    await page.waitForTimeout(800);
    const after = await modelPixels(page);
    for (const c of ['red', 'green', 'blue'])
      assert.ok(Math.abs(before[c] - after[c]) < 40, JSON.stringify([before, after]));
    assert.ok((await page.locator('.tree .tr').count()) >= 3);
    assert.equal(await page.locator('#attr-height').count(), 1);
    assert.match(await status(page), /warning|error/);
    await pictured();
  },

  /** Seeds of any length stand beside each other. */
  async seedsStandApart({ page, pictured }) {
    await page.setViewportSize({ width: 1600, height: 900 });
    await ready(page);
    await page.locator('#seed').press('Enter');
    await page.keyboard.type('-2147483648');
    await page.keyboard.press('Enter');
    await page.keyboard.press('Alt+2');
    await page.waitForSelector('#variant-3');
    await page.locator('#variant-3').hover();
    await page.waitForSelector('.compare .cmp b');
    const cells = await boxes(page, '.compare section:first-of-type .cmp > *');
    const seeds = cells.filter((c) => /\d/.test(c.text));
    assert.ok(seeds.length >= 2 && seeds.some((c) => /2.?147.?483.?648/.test(c.text)));
    for (let i = 1; i < cells.length; ++i)
      assert.ok(cells[i].left >= cells[i - 1].right, JSON.stringify(cells));
    await pictured();
  },

  /** A traced picture shows what the view shows, in a time that one waits. */
  async aTracedPictureLooksAsTheViewDoes({ page, folder, server }) {
    await ready(page);
    const asked = [];
    page.on('request', (r) => {
      if (/api\/export\?/.test(r.url())) asked.push(new URL(r.url()).searchParams);
    });
    const traced = async (name) => {
      await page.keyboard.press('Control+e');
      const [download] = await Promise.all([
        page.waitForEvent('download', { timeout: 100_000 }),
        page.getByRole('menuitem', { name: 'A picture, traced' }).click(),
      ]);
      await download.saveAs(join(folder, name));
      return readFileSync(join(folder, name));
    };
    const spent = meter(server.pid);
    const front = await traced('front.png');
    const seconds = spent().server / 1000;
    const stage = await page.locator('.stage canvas').boundingBox();
    const [wide, high] = [front.readUInt32BE(16), front.readUInt32BE(20)];
    assert.ok(Math.abs(wide / high - stage.width / stage.height) < 0.02, `${wide} x ${high}`);
    await page.locator('.stage canvas').focus();
    for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowLeft');
    const turned = await traced('turned.png');
    const eyes = asked.map((q) => JSON.parse(q.get('camera')).slice(0, 3).map(Math.round).join());
    assert.equal(new Set(eyes).size, 2, eyes.join(' and '));
    assert.ok(!front.equals(turned));
    assert.ok(seconds < 40, `${seconds} s of all processors`);
  },

  /** What operations are called by people who do not know their names. */
  async wordsOfPeopleFindOperations({ page, pictured }) {
    await ready(page);
    await page.keyboard.press('Control+k');
    const search = page.getByRole('combobox', { name: 'Search or run' });
    for (const [word, name] of [
      ['cut', 'split'],
      ['divide into floors', 'split'],
      ['windows', 'comp'],
      ['random', 'rand'],
      ['chance', 'rand'],
      ['mansard', 'roofHip'],
      ['boolean', 'trim'],
      ['stairs', 'repeat'],
      ['arch', 'curve'],
      ['delete face', 'NIL'],
    ]) {
      await search.fill(word);
      await page.waitForFunction(
        (n) =>
          [...document.querySelectorAll('.pal-list [role=option]')].some((o) =>
            o.textContent.trim().startsWith(n),
          ),
        name,
      );
    }
    await pictured();
  },

  /** New rules say how one goes on, and have nothing to complain about. */
  async newRulesBeginWithHelp({ page, pictured }) {
    await ready(page);
    await page.keyboard.press('Alt+4');
    await page.getByRole('button', { name: /Empty rules/ }).click();
    await page.waitForFunction(
      () => document.querySelector('.crumb b')?.textContent === 'rules.cga',
    );
    await ready(page);
    await page.waitForFunction(() =>
      /No problems/.test(document.querySelector('.status')?.textContent ?? ''),
    );
    assert.match(await code(page).innerText(), /\/\/[^]*Ctrl/);
    await pictured();
  },

  /** An example that is opened looks as its card does: its camera, under a sky. */
  async anExampleLooksAsItsCard({ page, pictured }) {
    await ready(page);
    await page.keyboard.press('Alt+4');
    await page.waitForSelector('.gc img');
    await page
      .getByRole('button', { name: /^Tower/ })
      .first()
      .click();
    await page.waitForSelector('text=tower.cga');
    await ready(page);
    await page.getByRole('button', { name: 'Sun', exact: true }).click();
    assert.ok(await page.getByLabel('Sky').isChecked());
    await page.keyboard.press('Escape');
    const asked = page.waitForRequest(/api\/export\?/);
    await page.keyboard.press('Control+e');
    await page.getByRole('menuitem', { name: 'A picture, traced' }).click();
    const camera = JSON.parse(new URL((await asked).url()).searchParams.get('camera'));
    await page.getByRole('button', { name: 'Stop writing png' }).click();
    const words = readFileSync(join(root, 'examples/tower/picture.args'), 'utf8');
    const target = /--target=(\S+)/.exec(words)[1].split(',').map(Number);
    camera.slice(3, 6).forEach((v, i) => assert.ok(Math.abs(v - target[i]) < 0.01, String(camera)));
    await pictured();
  },

  /** Lots that are dropped on the view are what the rules start on. */
  async lotsAreDroppedOnTheView({ page, folder }) {
    await ready(page);
    const ring = [
      [0, 0],
      [30, 0],
      [30, 20],
      [0, 20],
      [0, 0],
    ];
    const lots = {
      type: 'FeatureCollection',
      crs: { type: 'name', properties: { name: 'urn:ogc:def:crs:EPSG::25832' } },
      features: [
        { type: 'Feature', properties: {}, geometry: { type: 'Polygon', coordinates: [ring] } },
      ],
    };
    const before = await drawn(page);
    await page.locator('.stage canvas').evaluate((at, content) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([content], 'my-lots.geojson'));
      for (const type of ['dragover', 'drop'])
        at.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
    }, JSON.stringify(lots));
    await page.waitForFunction(
      () => document.querySelector('#shapes')?.value === 'my-lots.geojson',
    );
    await untilDrawn(page, before);
    assert.ok(existsSync(join(folder, 'my-lots.geojson')));
  },
};
