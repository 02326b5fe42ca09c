// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import { Buffer } from 'node:buffer';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import process from 'node:process';
import { afterAll, expect, it } from 'vitest';
import { unpackLzma } from './lzma';

const root = join(import.meta.dirname, '../..');
const folder = mkdtempSync(join(tmpdir(), 'gable-lzma-'));
afterAll(() => rmSync(folder, { recursive: true }));

function packed(content) {
  const [from, to] = ['plain', 'packed'].map((name) => join(folder, name));
  writeFileSync(from, content);
  execFileSync('python3', ['-B', join(root, 'tools/pack_bytes.py'), from, to]);
  return readFileSync(to);
}

/** Bytes that do not repeat, the same each time. */
function noise(count) {
  let seed = 1;
  return Buffer.from(
    Array.from({ length: count }, () => {
      seed = (Math.imul(seed, 1103515245) + 12345) >>> 0;
      return seed >>> 24;
    }),
  );
}

const far = noise(400_000);
for (const [what, content] of [
  ['nothing', Buffer.alloc(0)],
  ['one byte', Buffer.from('a')],
  ['one byte many times', Buffer.alloc(100_000, 7)],
  ['noise', noise(5000)],
  [
    'matches from far and near',
    Buffer.concat([far, far.subarray(3, 300_000), far.subarray(0, 50)]),
  ],
  ['a text', readFileSync(join(root, 'docs/guide/first-rules.md'))],
  ['a program', readFileSync(process.execPath).subarray(0, 3_000_000)],
]) {
  it(`unpacks ${what}`, () => {
    expect(Buffer.from(unpackLzma(packed(content))).equals(content)).toBe(true);
  });
}

it('unpacks a file with the settings of xz', () => {
  const script =
    'import lzma, sys; d = sys.stdin.buffer.read(); a = lzma.compress(d, format=lzma.FORMAT_ALONE);' +
    'sys.stdout.buffer.write(a[:5] + len(d).to_bytes(8, "little") + a[13:])';
  const content = readFileSync(join(root, 'docs/guide/studio.md'));
  const alone = execFileSync('python3', ['-c', script], { input: content });
  expect(Buffer.from(unpackLzma(alone)).equals(content)).toBe(true);
});

it('refuses a file that is cut off or damaged, and ends', () => {
  const whole = packed(readFileSync(join(root, 'docs/guide/studio.md')));
  for (const most of [0, 13, 17, 100, whole.length - 20]) {
    expect(() => unpackLzma(whole.subarray(0, most))).toThrow('cut off');
  }
  const settings = Buffer.from(whole);
  settings[0] = 255;
  expect(() => unpackLzma(settings)).toThrow('damaged');
  // What follows other bits is other matches, some of them from before the beginning.
  const bits = Buffer.from(whole);
  bits.fill(0xff, 20, 60);
  expect(() => unpackLzma(bits)).toThrow(/damaged|cut off/);
});
