// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { Text } from '@codemirror/state';
import type { EditorView } from '@codemirror/view';
import { expect, it } from 'vitest';
import type { Mistake } from '../language/language.svelte';
import type { Diagnostic } from '../lib/protocol';
import { diagnostics } from './extensions';

const RULES = 'Lot --> spilt(x) { ~1 : A. }';
const URI = 'file:///p/a.cga';
const at = (start: number, end: number, line = 0) => ({
  start: { line, character: start },
  end: { line, character: end },
});
const action = {
  title: "Write 'split'",
  isPreferred: true,
  diagnostics: [],
  edit: { changes: { [URI]: [{ range: at(8, 13), newText: 'split' }] } },
};
const mistake: Mistake = {
  severity: 1,
  code: 'unknown-operation',
  message: "'spilt' is not an operation",
  // The mark may be wider than what is to be replaced.
  range: at(8, 27),
  actions: [action],
};

const marks = (doc: Text, mistakes: Mistake[], told: Diagnostic[] = []) =>
  diagnostics(doc, 'a.cga', URI, mistakes, told);

/** The text after the remedy of a mark was carried out on a text. */
function mended(before: string, after: string, word: string, m: Mistake = mistake): string {
  const doc = Text.of(before.split('\n'));
  const now = Text.of(after.split('\n'));
  const mark = marks(doc, [m])[0]!;
  let out = after;
  const view = {
    state: { doc: now },
    dispatch: ({ changes }: { changes: { from: number; to: number; insert: string } }) => {
      out = after.slice(0, changes.from) + changes.insert + after.slice(changes.to);
    },
  };
  const moved = after.indexOf(word);
  mark.actions?.[0]?.apply(view as unknown as EditorView, moved < 0 ? mark.from : moved, mark.to);
  return out;
}

it('replaces what the remedy is about and nothing else', () => {
  expect(mended(RULES, RULES, 'spilt')).toBe('Lot --> split(x) { ~1 : A. }');
});

it('follows the text while somebody writes, and leaves alone what is another by now', () => {
  expect(mended(RULES, `// new\n${RULES}`, 'spilt')).toBe('// new\nLot --> split(x) { ~1 : A. }');
  const other = 'Lot --> slit(x) { ~1 : A. }';
  expect(mended(RULES, other, 'spilt')).toBe(other);
});

it('adds where its message has gone', () => {
  const open = 'Lot --> extrude(3';
  const edit = { changes: { [URI]: [{ range: at(17, 17), newText: ')' }] } };
  const adds = { ...mistake, range: at(8, 17), actions: [{ ...action, edit }] };
  expect(mended(open, `// new\n${open}`, 'extrude', adds)).toBe('// new\nLot --> extrude(3)');
});

it('offers no remedy of another file, or where the text has ended', () => {
  const doc = Text.of([RULES]);
  const elsewhere = { changes: { 'file:///p/b.cga': [{ range: at(8, 13), newText: 'split' }] } };
  const gone = { changes: { [URI]: [{ range: at(8, 13, 9), newText: 'split' }] } };
  for (const edit of [elsewhere, gone]) {
    const actions = [{ ...action, edit }];
    expect(marks(doc, [{ ...mistake, actions }])[0]!.actions).toBeUndefined();
  }
});

it('marks what a shape has met as well, and what rules have wrong once', () => {
  const doc = Text.of([RULES]);
  const told: Diagnostic = {
    severity: 'warning',
    code: 'size-zero',
    message: 'there is no room',
    file: 'a.cga',
    line: 1,
    column: 1,
    shapePath: '0.1',
  };
  const analysed: Diagnostic = {
    severity: 'error',
    code: 'x',
    message: 'x',
    file: 'a.cga',
    line: 1,
  };
  expect(marks(doc, [mistake], [told, analysed]).map((d) => d.message)).toEqual([
    'there is no room',
    "'spilt' is not an operation",
  ]);
});
