// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Starts `gable studio` on a new folder and a browser on its page.

import { spawn } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

export const CHROMIUM = process.env.GABLE_CHROMIUM ?? '/usr/bin/chromium';
export const root = new URL('../..', import.meta.url).pathname;
export const gable = process.env.GABLE ?? join(root, 'build/dev/gable');

export const hasBrowser = () => existsSync(CHROMIUM);

/** A copy of some examples in a folder of its own. */
export function project(...examples) {
  const folder = mkdtempSync(join(tmpdir(), 'gable-studio-'));
  for (const name of examples) {
    cpSync(join(root, 'examples', name), join(folder, name), { recursive: true });
  }
  return folder;
}

export async function serve(folder, port = 0) {
  const child = spawn(gable, ['studio', folder, '--port', String(port)], { stdio: ['ignore', 'pipe', 'inherit'] });
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
    token: at.searchParams.get('token'),
    stop: () =>
      new Promise((resolve) => {
        if (child.exitCode !== null) return resolve();
        child.on('exit', resolve);
        child.kill('SIGINT');
      }),
  };
}

export async function launch() {
  return chromium.launch({
    executablePath: CHROMIUM,
    args: [
      '--no-sandbox', '--use-angle=gl-egl', '--ignore-gpu-blocklist', '--disable-quic', '--no-first-run',
      '--disable-background-networking', '--disable-component-update', '--disable-sync', '--hide-scrollbars',
    ],
  });
}

/** A page at 1280 x 720 that collects what the console complains about. */
export async function openPage(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (m) => {
    if (m.type() === 'error' || (m.type() === 'warning' && !/GPU stall|GL Driver/.test(m.text()))) complaints.push(m.text());
  });
  page.on('pageerror', (e) => complaints.push(String(e)));
  await page.goto(url);
  return { page, context, complaints };
}

/** How often the view has drawn something new. */
export const drawn = (page) => page.locator('canvas').first().getAttribute('data-drawn').then(Number);

export async function untilDrawn(page, before) {
  await page.waitForFunction((n) => Number(document.querySelector('canvas')?.dataset.drawn ?? 0) > n, before, { timeout: 60_000 });
}

export const clean = (folder) => rmSync(folder, { recursive: true, force: true });
