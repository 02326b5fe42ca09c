// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What tools/pack_examples.py packs: a line of JSON, then parts, of which each file has some.

interface Head {
  parts: number[];
  files: [string, ...number[]][];
}

function joined(parts: Uint8Array[]): Uint8Array {
  const out = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    out.set(part, at);
    at += part.length;
  }
  return out;
}

/** Paths and contents of the files. */
export function unpacked(bytes: Uint8Array): [string, Uint8Array][] {
  const end = bytes.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))) as Head;
  let at = end + 1;
  const parts = head.parts.map((size) => bytes.subarray(at, (at += size)));
  return head.files.map(([path, ...own]) => [path, joined(own.map((part) => parts[part]!))]);
}
