// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Starts `gable studio` on a new folder and a browser on its page.

import { spawn } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { chromium } from 'playwright-core';

export const CHROMIUM = process.env.GABLE_CHROMIUM ?? '/usr/bin/chromium';
export const root = new URL('../..', import.meta.url).pathname;
export const gable = process.env.GABLE ?? join(root, 'build/dev/gable');

export const hasBrowser = () => existsSync(CHROMIUM);

/** A copy of some examples, with the rules that they share, in a folder of its own. */
export function project(...examples) {
  // The page shows the folder's name.
  const folder = join(mkdtempSync(join(tmpdir(), 'gable-studio-')), 'places');
  mkdirSync(folder);
  for (const name of examples.length ? [...examples, 'rules'] : []) {
    cpSync(join(root, 'examples', name), join(folder, name), { recursive: true });
  }
  return folder;
}

export async function serve(folder, port = 0) {
  const child = spawn(gable, ['studio', folder, '--port', String(port)], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const url = await new Promise((resolve, reject) => {
    let text = '';
    child.stdout.on('data', (data) => {
      text += data;
      if (text.includes('\n')) resolve(text.trim());
    });
    child.on('exit', (code) => reject(new Error(`gable studio ended with ${code}`)));
  });
  const at = new URL(url);
  return {
    url,
    port: Number(at.port),
    pid: child.pid,
    token: at.searchParams.get('token'),
    /** Ends it without a chance to put anything away. */
    kill: () =>
      new Promise((resolve) => {
        child.on('exit', resolve);
        child.kill('SIGKILL');
      }),
    stop: () =>
      new Promise((resolve) => {
        if (child.exitCode !== null || child.signalCode !== null) return resolve();
        child.on('exit', resolve);
        child.kill('SIGINT');
      }),
  };
}

export async function launch() {
  return chromium.launch({
    executablePath: CHROMIUM,
    args: [
      '--no-sandbox',
      '--use-angle=gl-egl',
      '--ignore-gpu-blocklist',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--hide-scrollbars',
    ],
  });
}

/** A page at 1280 x 720 that collects what the console complains about. */
export async function openPage(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options });
  // Machines that do other things as well are slow.
  context.setDefaultTimeout(60_000);
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (m) => {
    if (m.type() === 'error' || (m.type() === 'warning' && !/GPU stall|GL Driver/.test(m.text())))
      complaints.push(m.text());
  });
  page.on('pageerror', (e) => complaints.push(String(e)));
  await page.goto(url);
  return { page, context, complaints };
}

/** How often the view has drawn something new. */
export const drawn = (page) =>
  page.locator('canvas').first().getAttribute('data-drawn').then(Number);

export async function untilDrawn(page, before) {
  await page.waitForFunction(
    (n) => Number(document.querySelector('canvas')?.dataset.drawn ?? 0) > n,
    before,
    { timeout: 60_000 },
  );
}

export const clean = (folder) => rmSync(dirname(folder), { recursive: true, force: true });

/** Waits until the view is as good as it gets, where there is one. */
export async function untilRefined(page, timeout = 60_000) {
  await page.waitForFunction(
    () => {
      const canvas = document.querySelector('.stage canvas');
      return !canvas || canvas.dataset.refined === canvas.dataset.drawn;
    },
    null,
    { timeout },
  );
}

export const status = (page) => page.locator('.status').innerText();
export const rows = (page) => page.locator('.tree .tr');
export const code = (page) => page.locator('.cm-content');

/** Waits for the first model and its tree. */
export async function ready(page) {
  await page.waitForSelector('.tree .tr', { timeout: 60_000 });
}

/** Puts the caret behind a text of the editor, which must be in sight. */
export async function caretBehind(page, text) {
  await code(page).focus();
  await page.keyboard.press('Control+f');
  await page.locator('.cm-search input[name=search]').pressSequentially(text);
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  await page.keyboard.press('ArrowRight');
}

/** Where a rule set of one lot of its own is enough. */
export const HOUSE = `@Group("Size") @Range(min=3, max=30)
attr height = 9
@Group("Size") @Enum("red", "blue")
attr paint = "red"

@StartRule
Lot -->
    extrude(height)
    comp(f) { side : Wall | top : Roof }

Wall -->
    color(case paint == "red" : "#b4674c"
          else : "#6d8aa3")
    Face.

Roof -->
    color("#7c8085")
    Slab.
`;

/**
 * A picture of the view as it is now. A locator's own screenshot waits until its element stands
 * still, which takes a busy machine longer than it should.
 */
export async function viewPixels(page, canvas = 'canvas') {
  return page.screenshot({ clip: await page.locator(canvas).first().boundingBox() });
}
