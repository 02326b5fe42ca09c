// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Marks of the editor: mistakes with their remedies, the lines of a selected shape, counts.

import { forEachDiagnostic, type Action, type Diagnostic } from '@codemirror/lint';
import {
  RangeSetBuilder,
  StateEffect,
  StateField,
  type EditorState,
  type Text,
} from '@codemirror/state';
import { Decoration, EditorView, WidgetType, type DecorationSet } from '@codemirror/view';
import type { Mistake } from '../language/language.svelte';
import { offsetOf, type CodeAction } from '../language/protocol';
import type { Diagnostic as EngineDiagnostic, RuleInfo } from '../lib/protocol';

function element(tag: string, className: string, text = ''): HTMLElement {
  const out = document.createElement(tag);
  out.className = className;
  out.textContent = text;
  return out;
}

function wordAt(
  state: EditorState,
  pos: number,
): { from: number; to: number; text: string } | null {
  const line = state.doc.lineAt(pos);
  for (const match of line.text.matchAll(/[A-Za-z_]\w*(?:\.\w+)*/g)) {
    const from = line.from + match.index;
    if (from <= pos && pos <= from + match[0].length)
      return { from, to: from + match[0].length, text: match[0] };
  }
  return null;
}

function offset(doc: Text, line: number, column: number): number {
  const at = doc.line(Math.min(Math.max(1, line), doc.lines));
  return Math.min(at.to, at.from + Math.max(0, column - 1));
}

const SEVERITIES = ['error', 'error', 'warning', 'info'] as const;

/**
 * The marks of a text: what the language server finds wrong, and what the derivation has to say
 * that is none of it.
 */
export function diagnostics(
  doc: Text,
  file: string,
  uri: string,
  mistakes: readonly Mistake[],
  told: readonly EngineDiagnostic[],
): Diagnostic[] {
  const found = mistakes.map((m): Diagnostic => {
    const from = offsetOf(doc, m.range.start);
    const actions = m.actions.flatMap((a) => actionOf(doc, uri, a, from) ?? []);
    return {
      from: Math.min(from, doc.length),
      to: Math.min(doc.length, Math.max(from + 1, offsetOf(doc, m.range.end))),
      severity: SEVERITIES[m.severity] ?? 'info',
      message: m.message,
      ...(actions.length ? { actions } : {}),
    };
  });
  const derived = told
    .filter((m) => m.line && m.shapePath && isFile(file, m.file))
    .map((m): Diagnostic => {
      const from = offset(doc, m.line!, m.column ?? 1);
      const to = offset(doc, m.endLine ?? m.line!, m.endColumn ?? (m.column ?? 1) + 1);
      return {
        from: Math.min(from, to),
        to: Math.min(doc.length, Math.max(from + 1, to)),
        severity: m.severity === 'note' ? 'info' : m.severity,
        message: m.hint ? `${m.message}. ${m.hint}` : m.message,
      };
    });
  return [...found, ...derived].sort((a, b) => a.from - b.from);
}

const isFile = (path: string, told: string | undefined) =>
  !!told && (told === path || path.endsWith(`/${told}`));

interface Edit {
  from: number;
  to: number;
  insert: string;
  /** What stands there; the edit is for that text alone. */
  was: string;
  /** From the beginning of its message. */
  ahead: number;
}

/** A remedy that is one edit of this text; others are carried out elsewhere. */
function actionOf(doc: Text, uri: string, action: CodeAction, marked: number): Action | null {
  const edits = Object.entries(action.edit.changes);
  const only = edits.length === 1 && edits[0]![0] === uri ? edits[0]![1] : [];
  const [edit] = only;
  if (!edit || only.length !== 1 || edit.range.end.line >= doc.lines) return null;
  const from = offsetOf(doc, edit.range.start);
  const to = offsetOf(doc, edit.range.end);
  const was = doc.sliceString(from, to);
  const found = { from, to, insert: edit.newText, was, ahead: from - marked };
  return fixAction(action.title + (action.isPreferred ? '  (Ctrl .)' : ''), found);
}

/**
 * Carries out the remedy of a message. It moves with the message while somebody writes, and does
 * nothing where the text is no longer the one that the message is about.
 */
function fixAction(name: string, edit: Edit): Action {
  return {
    name,
    apply(view, from) {
      const found = foundAgain(view.state.doc, edit, from);
      if (!found) return;
      const changes = { ...found, insert: edit.insert };
      view.dispatch({ changes, userEvent: 'input.fix' });
    },
  };
}

/** Where the text of an edit is now: where it was, else where its message has moved to. */
function foundAgain(doc: Text, edit: Edit, at: number): { from: number; to: number } | null {
  const size = edit.was.length;
  const moved = at + edit.ahead;
  // What only adds something goes with its message.
  for (const from of size ? [edit.from, moved] : [moved]) {
    if (from >= 0 && from + size <= doc.length && doc.sliceString(from, from + size) === edit.was)
      return { from, to: from + size };
  }
  return null;
}

/** Carries out the remedy on the caret's line that is nearest to the caret. */
export function fixAt(view: EditorView): boolean {
  const head = view.state.selection.main.head;
  const line = view.state.doc.lineAt(head);
  let best: { act: () => void; distance: number } | null = null;
  forEachDiagnostic(view.state, (d, from, to) => {
    const action = d.actions?.[0];
    if (!action || to < line.from || from > line.to) return;
    const distance = head < from ? from - head : head > to ? head - to : 0;
    if (!best || distance < best.distance)
      best = { act: () => action.apply(view, from, to), distance };
  });
  const before = view.state.doc;
  (best as { act: () => void } | null)?.act();
  return !view.state.doc.eq(before);
}

/** The lines of a selected shape: its rule, and the line that made it. */
export interface Marked {
  from: number;
  to: number;
  hit: number;
}

export const setMarked = StateEffect.define<Marked | null>();
export const setLenses = StateEffect.define<Map<number, string>>();

const ruleLine = Decoration.line({ class: 'cm-rule' });
const hitLine = Decoration.line({ class: 'cm-rule cm-hit' });

export const marked = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let out = value.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(setMarked)) continue;
      const builder = new RangeSetBuilder<Decoration>();
      const mark = effect.value;
      const doc = transaction.state.doc;
      if (mark) {
        for (let n = mark.from; n <= Math.min(mark.to, doc.lines); ++n) {
          const at = doc.line(n).from;
          builder.add(at, at, n === mark.hit ? hitLine : ruleLine);
        }
      }
      out = builder.finish();
    }
    return out;
  },
  provide: (field) => EditorView.decorations.from(field),
});

class Lens extends WidgetType {
  constructor(readonly text: string) {
    super();
  }
  override eq(other: Lens): boolean {
    return other.text === this.text;
  }
  toDOM(): HTMLElement {
    return element('span', 'lens', this.text);
  }
}

export const lenses = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let out = value.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(setLenses)) continue;
      const builder = new RangeSetBuilder<Decoration>();
      const doc = transaction.state.doc;
      for (const [line, text] of [...effect.value].sort((a, b) => a[0] - b[0])) {
        if (line < 1 || line > doc.lines) continue;
        const at = doc.line(line).to;
        builder.add(at, at, Decoration.widget({ widget: new Lens(text), side: 1 }));
      }
      out = builder.finish();
    }
    return out;
  },
  provide: (field) => EditorView.decorations.from(field),
});

/**
 * The last line of the rule that begins at a line: up to the next blank line or beginning at its
 * left.
 */
export function endOfRule(doc: Text, line: number): number {
  let end = line;
  for (let n = line + 1; n <= doc.lines; ++n) {
    const text = doc.line(n).text;
    if (text.trim() === '' || /^\S/.test(text)) break;
    end = n;
  }
  return end;
}

/** Where a rule of that name is written. */
export function ruleAt(state: EditorState, pos: number, rules: RuleInfo[]): RuleInfo | undefined {
  const word = wordAt(state, pos);
  return word
    ? rules.find((r) => r.name === word.text || r.name.endsWith(`.${word.text}`))
    : undefined;
}
