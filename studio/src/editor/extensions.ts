// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Completion, hover and marks of the editor.

import {
  snippetCompletion,
  type Completion,
  type CompletionContext,
  type CompletionResult,
} from '@codemirror/autocomplete';
import { syntaxTree } from '@codemirror/language';
import { forEachDiagnostic, type Action, type Diagnostic } from '@codemirror/lint';
import {
  RangeSetBuilder,
  StateEffect,
  StateField,
  type EditorState,
  type Text,
} from '@codemirror/state';
import {
  Decoration,
  EditorView,
  hoverTooltip,
  WidgetType,
  type DecorationSet,
  type Tooltip,
} from '@codemirror/view';
import type { AttributeInfo, Fix, Message, RuleInfo } from '../lib/protocol';
import type { Notation } from '../lib/notation';
import type { Definition } from '../text/rules';
import { findWord, type Word } from '../text/words';

export interface Known {
  notation: Notation;
  words: Word[];
  /** What the text itself defines. */
  defined: Definition[];
  rules: RuleInfo[];
  attributes: AttributeInfo[];
}

const TYPES: Record<string, string> = {
  operation: 'function',
  function: 'method',
  attribute: 'property',
  selector: 'enum',
  annotation: 'keyword',
};

function wordCompletion(word: Word): Completion {
  const base = {
    label: word.name,
    type: TYPES[word.kind] ?? 'text',
    detail: word.kind,
    info: word.text,
  };
  return word.snippet ? snippetCompletion(word.snippet, base) : base;
}

/** Inside of a string or a comment nothing is completed. */
function inQuietText(context: CompletionContext): boolean {
  const node = syntaxTree(context.state).resolveInner(context.pos, -1);
  return /comment|string/i.test(node.name) && node.from < context.pos;
}

/**
 * Whether a word begins with what is written, or its parts begin with the parts of it: "rG" and
 * "gable" find "roofGable". Letters from anywhere would offer something for every new name.
 */
export function offers(label: string, written: string): boolean {
  const low = label.toLowerCase();
  const typed = written.toLowerCase();
  if (low.startsWith(typed)) return true;
  const starts = [...label.matchAll(/(?<=[a-z\d])[A-Z]|(?<=[._])\w/g)].map((m) => m.index);
  if (starts.some((at) => low.startsWith(typed, at))) return true;
  const humps = label[0]! + starts.map((at) => label[at]).join('');
  return written.length > 1 && humps.toLowerCase().startsWith(typed);
}

export function completions(known: () => Known) {
  return (context: CompletionContext): CompletionResult | null => {
    const word = context.matchBefore(/@?[A-Za-z_][\w.]*|@/);
    if ((!word || word.from === word.to) && !context.explicit) return null;
    if (inQuietText(context)) return null;
    const { words, defined, rules, attributes } = known();
    const names = new Map<string, Completion>();
    for (const w of words) names.set(w.name, wordCompletion(w));
    for (const a of attributes)
      names.set(a.name, { label: a.name, type: 'variable', detail: a.type, boost: 2 });
    for (const r of rules)
      names.set(r.name, { label: r.name, type: 'class', detail: 'rule', boost: 3 });
    for (const d of defined)
      names.set(d.name, {
        label: d.name,
        type: d.kind === 'rule' ? 'class' : 'variable',
        detail: d.kind,
        boost: 3,
      });
    const written = word?.text ?? '';
    const options = [...names.values()].filter((o) => offers(o.label, written));
    // What is written already needs no completion.
    if (!options.length || options.every((o) => o.label === written)) return null;
    const rank = (o: Completion) =>
      (o.label.startsWith(written) ? 0 : 2) - (o.boost ?? 0) / 10 + o.label.length / 1000;
    options.sort((a, b) => rank(a) - rank(b) || (a.label < b.label ? -1 : 1));
    return { from: word ? word.from : context.pos, options, filter: false };
  };
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

export function explain(known: () => Known) {
  return hoverTooltip(
    (view, pos): Tooltip | null => {
      const word = wordAt(view.state, pos);
      if (!word) return null;
      const { words, defined, notation } = known();
      const own = defined.find((d) => d.name === word.text);
      const found = own ? definitionCard(view.state, own) : undefined;
      const builtIn = found ? undefined : findWord(words, word.text, notation);
      if (!found && !builtIn) return null;
      return {
        pos: word.from,
        end: word.to,
        above: true,
        create: () => ({ dom: found ?? wordCard(builtIn!) }),
      };
    },
    { hoverTime: 350 },
  );
}

function element(tag: string, className: string, text = ''): HTMLElement {
  const out = document.createElement(tag);
  out.className = className;
  out.textContent = text;
  return out;
}

function wordCard(word: Word): HTMLElement {
  const card = element('div', 'hover-card');
  for (const signature of word.signatures.slice(0, 3)) card.append(element('code', '', signature));
  card.append(element('p', '', word.text));
  for (const p of word.params) {
    const row = element('p', 'param');
    row.append(element('b', '', p.name), ` ${p.text}`);
    card.append(row);
  }
  return card;
}

/** What a name of the file stands for: its first lines. */
function definitionCard(state: EditorState, definition: Definition): HTMLElement {
  const card = element('div', 'hover-card');
  const lines = state.sliceDoc(definition.from, definition.to).split('\n');
  card.append(
    element('code', 'lines', lines.slice(0, 6).join('\n') + (lines.length > 6 ? '\n…' : '')),
  );
  card.append(
    element(
      'p',
      'param',
      `${definition.kind}, line ${state.doc.lineAt(Math.min(definition.from, state.doc.length)).number}`,
    ),
  );
  return card;
}

function offset(doc: Text, line: number, column: number): number {
  const at = doc.line(Math.min(Math.max(1, line), doc.lines));
  return Math.min(at.to, at.from + Math.max(0, column - 1));
}

/** The messages of a file as marks of its text. */
export function diagnostics(doc: Text, file: string, messages: Message[]): Diagnostic[] {
  return messages
    .filter((m) => m.line && isFile(file, m.file))
    .map((m): Diagnostic => {
      const from = offset(doc, m.line!, m.column ?? 1);
      const to = offset(doc, m.endLine ?? m.line!, m.endColumn ?? (m.column ?? 1) + 1);
      const edit = m.fix && isFile(file, m.fix.file) ? editOf(doc, m.fix) : null;
      return {
        from: Math.min(from, to),
        to: Math.min(doc.length, Math.max(from + 1, to)),
        severity: m.severity === 'note' ? ('info' as const) : m.severity,
        message: m.hint ? `${m.message}. ${m.hint}` : m.message,
        ...(edit ? { actions: [fixAction(edit)] } : {}),
      };
    })
    .sort((a, b) => a.from - b.from);
}

const isFile = (path: string, told: string | undefined) =>
  !!told && (told === path || path.endsWith(`/${told}`));

interface Edit {
  from: number;
  to: number;
  insert: string;
  /** What stands there; the edit is for that text alone. */
  was: string;
}

function editOf(doc: Text, fix: Fix): Edit | null {
  if (fix.line > doc.lines || fix.endLine > doc.lines) return null;
  const from = offset(doc, fix.line, fix.column);
  const to = offset(doc, fix.endLine, fix.endColumn);
  return from <= to ? { from, to, insert: fix.text, was: doc.sliceString(from, to) } : null;
}

/**
 * Carries out the remedy of a message. It moves with the message while somebody writes, and does
 * nothing where the text is no longer the one that the message is about.
 */
function fixAction(edit: Edit): Action {
  return {
    name: `${edit.insert ? `Write ${edit.insert}` : 'Remove it'}  (Ctrl .)`,
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
  for (const from of [edit.from, at]) {
    if (from + size <= doc.length && doc.sliceString(from, from + size) === edit.was)
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
