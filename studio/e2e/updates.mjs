// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A large model that is edited: what a page puts together from updates is what a page gets that
// opens then. Two pages edit on one server; rules are broken in between, parts go and come back,
// answers get lost. `node e2e/updates.mjs`

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { writeFileSync } from 'node:fs';
import { createServer } from 'vite';
import { clean, project, root, serve } from './studio.mjs';

const RULES = `attr roof = 30
attr share = 0.5
const paint = "#aa8866"
Lot --> split(x) { { ~9 : split(z) { { ~9 : Plot }* } }* }
Plot -->
  case p(share): t(1, 0, 1) s(rand(5, 7), 0, rand(5, 7)) House
  else: Tree
House --> [ extrude(rand(3, 9)) comp(f) { top : NIL | side : Wall } ] Roof
Wall --> color(paint) split(x) { ~1 : Plain. | 1 : Window. | ~1 : Plain. }
Roof --> roofGable(roof, 0.3) Tiles.
Tree --> t('0.5, 0, '0.5) s(1, 5, 1) center(xz) primitiveCylinder(8) color("#446633") Leaves.
`;

const vite = await createServer({
  root: join(root, 'studio'),
  configFile: false,
  server: { middlewareMode: true },
  appType: 'custom',
});
const { decodeDerived } = await vite.ssrLoadModule('/src/lib/protocol.ts');
const folder = project();
writeFileSync(join(folder, 'rules.cga'), RULES);
const server = await serve(folder);

/** As EngineClient asks. */
class Page {
  held = null;
  draw = null;
  bytes = 0;

  constructor(name) {
    this.name = name;
  }

  async derive(text, { lost = false } = {}) {
    const answer = await fetch(`http://127.0.0.1:${server.port}/api/derive`, {
      method: 'POST',
      headers: { 'X-Gable-Token': server.token },
      body: JSON.stringify({
        page: this.name,
        file: 'rules.cga',
        text,
        overlay: {},
        start: '',
        seed: 1,
        attributes: {},
        shapes: { lot: [900, 900] },
        known: this.held?.derivation ?? 0,
      }),
    });
    assert.equal(answer.status, 200);
    const bytes = await answer.arrayBuffer();
    if (lost) return;
    this.bytes = bytes.byteLength;
    const { derived, draw, held } = decodeDerived(bytes, this.held);
    this.held = held;
    if (draw) this.draw = draw;
    return derived.end;
  }
}

let strangers = 0;

/** The list without what it was put together from. */
const plain = (list) => ({
  ...list,
  batches: list.batches.map(({ pieces, ...rest }) => ({ ...rest, pieces: pieces.length })),
});

async function sameAsOpened(page, text, what) {
  const stranger = new Page(`stranger ${++strangers}`);
  await stranger.derive(text);
  assert.ok(page.draw.leaves > 20_000);
  assert.deepEqual(plain(page.draw), plain(stranger.draw), what);
  return stranger.bytes;
}

try {
  const [one, other] = [new Page('one'), new Page('other')];
  await one.derive(RULES);
  await sameAsOpened(one, RULES, 'at first');

  const painted = RULES.replace('#aa8866', '#99bbcc');
  const fewer = RULES.replace('p(share)', 'p(share * clamp(scope.sx - 8, 0, 1))');
  const steeper = RULES.replace('roof = 30', 'roof = 40');
  const half = RULES.replace('Plot }* } }*', 'Plot }* } | ~9 : NIL }*');
  for (const [what, text] of Object.entries({ steeper, half, painted, fewer, undone: RULES })) {
    assert.equal(await one.derive(text), 'done', what);
    await sameAsOpened(one, text, what);
  }

  const before = one.draw;
  assert.equal(await one.derive('Lot --> extrude('), 'wrong');
  assert.equal(one.draw, before);
  await one.derive(steeper);
  await sameAsOpened(one, steeper, 'after a mistake');

  await other.derive(painted);
  await one.derive(RULES);
  await other.derive(half);
  await sameAsOpened(one, RULES, 'beside another page');
  await sameAsOpened(other, half, 'the other page');

  // The server has gone on, and forgets what the page still holds.
  await one.derive(painted, { lost: true });
  await one.derive(steeper);
  await sameAsOpened(one, steeper, 'after an answer that was lost');
  for (let i = 0; i < 5; ++i) await one.derive(i % 2 ? painted : half, { lost: true });
  await one.derive(RULES);
  await sameAsOpened(one, RULES, 'after many that were lost');

  // One tree is painted: hardly anything is sent.
  await one.derive(RULES.replace('Tree --> ', 'Tree -->\n  case p(0.002): Bare.\n  else: '));
  const news = one.bytes;
  const all = await sameAsOpened(
    one,
    RULES.replace('Tree --> ', 'Tree -->\n  case p(0.002): Bare.\n  else: '),
    'some trees are bare',
  );
  console.log(`${one.draw.leaves} leaves: ${all} bytes at first, ${news} of an edit`);
  assert.ok(news * 4 < all);

  // A small model comes whole, and the large one after it.
  const small = 'Lot --> extrude(9) Box.';
  await one.derive(small);
  assert.equal(one.draw.leaves, 1);
  await one.derive(painted);
  await sameAsOpened(one, painted, 'after a small one');
} finally {
  await server.stop();
  await vite.close();
  clean(folder);
}
