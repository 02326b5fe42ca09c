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
import { forEachDiagnostic, type Diagnostic } from '@codemirror/lint';
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
import type { AttributeInfo, Message, RuleInfo } from '../lib/protocol';
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

/** What a message's hint says to write instead: "did you mean 'x'". */
export function proposal(m: Message): string | null {
  return /did you mean '([^']+)'/i.exec(`${m.message} ${m.hint ?? ''}`)?.[1] ?? null;
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
  const line = context.state.doc.lineAt(context.pos);
  const before = line.text.slice(0, context.pos - line.from);
  return (
    (before.match(/"/g)?.length ?? 0) % 2 === 1 ||
    /\/\/|(^|\s)#/.test(before.replace(/"[^"]*"/g, ''))
  );
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
    return {
      from: word ? word.from : context.pos,
      options: [...names.values()],
      validFor: /^@?[\w.]*$/,
    };
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

export function diagnostics(doc: Text, file: string, messages: Message[]): Diagnostic[] {
  return messages
    .filter((m) => m.line && (m.file === file || file.endsWith(`/${m.file}`)))
    .map((m) => {
      const from = offset(doc, m.line!, m.column ?? 1);
      const to = offset(doc, m.endLine ?? m.line!, m.endColumn ?? (m.column ?? 1) + 1);
      return {
        from: Math.min(from, to),
        to: Math.max(from + 1, to) > doc.length ? doc.length : Math.max(from + 1, to),
        severity: m.severity === 'note' ? ('info' as const) : m.severity,
        message: m.hint ? `${m.message}. ${m.hint}` : m.message,
        ...(proposal(m)
          ? {
              actions: [
                {
                  name: `Write ${proposal(m)}  (Ctrl .)`,
                  apply: (view: EditorView, a: number, b: number) =>
                    replace(view, a, b, proposal(m)!),
                },
              ],
            }
          : {}),
      };
    })
    .sort((a, b) => a.from - b.from);
}

function replace(view: EditorView, from: number, to: number, insert: string): void {
  view.dispatch({ changes: { from, to, insert }, userEvent: 'input.fix' });
}

/** Writes what the message at the caret proposes. */
export function fixAt(view: EditorView): boolean {
  const head = view.state.selection.main.head;
  const line = view.state.doc.lineAt(head);
  let done = false;
  forEachDiagnostic(view.state, (d, from, to) => {
    if (done || to < line.from || from > line.to || !d.actions?.length) return;
    done = true;
    d.actions[0]!.apply(view, from, to);
  });
  return done;
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
