// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import { Buffer } from 'node:buffer';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, it } from 'vitest';
import { unpacked } from './examples';
import { unpackLzma } from './lzma';

const root = join(import.meta.dirname, '../..');

it('unpacks every file as it is, with pictures that models share stored once', () => {
  const folder = mkdtempSync(join(tmpdir(), 'gable-pack-'));
  const pack = join(folder, 'examples.pack');
  execFileSync('python3', ['-B', join(root, 'tools/pack_examples.py'), pack]);
  const plain = unpackLzma(readFileSync(pack));
  rmSync(folder, { recursive: true });
  const files = unpacked(plain);
  expect(files.length).toBeGreaterThan(100);
  let bytes = 0;
  for (const [path, content] of files) {
    bytes += content.length;
    expect(Buffer.from(content).equals(readFileSync(join(root, 'examples', path))), path).toBe(
      true,
    );
  }
  expect(plain.length).toBeLessThan(bytes);
});
