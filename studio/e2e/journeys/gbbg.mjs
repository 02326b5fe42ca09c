// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// GBBG by hand, as its own editor did it: each journey writes or changes a small grammar, most of
// it in the form, and reads the shapes that come of it. Journeys are named after the rows of the
// acceptance table.

import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { asText, form, openByPalette } from '../hands.mjs';
import { caretBehind, drawn, ready, untilDrawn } from '../studio.mjs';

async function open({ page, folder }, rules) {
  writeFileSync(join(folder, 'by_hand.gbbg'), rules);
  await ready(page);
  await openByPalette(page, 'by_hand.gbbg');
}

/** The palette's lines of shapes, as { name: how many }. */
async function counts(page) {
  await page.keyboard.press('Control+k');
  await page.getByRole('combobox', { name: 'Search or run' }).fill('#');
  const lines = await page
    .locator('.pal-list [role=option]')
    .evaluateAll((all) =>
      all.map((o) => [
        o.querySelector('b').textContent,
        Number(o.querySelector('.faint').textContent.replace(/\D/g, '') || 1),
      ]),
    );
  await page.keyboard.press('Escape');
  await page.waitForSelector('.pal', { state: 'detached' });
  return Object.fromEntries(lines);
}

/** Looks until what is read is as it should be; a derivation takes its time. */
async function becomes(read, wanted, what = '') {
  const end = Date.now() + 60_000;
  for (;;) {
    const got = await read();
    try {
      assert.deepEqual(got, wanted, what);
      return;
    } catch (error) {
      if (Date.now() > end) throw error;
    }
    await new Promise((go) => setTimeout(go, 300));
  }
}

const countOf = async (page, ...names) => {
  const all = await counts(page);
  return names.map((n) => all[n] ?? 0);
};

/** Selects the first shape of a name and opens what is known of it. */
async function select(page, name) {
  await becomes(async () => (await countOf(page, name))[0] > 0, true, name);
  await page.keyboard.press('Control+k');
  await page.getByRole('combobox', { name: 'Search or run' }).fill(`#${name}`);
  await page
    .locator('.pal-list [role=option]')
    .filter({ has: page.locator('b', { hasText: new RegExp(`^${name}$`) }) })
    .first()
    .click();
  await page.getByRole('tab', { name: 'Shape' }).click();
}

const triple = (page, label) =>
  page.evaluate((l) => {
    const row = [...document.querySelectorAll('aside .fld')].find(
      (f) => f.querySelector('.label')?.textContent === l,
    );
    return row
      ? [...row.querySelectorAll('.xyz .num')].map((n) => Number(n.textContent.replace(/\s/g, '')))
      : [];
  }, label);
async function size(page, name, wanted) {
  await select(page, name);
  await becomes(() => triple(page, 'Size'), wanted, `size of ${name}`);
}
const place = (page) => triple(page, 'Position');

async function inForm(page, rule) {
  await form(page);
  await page.locator('.rule-list .tr', { hasText: rule }).first().click();
}
async function number(page, label, value) {
  const field = page.getByLabel(label, { exact: true });
  await field.press('Enter');
  await page.keyboard.press('Control+a');
  await page.keyboard.type(String(value));
  await page.keyboard.press('Enter');
}
const button = (page, name) => page.getByRole('button', { name, exact: true }).click();
/** Opens the list of problems once there are any. */
async function openProblems(page) {
  await page.waitForFunction(() =>
    /warning|error/.test(document.querySelector('.status')?.textContent ?? ''),
  );
  for (let i = 0; i < 5 && !(await page.locator('.prob').count()); ++i) {
    await page.keyboard.press('Control+j');
    await page.waitForTimeout(500);
  }
}
const problems = (page) => page.locator('.problems').innerText();

export default {
  async G1_scopesHaveTheirRootAtTheLeastCorner(at) {
    const { page } = at;
    await open(
      at,
      'axiom START at (1, 2, 3) size (4, 5, 6)\nterminal Box\nSTART -> Scope() {Box}\n',
    );
    await size(page, 'Box', [4, 5, 6]);
    const before = await place(page);
    assert.deepEqual(before.slice(0, 2), [1, 2]);
    // The box keeps its root and grows to the right, upward and away: z of the original is -z here.
    await caretBehind(page, 'size (4');
    await page.keyboard.type('0');
    await size(page, 'Box', [40, 5, 6]);
    assert.deepEqual(await place(page), before);
  },

  async G2_terminalsStayAndPreferTheirSize(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (12, 3, 3)\nterminal Wall [3, 0, 0]\nterminal Brick\nSTART -> Repeat(X) {Wall}\nWall -> Repeat(X) {Brick}\n',
    );
    await becomes(() => countOf(page, 'Wall', 'Brick'), [4, 0]);
    await caretBehind(page, 'Wall [3');
    await page.keyboard.press('Backspace');
    await page.keyboard.type('2');
    await becomes(() => countOf(page, 'Wall', 'Brick'), [6, 0]);
    await openProblems(page);
    await page.waitForFunction(() =>
      /Wall/.test(document.querySelector('.problems')?.innerText ?? ''),
    );
  },

  async G3_chancesAreShares(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (300, 3, 3)\nterminal One [1, 0, 0], Two [1, 0, 0]\nSTART -> Repeat(X) {One}\n',
    );
    await becomes(() => countOf(page, 'One', 'Two'), [300, 0]);
    await inForm(page, 'START');
    await page.getByRole('button', { name: 'Add a possibility for successor' }).click();
    await page.getByLabel('Successor successor 2').fill('Two');
    await page.getByLabel('Successor successor 2').press('Enter');
    await number(page, 'Chance of Two', 2);
    await page.waitForFunction(
      () =>
        /33 %/.test(document.querySelector('.form')?.innerText ?? '') &&
        /67 %/.test(document.querySelector('.form').innerText),
    );
    // Of 300 draws a third, and the same ones each time.
    await becomes(async () => {
      const [one, two] = await countOf(page, 'One', 'Two');
      return one + two === 300 && one > 70 && one < 130;
    }, true);
  },

  async G4_scopesMoveTurnAndResizeByToggles(at) {
    const { page } = at;
    await open(at, 'axiom START size (4, 5, 6)\nterminal Box\nSTART -> Scope() {Box}\n');
    await size(page, 'Box', [4, 5, 6]);
    const before = await place(page);
    await inForm(page, 'START');
    await page.getByRole('switch', { name: 'Move' }).click();
    await number(page, 'Move X', 2);
    await becomes(() => place(page), [before[0] + 2, before[1], before[2]]);
    await page.getByRole('switch', { name: 'Move' }).click();
    await becomes(() => place(page), before);
    await page.getByRole('switch', { name: 'Resize' }).click();
    await number(page, 'Resize Y', 3);
    await becomes(() => triple(page, 'Size'), [4, 8, 6]);
    await number(page, 'Resize X', 1);
    await number(page, 'Resize Z', 2);
    await becomes(() => triple(page, 'Size'), [5, 8, 8]);
    await page
      .getByRole('group', { name: 'Resize: space' })
      .getByRole('button', { name: 'Relative' })
      .click();
    await becomes(() => triple(page, 'Size'), [4, 15, 12]);
    await page
      .getByRole('group', { name: 'Resize: add or set' })
      .getByRole('button', { name: 'Set' })
      .click();
    await number(page, 'Resize Z', -1);
    await becomes(() => triple(page, 'Size'), [1, 3, 6]);
    await page.getByRole('switch', { name: 'Turn' }).click();
    await number(page, 'Turn Y', 90);
    await asText(page);
    await page.waitForFunction(() =>
      /R\(0, 90, 0, Add, Local\)/.test(document.querySelector('.cm-content')?.textContent ?? ''),
    );
    await becomes(() => triple(page, 'Size'), [1, 3, 6]);
  },

  async G5_dimensionsComeAndGoWithSizes(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (4, 5, 6)\nshape Flat 2D\nterminal Box\nSTART -> Scope(S(4, 5, 0, Set)) {Flat}\nFlat -> Scope(S(-1, 7, 2, Set)) {Box}\n',
    );
    await size(page, 'Flat', [4, 5, 0]);
    await size(page, 'Box', [4, 7, 2]);
  },

  async G6_splitsAreCountedFromOrToTheRoot(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (30, 3, 3)\nterminal A, B\nSTART -> Split(X, {7}, FromRoot) {A | B}\n',
    );
    await size(page, 'B', [23, 3, 3]);
    await size(page, 'A', [7, 3, 3]);
    const first = (await place(page))[0];
    await inForm(page, 'START');
    await button(page, 'to the root');
    await becomes(() => place(page).then((p) => p[0]), first + 23);
    assert.deepEqual(await triple(page, 'Size'), [7, 3, 3]);
  },

  async G7_whatDoesNotFitIsCutAndTold(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (30, 3, 3)\nterminal A, B, C\nSTART -> Split(X, {20}, FromRoot) {A | B}\n',
    );
    await inForm(page, 'START');
    await button(page, 'Piece');
    await number(page, 'Width 2', 20);
    await page.getByLabel('Successor 20 m 1').nth(1).fill('C');
    await page.getByLabel('Successor 20 m 1').nth(1).press('Enter');
    await size(page, 'C', [10, 3, 3]);
    await becomes(() => countOf(page, 'A', 'B', 'C'), [1, 0, 1]);
    await asText(page);
    await openProblems(page);
    await becomes(async () => /cut|reach|fit|long/i.test(await problems(page)), true);
  },

  async G8_repeatsAreEqualAndRounded(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (30, 3, 3)\nterminal Tile [4, 0, 0]\nSTART -> Repeat(X) {Tile}\n',
    );
    await becomes(() => countOf(page, 'Tile'), [8]);
    await size(page, 'Tile', [3.75, 3, 3]);
    await caretBehind(page, 'size (30');
    await page.keyboard.press('Backspace');
    await page.keyboard.press('Backspace');
    await page.keyboard.type('1');
    await becomes(() => countOf(page, 'Tile'), [1]);
  },

  async G9_gridsDivideTwoAxes(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (23, 3, 23)\nterminal Tile [4, 4, 4]\nSTART -> Grid(Y) {Tile}\n',
    );
    await becomes(() => countOf(page, 'Tile'), [36]);
    await inForm(page, 'START');
    await page.getByRole('group', { name: 'Axis' }).getByRole('button', { name: 'X' }).click();
    // Three metres of height are one row.
    await becomes(() => countOf(page, 'Tile'), [6]);
  },

  async G10_marginsHaveCornersEdgesAndACentre(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (10, 3, 10)\nterminal Corner [3, 0, 3], Edge, Middle\nSTART -> Margin(Y, Absolute, 2, Default, Center) {Corner | Edge | Middle}\n',
    );
    await becomes(() => countOf(page, 'Corner', 'Edge', 'Middle'), [4, 4, 1]);
    await size(page, 'Middle', [6, 3, 6]);
    await inForm(page, 'START');
    await number(page, 'Width of the margin', 0);
    // Of its own accord as wide as a corner wants to be.
    await becomes(() => triple(page, 'Size'), [4, 3, 4]);
    await page.getByRole('switch', { name: 'Centre' }).click();
    await becomes(() => countOf(page, 'Corner', 'Edge', 'Middle'), [4, 4, 0]);
    await button(page, 'as a share');
    await number(page, 'Width of the margin', 0.5);
    await becomes(() => countOf(page, 'Corner', 'Edge', 'Middle'), [4, 0, 0]);
  },

  async G11_edgesFaceOutward(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (12, 3, 10)\nterminal Corner, Edge, Piece [1, 0, 0]\nSTART -> Margin(Y, Absolute, 2, Default, NoCenter) {Corner | Side}\nSide -> Repeat(X) {Piece}\n',
    );
    // Two edges of 8 m along x and two of 2 m.
    await becomes(() => countOf(page, 'Piece'), [20]);
    await inForm(page, 'START');
    await page.locator('#gbbg-out').selectOption('FacingOut');
    // Each along its own x: 8 + 8 + 6 + 6.
    await becomes(() => countOf(page, 'Piece'), [28]);
  },

  async G12_componentsAreFacesByMode(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (4, 5, 6)\nterminal Side 2D, Top 2D, Bottom 2D\nSTART -> Component(Y, AllFaces) {Side | Top | Bottom}\n',
    );
    await becomes(() => countOf(page, 'Side', 'Top', 'Bottom'), [4, 1, 1]);
    await size(page, 'Top', [4, 6, 0]);
    await inForm(page, 'START');
    for (const [mode, found] of [
      ['Sides', [4, 0, 0]],
      ['SidesPlusTop', [4, 1, 0]],
      ['Top', [0, 1, 0]],
    ]) {
      await page.locator('#gbbg-faces').selectOption(mode);
      // The form is read again, with as many successors as the faces take.
      const fields = page.locator('input[aria-label^=Successor]');
      await becomes(() => fields.count(), found.filter((n) => n > 0).length, mode);
      if (mode === 'SidesPlusTop') {
        await page.getByLabel('Successor top 1').fill('Top');
        await page.getByLabel('Successor top 1').press('Enter');
      }
      if (mode === 'Top') {
        await page.getByLabel('Successor top 1').fill('Top');
        await page.getByLabel('Successor top 1').press('Enter');
      }
      await becomes(() => countOf(page, 'Side', 'Top', 'Bottom'), found, mode);
    }
  },

  async G13_theFirstRuleThatFitsCounts(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (4, 5, 6)\nterminal A, B\nSTART -> Scope() {A}\nSTART -> Scope() {B}\n',
    );
    await becomes(() => countOf(page, 'A', 'B'), [1, 0]);
    await caretBehind(page, 'terminal A, B');
    await page.keyboard.press('Enter');
    await page.keyboard.type('select random');
    // Some seed takes the second one.
    const seen = new Set();
    for (let seed = 1; seed < 30 && seen.size < 2; ++seed) {
      const before = await drawn(page);
      await page.getByRole('tab', { name: 'Attributes' }).click();
      await number(page, 'Seed', seed);
      await untilDrawn(page, before);
      await page.waitForTimeout(600);
      await becomes(async () => (await countOf(page, 'A', 'B')).reduce((a, b) => a + b), 1);
      seen.add((await countOf(page, 'A', 'B')).join());
    }
    assert.deepEqual([...seen].sort(), ['0,1', '1,0']);
  },

  async G14_whatHasNoRuleOrNoEndIsTold(at) {
    const { page } = at;
    await open(at, 'axiom START size (4, 5, 6)\nSTART -> Scope() {Nobody}\n');
    await becomes(() => countOf(page, 'Nobody'), [1]);
    await openProblems(page);
    await becomes(async () => /Nobody/.test(await problems(page)), true);
    await caretBehind(page, '{Nobody}');
    await page.keyboard.press('Enter');
    await page.keyboard.type('Nobody -> Scope(T(1, 0, 0)) {Nobody}');
    await page.waitForFunction(
      () => /limit/i.test(document.querySelector('.status')?.textContent ?? ''),
      null,
      { timeout: 120_000 },
    );
    await becomes(async () => /Nobody/.test(await problems(page)), true);
  },

  async G15_modelsTakeThePlaceOfSymbols(at) {
    const { page, folder } = at;
    mkdirSync(join(folder, 'assets'));
    // A pyramid of five faces over a square metre.
    writeFileSync(
      join(folder, 'assets/spike.obj'),
      'v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0.5 1 0.5\nf 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n',
    );
    await open(at, 'axiom START size (4, 5, 6)\nterminal Box\nSTART -> Scope() {Box}\n');
    await size(page, 'Box', [4, 5, 6]);
    const faces = () =>
      page.evaluate(
        () =>
          [...document.querySelectorAll('aside .fld')]
            .find((f) => f.querySelector('.label')?.textContent === 'faces')
            ?.querySelector('.num')?.textContent,
      );
    await becomes(faces, '6');
    await form(page);
    await page.waitForFunction(() =>
      [...document.querySelectorAll('[aria-label="Add an asset for"] option')].some(
        (o) => o.value === 'Box',
      ),
    );
    await page.getByLabel('Add an asset for').selectOption('Box');
    assert.match(await page.getByLabel('Asset of Box', { exact: true }).inputValue(), /spike\.obj/);
    await becomes(async () => {
      await select(page, 'Box');
      return faces();
    }, '5');
    assert.deepEqual(await triple(page, 'Size'), [4, 5, 6]);
    await page.getByRole('tab', { name: 'Attributes' }).click();
    await page.getByRole('switch', { name: 'postProcess' }).click();
    await becomes(async () => {
      await select(page, 'Box');
      return faces();
    }, '6');
  },

  async G18_anAxiomHasSeveralShapes(at) {
    const { page } = at;
    await open(at, 'axiom START size (4, 5, 6)\nterminal Box\nSTART -> Scope() {Box}\n');
    await becomes(() => countOf(page, 'Box'), [1]);
    await caretBehind(page, 'size (4, 5, 6)');
    await page.keyboard.type(', START at (10, 0, 0) size (1, 1, 1)');
    await becomes(() => countOf(page, 'Box'), [2]);
  },

  async G19_stepsGoForwardsAndBackwards(at) {
    const { page } = at;
    await open(
      at,
      'axiom START size (8, 3, 3)\nterminal Brick [2, 0, 0]\nSTART -> Split(X, {4}, FromRoot) {Wall | Wall}\nWall -> Repeat(X) {Brick}\n',
    );
    await becomes(() => countOf(page, 'Wall', 'Brick'), [2, 4]);
    await page.locator('.stage canvas').focus();
    await page.keyboard.press('g');
    await page.waitForSelector('.guide .lane');
    const step = () =>
      page
        .locator('.guide .step b')
        .innerText()
        .then((t) => Number(t.replace(/\D/g, '')));
    const said = async () => [
      await page.locator('.guide .lane').getAttribute('aria-valuetext'),
      await page.locator('aside .scroll').innerText(),
    ];
    await page.getByRole('tab', { name: 'Shape' }).click();
    await page.locator('.stage canvas').focus();
    await page.keyboard.press('Home');
    await becomes(step, 0);
    const last = await page.locator('.guide .lane').getAttribute('aria-valuemax').then(Number);
    assert.ok(last >= 3, String(last));
    const seen = [null];
    for (let i = 1; i <= last; ++i) {
      await page.keyboard.press('.');
      await becomes(step, i);
      seen.push(await said());
    }
    // Each rule applied is one step: the axiom becomes two walls, each wall two bricks.
    assert.match(seen[2].join(), /replaces START[^]*Wall\s+2/);
    assert.match(seen[3].join(), /replaces Wall[^]*Brick\s+2/);
    for (let i = last; i >= 1; --i) {
      assert.deepEqual(await said(), seen[i], `step ${i}`);
      if (i === 3) await at.pictured();
      await page.keyboard.press(',');
      await becomes(step, i - 1);
    }
  },
};
