// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { decodeDerived, decodeTree } from './protocol';

function message(mark: string, json: unknown, rest: Uint8Array = new Uint8Array()): Uint8Array {
  let text = JSON.stringify(json);
  text += ' '.repeat((4 - (text.length % 4)) % 4);
  const out = new Uint8Array(8 + text.length + rest.length);
  out.set(new TextEncoder().encode(mark));
  new DataView(out.buffer).setUint32(4, text.length, true);
  out.set(new TextEncoder().encode(text), 8);
  out.set(rest, 8 + text.length);
  return out;
}
const bytes = (a: ArrayBufferView) => new Uint8Array(a.buffer);
const join = (...parts: Uint8Array[]) => Uint8Array.from(parts.flatMap((p) => [...p]));

it('reads a derivation with its draw list', () => {
  const blob = join(
    bytes(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0])),
    bytes(new Uint32Array([0, 1, 2])),
    bytes(new Uint8Array([9, 8, 7, 255])),
    bytes(new Float32Array([4])),
  );
  const head = {
    leaves: 5,
    truncated: false,
    looks: [{ roughness: 1, metallic: 0 }],
    batches: [
      { look: 0, position: [0, 9], normal: [0, 9], index: [36, 3], color: [48, 1], leaf: [52, 1] },
    ],
  };
  const { derived, draw } = decodeDerived(
    message('GBS1', { end: 'done', derivation: 3 }, message('GBL1', head, blob))
      .buffer as ArrayBuffer,
  );
  expect(derived.derivation).toBe(3);
  expect([...draw!.batches[0]!.index]).toEqual([0, 1, 2]);
  expect([...draw!.batches[0]!.color]).toEqual([9, 8, 7, 255]);
  expect(draw!.batches[0]!.leaf[0]).toBe(4);
  expect(draw!.batches[0]!.matrix).toBeUndefined();
});

it('reads wrong rules without one', () => {
  const { derived, draw } = decodeDerived(
    message('GBS1', { end: 'wrong', diagnostics: [] }).buffer as ArrayBuffer,
  );
  expect(derived.end).toBe('wrong');
  expect(draw).toBeNull();
});

it('reads a tree column by column', () => {
  const columns = new Uint32Array(13 * 2).map((_, i) => i);
  const floats = new Float32Array(15 * 2).map((_, i) => i / 2);
  const { tree, draw } = decodeTree(
    message(
      'GBT1',
      { count: 2, end: 'done', names: ['A'], files: ['a'] },
      join(bytes(columns), bytes(floats)),
    ).buffer as ArrayBuffer,
  );
  expect([...tree.shape]).toEqual([2, 3]);
  expect([...tree.flags]).toEqual([20, 21]);
  expect([...tree.before, ...tree.after]).toEqual([22, 23, 24, 25]);
  expect(tree.size[5]).toBe(14.5);
  expect(draw).toBeNull();
});

it('refuses what begins otherwise', () => {
  expect(() => decodeDerived(message('GBT1', {}).buffer as ArrayBuffer)).toThrow(/GBT1/);
});
