// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { Text } from '@codemirror/state';
import type { EditorView } from '@codemirror/view';
import { expect, it } from 'vitest';
import type { Message } from '../lib/protocol';
import { diagnostics, offers } from './extensions';

const RULES = 'Lot --> spilt(x) { ~1 : A. }';
const message: Message = {
  severity: 'error',
  code: 'unknown-operation',
  message: "'spilt' is not an operation",
  hint: "did you mean 'split'?",
  file: 'a.cga',
  line: 1,
  // The mark may be wider than what is to be replaced.
  column: 9,
  endColumn: 28,
  fix: { file: 'a.cga', line: 1, column: 9, endLine: 1, endColumn: 14, text: 'split' },
};

/** The text after the remedy of a mark was carried out on a text. */
function mended(before: string, after: string, m: Message = message): string {
  const doc = Text.of(before.split('\n'));
  const now = Text.of(after.split('\n'));
  const mark = diagnostics(doc, 'a.cga', [m])[0]!;
  let out = after;
  const view = {
    state: { doc: now },
    dispatch: ({ changes }: { changes: { from: number; to: number; insert: string } }) => {
      out = after.slice(0, changes.from) + changes.insert + after.slice(changes.to);
    },
  };
  const moved = after.indexOf('spilt');
  mark.actions?.[0]?.apply(view as unknown as EditorView, moved < 0 ? mark.from : moved, mark.to);
  return out;
}

it('replaces what the remedy is about and nothing else', () => {
  expect(mended(RULES, RULES)).toBe('Lot --> split(x) { ~1 : A. }');
});

it('follows the text while somebody writes, and leaves alone what is another by now', () => {
  expect(mended(RULES, `// new\n${RULES}`)).toBe('// new\nLot --> split(x) { ~1 : A. }');
  expect(mended(RULES, 'Lot --> slit(x) { ~1 : A. }')).toBe('Lot --> slit(x) { ~1 : A. }');
});

it('offers no remedy that is words only, or of another file', () => {
  const doc = Text.of([RULES]);
  const words: Message = { ...message };
  delete words.fix;
  expect(diagnostics(doc, 'a.cga', [words])[0]!.actions).toBeUndefined();
  const elsewhere = { ...message, fix: { ...message.fix!, file: 'b.cga' } };
  expect(diagnostics(doc, 'a.cga', [elsewhere])[0]!.actions).toBeUndefined();
  const gone = { ...message, fix: { ...message.fix!, line: 9, endLine: 9 } };
  expect(diagnostics(doc, 'a.cga', [gone])[0]!.actions).toBeUndefined();
});

it('offers what begins with what is written, as a whole or in its parts', () => {
  expect(offers('roofGable', 'roof')).toBe(true);
  expect(offers('roofGable', 'gab')).toBe(true);
  expect(offers('roofGable', 'rG')).toBe(true);
  expect(offers('geometry.area', 'area')).toBe(true);
  expect(offers('geometry.boundaryLength', 'Round')).toBe(false);
  expect(offers('extrude', 'trude')).toBe(false);
});
