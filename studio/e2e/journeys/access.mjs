// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a page must be for everybody: text that reads on its ground in both themes (WCAG AA), a name
// for each control, and a way to everything with keys alone.

import assert from 'node:assert/strict';
import { ready } from '../studio.mjs';

/**
 * Texts with too little contrast, and controls without a name; computed from what is on the page.
 */
function faults() {
  const out = [];
  const probe = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const rgba = (css) => {
    probe.clearRect(0, 0, 1, 1);
    probe.fillStyle = css;
    probe.fillRect(0, 0, 1, 1);
    return [...probe.getImageData(0, 0, 1, 1).data].map((v, i) => (i < 3 ? v : v / 255));
  };
  const over = (top, below) =>
    [0, 1, 2].map((i) => top[i] * top[3] + below[i] * (1 - top[3])).concat(1);
  const groundOf = (element) => {
    const layers = [];
    for (let e = element; e; e = e.parentElement) {
      const color = rgba(getComputedStyle(e).backgroundColor);
      if (color[3] > 0) layers.push(color);
      if (color[3] > 0.995) break;
    }
    const root = getComputedStyle(document.documentElement);
    let ground = rgba(
      root.getPropertyValue(element.closest('.stage') ? '--view-ground' : '--bg').trim(),
    );
    for (const layer of layers.reverse()) ground = over(layer, ground);
    return ground;
  };
  const luminance = (c) =>
    c
      .slice(0, 3)
      .map((v) => v / 255)
      .map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
      .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const contrast = (a, b) => {
    const [x, y] = [luminance(a), luminance(b)].sort((p, q) => q - p);
    return (x + 0.05) / (y + 0.05);
  };
  const seen = (e) => {
    const box = e.getBoundingClientRect();
    return (
      box.width > 1 &&
      box.height > 1 &&
      box.bottom > 0 &&
      box.top < innerHeight &&
      getComputedStyle(e).visibility !== 'hidden'
    );
  };
  for (const e of document.querySelectorAll('body *')) {
    const text = [...e.childNodes]
      .filter((n) => n.nodeType === 3)
      .map((n) => n.textContent.trim())
      .join(' ')
      .trim();
    if (!text || !seen(e) || e.closest('[disabled], .sr, svg, style, script')) continue;
    const style = getComputedStyle(e);
    const ground = groundOf(e);
    const ink = rgba(style.color);
    ink[3] *= Number(style.opacity);
    const large =
      parseFloat(style.fontSize) >= 24 ||
      (parseFloat(style.fontSize) >= 18.7 && Number(style.fontWeight) >= 700);
    const ratio = contrast(over(ink, ground), ground);
    if (ratio < (large ? 3 : 4.5) - 0.005)
      out.push(`${ratio.toFixed(2)} «${text.slice(0, 30)}» ${e.className || e.tagName}`);
  }
  for (const e of document.querySelectorAll(
    'button, a[href], input, select, [role=slider], [role=tree], canvas[tabindex]',
  )) {
    if (!seen(e)) continue;
    const label = e.id && document.querySelector(`label[for="${CSS.escape(e.id)}"]`);
    const name =
      e.getAttribute('aria-label') ||
      e.getAttribute('title') ||
      label?.textContent ||
      e.closest('label')?.textContent ||
      e.textContent;
    if (!name?.trim()) out.push(`no name: ${e.outerHTML.slice(0, 100)}`);
  }
  return [...new Set(out)];
}

/** The same where a dialog is over the button of themes. */
export async function legible(page, where) {
  const theme = await page.evaluate(() => document.documentElement.dataset.theme);
  for (const each of ['light', 'dark']) {
    await page.evaluate((name) => (document.documentElement.dataset.theme = name), each);
    await page.waitForTimeout(150);
    assert.deepEqual(await page.evaluate(faults), [], `${where}, ${each}`);
  }
  await page.evaluate((name) => (document.documentElement.dataset.theme = name), theme);
}

async function inBothThemes(page, where) {
  for (let i = 0; i < 2; ++i) {
    await page.waitForTimeout(150);
    const theme = await page.evaluate(() => document.documentElement.dataset.theme);
    assert.deepEqual(await page.evaluate(faults), [], `${where}, ${theme}`);
    await page.getByRole('button', { name: 'Light or dark' }).click();
  }
}

export default {
  async allTextIsLegibleInBothThemes({ page, pictured }) {
    await ready(page);
    await inBothThemes(page, 'attributes');
    await page.locator('.tree .tr').first().click();
    await page.getByRole('tab', { name: 'Shape' }).click();
    await inBothThemes(page, 'shape');
    await page.getByRole('button', { name: 'Light or dark' }).click();
    await pictured();
    await page.getByRole('button', { name: 'Light or dark' }).click();
    await page.locator('.stage canvas').focus();
    await page.keyboard.press('g');
    await page.waitForSelector('.guide .lane');
    await page.keyboard.press('Home');
    await inBothThemes(page, 'guide');
    await page.locator('.guide .lane').focus();
    await page.keyboard.press('ArrowRight');
    await page.waitForSelector('.words');
    await inBothThemes(page, 'a step');
    await page.locator('.stage canvas').focus();
    await page.keyboard.press('g');
    await page.keyboard.press('m');
    await page.waitForSelector('.lot-help');
    await inBothThemes(page, 'measuring');
    await page.keyboard.press('Escape');
    await page.keyboard.press('Alt+4');
    await page.waitForSelector('.gc');
    await inBothThemes(page, 'gallery');
  },

  /** From the top of the page to a picked shape and back without a pointer. */
  async keysAloneReachEverything({ page }) {
    await ready(page);
    const reached = new Set();
    await page.evaluate(() => document.activeElement?.blur());
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press('Tab');
      const name = await page.evaluate(() => {
        const e = document.activeElement;
        // The editor keeps Tab for itself; Escape and Tab leave it.
        if (e?.closest('.cm-content')) return 'editor';
        return e?.getAttribute('aria-label') || e?.id || e?.textContent?.trim().slice(0, 20) || '';
      });
      if (name === 'editor') await page.keyboard.press('Escape');
      reached.add(name);
    }
    for (const name of [
      'Gallery',
      'Rules',
      'Light or dark',
      'Export',
      'editor',
      'The model',
      'Measure',
      'Shapes',
      'Wireframe',
      'Seed',
    ]) {
      assert.ok(
        [...reached].some((r) => r.startsWith(name)),
        `${name} among ${[...reached].join(', ')}`,
      );
    }
    await page.locator('[role=tree]').focus();
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('ArrowDown');
    await page.waitForSelector('.tr.on');
    const first = await page.locator('.tr.on').innerText();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    assert.notEqual(await page.locator('.tr.on').innerText(), first);
    assert.match(await page.locator('.stage [aria-live]').innerText(), / m$/);
  },
};
