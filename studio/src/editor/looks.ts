// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the language server says of the text that is in sight: what each word is, as its colour; the
// names of arguments; colours as swatches; what can be folded. It is asked when the text has
// rested, or another part of it is in sight.

import { codeFolding, foldGutter, foldKeymap, foldService } from '@codemirror/language';
import {
  RangeSetBuilder,
  StateEffect,
  StateField,
  type EditorState,
  type Extension,
  type Text,
} from '@codemirror/state';
import {
  Decoration,
  EditorView,
  keymap,
  ViewPlugin,
  WidgetType,
  type DecorationSet,
  type ViewUpdate,
} from '@codemirror/view';
import type { Desk } from './assist';
import {
  offsetOf,
  type ColorMark,
  type Fold,
  type InlayHint,
  type Position,
  type Range,
} from '../language/protocol';

/** In the order of the server's legend. */
const KINDS = [
  'comment',
  'keyword',
  'string',
  'number',
  'operator',
  'rule',
  'leaf',
  'operation',
  'function',
  'attribute',
  'parameter',
  'selector',
  'annotation',
  'namespace',
] as const;
const DECLARATION = 1;

interface Word {
  from: number;
  to: number;
  className: string;
}

/** The five numbers of each token to places of a text. */
export function wordsOf(doc: Text, data: number[]): Word[] {
  const out: Word[] = [];
  let line = 0;
  let character = 0;
  for (let i = 0; i + 4 < data.length; i += 5) {
    const [down, right, length, kind, bits] = data.slice(i, i + 5) as [
      number,
      number,
      number,
      number,
      number,
    ];
    character = down ? right : character + right;
    line += down;
    if (line >= doc.lines) break;
    const from = offsetOf(doc, { line, character });
    const to = offsetOf(doc, { line, character: character + length });
    if (from >= to) continue;
    const name = KINDS[kind] ?? 'leaf';
    const declared = bits & DECLARATION && name === 'rule' ? ' t-declared' : '';
    out.push({ from, to, className: `t-${name}${declared}` });
  }
  return out;
}

class Hint extends WidgetType {
  constructor(
    readonly label: string,
    readonly value: boolean,
  ) {
    super();
  }
  override eq(other: Hint): boolean {
    return other.label === this.label && other.value === this.value;
  }
  // The words are no text of the document: they are drawn by the style, so that they are neither
  // copied nor read as if somebody had written them.
  toDOM(): HTMLElement {
    const out = document.createElement('span');
    out.className = this.value ? 'inlay value' : 'inlay';
    out.dataset.hint = this.label;
    out.setAttribute('aria-hidden', 'true');
    return out;
  }
}

const hexOf = ({ color }: ColorMark) =>
  `#${[color.red, color.green, color.blue]
    .map((v) =>
      Math.round(v * 255)
        .toString(16)
        .padStart(2, '0'),
    )
    .join('')}`;

class Swatch extends WidgetType {
  constructor(
    readonly mark: ColorMark,
    readonly desk: Desk,
  ) {
    super();
  }
  override eq(other: Swatch): boolean {
    return JSON.stringify(other.mark) === JSON.stringify(this.mark);
  }
  toDOM(view: EditorView): HTMLElement {
    const out = document.createElement('input');
    out.type = 'color';
    out.className = 'swatch';
    out.tabIndex = -1;
    out.setAttribute('aria-label', `Colour ${hexOf(this.mark)}`);
    out.value = hexOf(this.mark);
    out.addEventListener('change', () => void this.choose(view, out.value));
    return out;
  }
  override ignoreEvent(): boolean {
    return true;
  }
  private async choose(view: EditorView, hex: string): Promise<void> {
    const part = (at: number) => parseInt(hex.slice(at, at + 2), 16) / 255;
    const color = { red: part(1), green: part(3), blue: part(5), alpha: this.mark.color.alpha };
    const { range } = this.mark;
    const { doc } = view.state;
    const texts = await this.desk.language.tell<{ label: string }[]>(
      'textDocument/colorPresentation',
      this.desk.path,
      { range, color },
    );
    const insert = texts?.[0]?.label;
    if (!insert || !view.state.doc.eq(doc)) return;
    const changes = { from: offsetOf(doc, range.start), to: offsetOf(doc, range.end), insert };
    view.dispatch({ changes, userEvent: 'input.color' });
  }
}

interface Looks {
  words: DecorationSet;
  beside: DecorationSet;
  folds: ReadonlyMap<number, number>;
}

const setLooks = StateEffect.define<Partial<Looks>>();

const looks = StateField.define<Looks>({
  create: () => ({ words: Decoration.none, beside: Decoration.none, folds: new Map() }),
  update(value, transaction) {
    let out = value;
    if (transaction.docChanged) {
      const { changes } = transaction;
      out = { ...value, words: value.words.map(changes), beside: value.beside.map(changes) };
    }
    for (const effect of transaction.effects)
      if (effect.is(setLooks)) out = { ...out, ...effect.value };
    return out;
  },
  provide: (field) => [
    EditorView.decorations.from(field, (l) => l.words),
    EditorView.decorations.from(field, (l) => l.beside),
  ],
});

function marksOf(doc: Text, data: number[]): DecorationSet {
  const builder = new RangeSetBuilder<Decoration>();
  for (const w of wordsOf(doc, data)) builder.add(w.from, w.to, mark(w.className));
  return builder.finish();
}

const known = new Map<string, Decoration>();
function mark(className: string): Decoration {
  const found = known.get(className) ?? Decoration.mark({ class: className });
  known.set(className, found);
  return found;
}

function besideOf(desk: Desk, doc: Text, hints: InlayHint[], colors: ColorMark[]): DecorationSet {
  const placed = [
    ...hints.map((h) => ({
      at: offsetOf(doc, h.position),
      side: h.kind === 1 ? 1 : -1,
      widget: new Hint(h.label, h.kind === 1) as WidgetType,
    })),
    ...colors.map((c) => ({
      at: offsetOf(doc, c.range.start),
      side: -2,
      widget: new Swatch(c, desk) as WidgetType,
    })),
  ];
  return Decoration.set(
    placed.map((p) => Decoration.widget({ widget: p.widget, side: p.side }).range(p.at)),
    true,
  );
}

const foldedLines = foldService.of((state: EditorState, lineStart: number) => {
  const line = state.doc.lineAt(lineStart);
  const end = state.field(looks).folds.get(line.number - 1);
  if (end === undefined || end >= state.doc.lines || end < line.number) return null;
  return { from: line.to, to: state.doc.line(end + 1).to };
});

const REST_MS = 90;
const AROUND = 120;

/** Asks for what is in sight, and for what is around it. */
class Asker {
  private timer = 0;
  private abort = new AbortController();
  /** Lines that were asked for. */
  private from = 0;
  private to = -1;

  constructor(
    private readonly view: EditorView,
    private readonly desk: Desk,
  ) {
    this.soon(0);
  }

  update(update: ViewUpdate): void {
    if (update.docChanged) return this.soon(REST_MS);
    if (update.transactions.some((t) => t.effects.some((e) => e.is(askAgain)))) this.soon(0);
    else if (update.viewportChanged && !this.covers()) this.soon(REST_MS);
  }

  destroy(): void {
    clearTimeout(this.timer);
    this.abort.abort();
  }

  private lines(): [number, number] {
    const { doc } = this.view.state;
    const { from, to } = this.view.viewport;
    return [doc.lineAt(from).number - 1, doc.lineAt(to).number - 1];
  }

  private covers(): boolean {
    const [from, to] = this.lines();
    return this.from <= from && to <= this.to;
  }

  private soon(wait: number): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.ask(), wait);
  }

  private async ask(): Promise<void> {
    this.abort.abort();
    const abort = (this.abort = new AbortController());
    const { doc } = this.view.state;
    const [first, last] = this.lines();
    this.from = Math.max(0, first - AROUND);
    this.to = Math.min(doc.lines - 1, last + AROUND);
    const start: Position = { line: this.from, character: 0 };
    const end: Position = { line: this.to, character: doc.line(this.to + 1).length };
    const range: Range = { start, end };
    const { language, path } = this.desk;
    const get = <T>(method: string, params: object = {}) =>
      language.tell<T>(`textDocument/${method}`, path, params, abort.signal);
    const [tokens, hints, colors, folds] = await Promise.all([
      get<{ data: number[] }>('semanticTokens/range', { range }),
      get<InlayHint[]>('inlayHint', { range }),
      get<ColorMark[]>('documentColor'),
      get<Fold[]>('foldingRange'),
    ]);
    if (abort.signal.aborted || !this.view.state.doc.eq(doc)) return;
    const shown = (colors ?? []).filter((c) => {
      const { line } = c.range.start;
      return line >= this.from && line <= this.to;
    });
    const next: Partial<Looks> = {};
    if (tokens) next.words = marksOf(doc, tokens.data);
    if (hints) next.beside = besideOf(this.desk, doc, hints, shown);
    if (folds) next.folds = new Map(folds.map((f) => [f.startLine, f.endLine]));
    this.view.dispatch({ effects: setLooks.of(next) });
  }
}

/** Something that the answers depend on is another by now. */
export const askAgain = StateEffect.define<null>();

export function languageLooks(desk: Desk): Extension {
  return [
    looks,
    codeFolding(),
    foldGutter({
      openText: '⌄',
      closedText: '›',
      foldingChanged: ({ startState, state }) =>
        startState.field(looks).folds !== state.field(looks).folds,
    }),
    foldedLines,
    keymap.of(foldKeymap),
    ViewPlugin.define((view) => new Asker(view, desk)),
  ];
}
