// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Nothing is lost and nothing fails in silence: servers that end, copies that cannot be made, links
// opened where nobody is let in.

import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { caretBehind, code, openPage, ready, serve, status } from '../studio.mjs';

const away = (page) => page.waitForSelector('text=Not connected', { timeout: 30_000 });
const back = (page) =>
  page.waitForFunction(() => !/Not connected/.test(document.body.innerText), null, {
    timeout: 30_000,
  });
const kill = (server) => server.kill();

/** All texts that the studio keeps for pages. */
function recovered(folder) {
  const pages = join(folder, '.gable/recovery/pages');
  if (!existsSync(pages)) return '';
  const files = readdirSync(pages, { recursive: true, withFileTypes: true });
  return files
    .filter((f) => f.isFile())
    .map((f) => readFileSync(join(f.parentPath ?? f.path, f.name), 'utf8'))
    .join('\n');
}

export default {
  /** The studio is killed and started again where it was: the page goes on by itself. */
  async aPageGoesOnWhenTheServerIsStartedAgain({ page, folder, server }) {
    await ready(page);
    await caretBehind(page, 'attr height = 9');
    await kill(server);
    await page.keyboard.type('.75');
    await away(page);
    const next = await serve(folder, server.port);
    try {
      await back(page);
      assert.match(await code(page).innerText(), /height = 9\.75/);
      await page.waitForFunction(
        () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '9.75',
      );
      assert.match(await status(page), /No problems/);
      await page.waitForTimeout(600);
      assert.match(recovered(folder), /height = 9\.75/);
      await page.keyboard.press('Control+s');
      await page.waitForSelector('.crumb .dirty', { state: 'detached' });
      assert.match(readFileSync(join(folder, 'journey.cga'), 'utf8'), /height = 9\.75/);
    } finally {
      await next.stop();
    }
    return { complaintsExpected: true };
  },

  /** The server is found by what keeps the text, before the page looks for it. */
  async aPageDerivesWhateverFindsTheServer({ page, folder, server }) {
    await ready(page);
    await caretBehind(page, 'attr height = 9');
    let up = false;
    let kept = false;
    await page.route('**/api/recovery**', async (route) => {
      while (!up) await new Promise((resolve) => setTimeout(resolve, 50));
      await route.continue();
      kept = true;
    });
    await page.route('**/api/project', (route) => (kept ? route.continue() : route.abort()));
    await kill(server);
    await page.keyboard.type('.75');
    await away(page);
    // Now the text is on its way.
    await page.waitForTimeout(600);
    const next = await serve(folder, server.port);
    up = true;
    try {
      await back(page);
      await page.waitForFunction(
        () => document.querySelector('#attr-height')?.getAttribute('aria-valuenow') === '9.75',
      );
      await page.waitForTimeout(600);
      assert.match(recovered(folder), /height = 9\.75/);
    } finally {
      await next.stop();
    }
    return { complaintsExpected: true };
  },

  /** Started again at another port, the studio answers at the one before as well. */
  async aTextIsFoundAtAnotherAddress({ page, folder, server }) {
    await ready(page);
    await caretBehind(page, 'attr height = 9');
    await kill(server);
    await page.keyboard.type('.5');
    await away(page);
    const next = await serve(folder, server.port === 65_535 ? 65_534 : server.port + 1);
    try {
      await back(page);
      await page.waitForTimeout(600);
      const other = await openPage(page.context().browser(), next.url);
      await ready(other.page);
      assert.match(await code(other.page).innerText(), /height = 9\.5/);
      await other.context.close();
    } finally {
      await next.stop();
    }
    return { complaintsExpected: true };
  },

  /** Even the page is closed before there is a server again: the browser has the text. */
  async aTextIsFoundThatNoServerHad({ page, context, folder, server }) {
    await ready(page);
    await caretBehind(page, 'attr height = 9');
    await kill(server);
    await page.keyboard.type('.125');
    await away(page);
    await page.close({ runBeforeUnload: false });
    const next = await serve(folder, server.port);
    try {
      const other = await context.newPage();
      await other.goto(next.url);
      await ready(other);
      assert.match(await code(other).innerText(), /height = 9\.125/);
      await other.close();
    } finally {
      await next.stop();
    }
    return { complaintsExpected: true };
  },

  async theCardOfModularBuildingsOpens({ page, folder }) {
    await ready(page);
    await page.keyboard.press('Alt+4');
    await page.waitForSelector('.gc');
    await page.locator('.gc', { hasText: 'GBBG' }).first().click();
    await page.waitForSelector('text=gbbg.gbbg', { timeout: 60_000 });
    await ready(page);
    assert.ok(existsSync(join(folder, 'gbbg/assets/Window.glb')));
    assert.ok(!existsSync(join(folder, 'gbbg/make_assets.sh')));
  },

  async aCardThatCannotBeOpenedSaysSo({ page, folder, pictured }) {
    await ready(page);
    // A file where the folder of shared rules would be.
    writeFileSync(join(folder, 'rules'), 'no folder\n');
    await page.keyboard.press('Alt+4');
    await page.waitForSelector('.gc');
    await page.locator('.gc', { hasText: 'Tower' }).first().click();
    await page.waitForSelector('.failed');
    assert.match(await page.locator('.failed').innerText(), /could not be opened/);
    const left = readdirSync(folder).filter((name) => !name.startsWith('.'));
    assert.deepEqual(left.sort(), ['journey.cga', 'rules'], 'nothing is left of the copy');
    assert.equal(await page.locator('.gc[disabled]').count(), 0);
    await pictured();
    await page.locator('.failed').getByRole('button', { name: 'Close' }).click();
    await page.waitForSelector('.failed', { state: 'detached' });
    return { complaintsExpected: true };
  },

  /** A link to a shared place in a browser that has never seen the studio. */
  async aLinkOpensInAnotherBrowser({ page, folder, server, pictured }) {
    await ready(page);
    mkdirSync(join(folder, 'models'));
    writeFileSync(
      join(folder, 'models/window.obj'),
      'mtllib window.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl glass\nf 1 2 3\n',
    );
    writeFileSync(join(folder, 'models/window.mtl'), 'newmtl glass\nKd 0.1 0.2 0.9\n');
    await page.waitForTimeout(2500);
    await caretBehind(page, 'Slab.');
    await page.keyboard.type('\nPane -->\n    i("models/window.obj")\n');
    await page.getByRole('button', { name: 'Share' }).click();
    await page.waitForFunction(() =>
      /#share=/.test(document.querySelector('#share-link')?.value ?? ''),
    );
    const link = await page.locator('#share-link').inputValue();
    const other = await openPage(page.context().browser(), link);
    await other.page.waitForSelector('.shared-page h1');
    assert.match(await other.page.locator('.shared-page').innerText(), /journey, a shared place/);
    assert.match(await other.page.locator('.shared-page').innerText(), /models\/window\.mtl/);
    assert.match(
      await other.page.locator('.shared-page').innerText(),
      /needs a studio[^]*gable studio/,
    );
    await pictured(other.page);
    const [download] = await Promise.all([
      other.page.waitForEvent('download'),
      other.page.getByRole('button', { name: 'Save as a file' }).click(),
    ]);
    assert.equal(download.suggestedFilename(), 'journey.gable.json');
    await other.page.getByLabel('Address of the studio').fill('http://example.org/?token=x');
    await other.page.getByRole('button', { name: 'Open' }).click();
    assert.match(await other.page.getByRole('alert').innerText(), /not the address/);
    await other.page.getByLabel('Address of the studio').fill(server.url);
    await other.page.getByRole('button', { name: 'Open' }).click();
    await other.page.waitForFunction(() =>
      /shared-journey/.test(document.querySelector('.crumb')?.textContent ?? ''),
    );
    await ready(other.page);
    assert.ok(existsSync(join(folder, 'shared-journey/models/window.mtl')));
    await other.context.close();
    return { complaintsExpected: true };
  },
};
