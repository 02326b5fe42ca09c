// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Completion, hover and marks of the editor.

import { snippetCompletion, type Completion, type CompletionContext, type CompletionResult } from '@codemirror/autocomplete';
import type { Diagnostic } from '@codemirror/lint';
import { RangeSetBuilder, StateEffect, StateField, type EditorState, type Text } from '@codemirror/state';
import { Decoration, EditorView, hoverTooltip, WidgetType, type DecorationSet, type Tooltip } from '@codemirror/view';
import type { AttributeInfo, Message, RuleInfo } from '../lib/protocol';
import { signatureText, type Entry } from '../lib/registry';

export interface Known {
  registry: Entry[];
  rules: RuleInfo[];
  attributes: AttributeInfo[];
}

const ICONS: Record<Entry['kind'], string> = { operation: 'function', function: 'method', attribute: 'property', selector: 'enum' };

function entryCompletion(entry: Entry): Completion {
  const base = { label: entry.name, type: ICONS[entry.kind], detail: entry.kind, info: entry.summary };
  const params = entry.signatures[0]?.params.filter((p) => p.default === undefined) ?? [];
  if (entry.bare || entry.signatures.length === 0) return base;
  const inside = params.map((p) => `\${${p.name}}`).join(', ');
  const block = entry.block.startsWith('{ size') || entry.block.startsWith('{ selector') ? ' { ${} : ${} }' : entry.block ? ' { ${} }' : '';
  return snippetCompletion(`${entry.name}(${inside})${block}`, base);
}

export function completions(known: () => Known) {
  return (context: CompletionContext): CompletionResult | null => {
    const word = context.matchBefore(/@?[A-Za-z_][\w.]*/);
    if (!word || (word.from === word.to && !context.explicit)) return null;
    const { registry, rules, attributes } = known();
    const options: Completion[] = [
      ...rules.map((r): Completion => ({ label: r.name, type: 'class', detail: 'rule', boost: 3 })),
      ...attributes.map((a): Completion => ({ label: a.name, type: 'variable', detail: a.type, boost: 2 })),
      ...registry.map(entryCompletion),
    ];
    return { from: word.from, options, validFor: /^@?[\w.]*$/ };
  };
}

function wordAt(state: EditorState, pos: number): { from: number; to: number; text: string } | null {
  const line = state.doc.lineAt(pos);
  for (const match of line.text.matchAll(/[A-Za-z_]\w*(?:\.\w+)*/g)) {
    const from = line.from + match.index;
    if (from <= pos && pos <= from + match[0].length) return { from, to: from + match[0].length, text: match[0] };
  }
  return null;
}

export function explain(known: () => Known) {
  return hoverTooltip((view, pos): Tooltip | null => {
    const word = wordAt(view.state, pos);
    const entry = word && known().registry.find((e) => e.name === word.text);
    if (!word || !entry) return null;
    return { pos: word.from, end: word.to, above: true, create: () => ({ dom: entryCard(entry) }) };
  }, { hoverTime: 350 });
}

function element(tag: string, className: string, text = ''): HTMLElement {
  const out = document.createElement(tag);
  out.className = className;
  out.textContent = text;
  return out;
}

function entryCard(entry: Entry): HTMLElement {
  const card = element('div', 'hover-card');
  const count = Math.max(1, Math.min(3, entry.signatures.length));
  for (let i = 0; i < count; ++i) card.append(element('code', '', signatureText(entry, i)));
  card.append(element('p', '', entry.summary));
  for (const p of entry.signatures[0]?.params ?? []) {
    const row = element('p', 'param');
    row.append(element('b', '', p.name), ` ${p.doc}`, p.default === undefined ? '' : ` Default: ${p.default}.`);
    card.append(row);
  }
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
      };
    })
    .sort((a, b) => a.from - b.from);
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

/** The last line of the rule that begins at a line: up to the next blank line or beginning at its left. */
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
  return word ? rules.find((r) => r.name === word.text || r.name.endsWith(`.${word.text}`)) : undefined;
}
