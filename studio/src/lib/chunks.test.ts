// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A server in a few lines: models are lists of chunks, each of triangles and boxes in some looks,
// and it sends what somebody who holds the one or the other does not have yet.

import { expect, it } from 'vitest';
import { updated, type Held } from './chunks';
import type { DrawList } from './protocol';

const NEW = 0xffffffff;
const LOOKS = [
  { roughness: 1, metallic: 0 },
  { roughness: 0.5, metallic: 0, map: 'wall.png' },
];

/** A triangle of a look, or an instance of the one geometry. */
interface Leaf {
  look: number;
  often: boolean;
  at: number;
}
type Model = Leaf[][];

const f32 = (...v: number[]) => [...new Uint32Array(Float32Array.from(v).buffer)];
const u16 = (...v: number[]) => [
  ...new Uint32Array(Uint16Array.from(v.length % 2 ? [...v, 0] : v).buffer),
];
const nameOf = (leaf: Leaf) => `${leaf.look} ${leaf.often}`;

function pieceOf(leaves: [Leaf, number][]): number[] {
  const [first] = leaves[0]!;
  if (first.often) {
    const matrices = leaves.flatMap(([l]) => [...Array<number>(15).fill(0), l.at]);
    const colors = leaves.map(([l]) => l.at);
    return [leaves.length, ...f32(...matrices), ...colors, ...f32(...leaves.map(([, n]) => n))];
  }
  const points = leaves.flatMap(([l]) => Array<number>(9).fill(l.at));
  const corners = leaves.flatMap((_, i) => [i * 3, i * 3 + 1, i * 3 + 2]);
  const uv = first.look === 1 ? f32(...leaves.flatMap(([l]) => Array<number>(6).fill(l.at))) : [];
  const runs = leaves.flatMap(([l, n]) => [n, l.at, 3, 3]);
  const normals = leaves.flatMap(([l]) => Array<number>(3).fill(l.at));
  const numbers = leaves.flatMap((_, i) => [i, i, i]);
  const counts = [leaves.length * 3, leaves.length * 3, leaves.length, leaves.length];
  const small = [...u16(...numbers), ...u16(...corners)];
  return [...counts, ...f32(...points), ...f32(...normals), ...uv, ...runs, ...small];
}

/** The bytes that bring somebody from one model to another. */
function encoded(model: Model, before: Model | null): ArrayBuffer {
  const batchesOf = (m: Model) => [...new Set(m.flat().map(nameOf))];
  const names = batchesOf(model);
  const known = before ? batchesOf(before) : [];
  const keys = before?.map((chunk) => JSON.stringify(chunk)) ?? [];
  const kept = model.map((chunk) => {
    const at = keys.indexOf(JSON.stringify(chunk));
    return at < 0 ? NEW : at;
  });
  const bodies = model.flatMap((chunk, i) => {
    if (kept[i] !== NEW) return [];
    const own = [...new Set(chunk.map(nameOf))];
    const pieces = own.flatMap((name) => [
      names.indexOf(name),
      ...pieceOf(chunk.map((l, n): [Leaf, number] => [l, n]).filter(([l]) => nameOf(l) === name)),
    ]);
    return [own.length, ...pieces];
  });
  const corner = f32(1, 2, 3);
  const geometry = [...corner, ...corner, 0, 0, 0, ...f32(7, 8)];
  const json = JSON.stringify({
    leaves: model.flat().length,
    looks: LOOKS,
    batches: names.map((name) => {
      const [look, often] = [Number(name[0]), name.endsWith('true')];
      if (known.includes(name)) return { look, kept: known.indexOf(name) };
      return often
        ? { look, position: [0, 3], normal: [12, 3], index: [24, 3], uv: [36, 2] }
        : { look };
    }),
    chunks: [geometry.length * 4, model.length],
  });
  const text = json.padEnd(Math.ceil(json.length / 4) * 4);
  const words = [...geometry, ...kept, ...model.map((c) => c.length), ...bodies];
  const out = new Uint8Array(8 + text.length + words.length * 4);
  out.set(new TextEncoder().encode('GBU2'));
  new DataView(out.buffer).setUint32(4, text.length, true);
  out.set(new TextEncoder().encode(text), 8);
  out.set(new Uint8Array(Uint32Array.from(words).buffer), 8 + text.length);
  return out.buffer;
}

/** A page: what it holds, and of which model. */
class Page {
  held: Held | null = null;
  model: Model | null = null;
  draw: DrawList | null = null;
  sent = 0;

  show(model: Model): void {
    const bytes = encoded(model, this.model);
    this.sent = bytes.byteLength;
    ({ draw: this.draw, held: this.held } = updated(bytes, 0, 1, this.held));
    this.model = model;
  }
}

/** The list without the pieces that it was put together from. */
function plain(list: DrawList | null): unknown {
  return { ...list, batches: list!.batches.map(({ pieces, ...rest }) => [rest, pieces!.length]) };
}

function whole(model: Model): unknown {
  const page = new Page();
  page.show(model);
  return plain(page.draw);
}

/** Draws from the same numbers each time. */
function dice(seed: number): (n: number) => number {
  return (n) => {
    seed = (seed * 1103515245 + 12345) % 2147483648;
    return Math.floor((seed / 2147483648) * n);
  };
}

const chunkOf = (roll: (n: number) => number): Leaf[] =>
  Array.from({ length: 1 + roll(5) }, () => ({
    look: roll(2),
    often: roll(2) === 1,
    at: roll(1000),
  }));

it('shows after many edits what a page shows that is opened then', () => {
  const roll = dice(7);
  const page = new Page();
  let model = Array.from({ length: 12 }, () => chunkOf(roll));
  const before: Model[] = [];
  for (let edit = 0; edit < 200; ++edit) {
    page.show(model);
    expect(plain(page.draw)).toEqual(whole(model));
    before.push(model);
    model = model.slice();
    const at = roll(model.length + 1);
    // Changed, removed, put in, undone, moved.
    const kind = roll(5);
    if (kind === 0 && at < model.length) model[at] = chunkOf(roll);
    if (kind === 1) model.splice(at, 1 + roll(3));
    if (kind === 2) model.splice(at, 0, chunkOf(roll), chunkOf(roll));
    if (kind === 3) model = before[roll(before.length)]!;
    if (kind === 4) model.unshift(...model.splice(at, 1));
  }
});

it('is sent little where little has changed', () => {
  const roll = dice(3);
  const page = new Page();
  const model = Array.from({ length: 200 }, () => chunkOf(roll));
  page.show(model);
  const all = page.sent;
  page.show([...model.slice(0, 100), chunkOf(roll), ...model.slice(101)]);
  expect(page.sent).toBeLessThan(all / 4);
  expect(plain(page.draw)).toEqual(whole(page.model!));
});

it('keeps what two pages hold apart', () => {
  const roll = dice(5);
  const [one, other] = [new Page(), new Page()];
  const models = Array.from({ length: 4 }, () => Array.from({ length: 9 }, () => chunkOf(roll)));
  for (const [i, model] of models.entries()) {
    one.show(model);
    if (i % 2) other.show([...model, ...models[0]!]);
  }
  expect(plain(one.draw)).toEqual(whole(one.model!));
  expect(plain(other.draw)).toEqual(whole(other.model!));
});

it('empties', () => {
  const page = new Page();
  page.show([chunkOf(dice(1))]);
  page.show([]);
  expect(page.draw!.batches).toEqual([]);
  page.show([chunkOf(dice(2))]);
  expect(plain(page.draw)).toEqual(whole(page.model!));
});
