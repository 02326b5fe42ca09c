// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the language server says while one writes: proposals, signatures, what a word means.

import {
  snippet,
  type Completion,
  type CompletionContext,
  type CompletionResult,
} from '@codemirror/autocomplete';
import { StateEffect, StateField, type Extension } from '@codemirror/state';
import {
  EditorView,
  hoverTooltip,
  keymap,
  showTooltip,
  ViewPlugin,
  type Tooltip,
  type ViewUpdate,
} from '@codemirror/view';
import type { Language } from '../language/language.svelte';
import { card } from '../language/markdown';
import {
  COLOR,
  FILE,
  offsetOf,
  positionOf,
  type CompletionItem,
  type Hover,
  type SignatureHelp,
} from '../language/protocol';

/** The text that an extension belongs to, and who knows of it. */
export interface Desk {
  language: Language;
  path: string;
  /** A picture of a file that rules may name; null for none. */
  preview: (asset: string) => Promise<HTMLElement | null>;
}

/** By kind of the protocol: the class of the offer. */
const TYPES: Record<number, string> = {
  2: 'function',
  3: 'method',
  5: 'property',
  6: 'variable',
  7: 'class',
  9: 'namespace',
  10: 'variable',
  14: 'keyword',
  16: 'constant',
  17: 'text',
  20: 'enum',
  21: 'constant',
  22: 'class',
};

/** "${1|a,b|}" to "${1:a}": places as the page's editor writes them. */
export function template(text: string): string {
  return text.replace(/\$\{(\d+)\|([^,|}]*)[^}]*\}/g, '${$1:$2}');
}

function swatch(color: string): HTMLElement {
  const out = document.createElement('span');
  out.className = 'preview-color';
  out.style.background = color;
  return out;
}

function completionOf(desk: Desk, item: CompletionItem): Completion {
  const { newText, range } = item.textEdit;
  const out: Completion = {
    label: item.label,
    type: TYPES[item.kind] ?? 'text',
    apply: (view, completion, from) => {
      const to = Math.max(offsetOf(view.state.doc, range.end), view.state.selection.main.head);
      if (item.insertTextFormat === 2)
        return snippet(template(newText))(view, completion, from, to);
      view.dispatch({
        changes: { from, to, insert: newText },
        selection: { anchor: from + newText.length },
        userEvent: 'input.complete',
      });
    },
  };
  if (item.detail) out.detail = item.detail;
  if (item.kind === FILE) out.info = () => desk.preview(item.label);
  else if (item.kind === COLOR) out.info = () => swatch(item.label);
  else if (item.documentation) out.info = item.documentation;
  return out;
}

export function completions(desk: Desk) {
  return async (context: CompletionContext): Promise<CompletionResult | null> => {
    const doc = context.state.doc;
    const before = context.matchBefore(/[@\w."#/-]+/);
    if (!before && !context.explicit) return null;
    const abort = new AbortController();
    context.addEventListener('abort', () => abort.abort());
    const position = positionOf(doc, context.pos);
    const answer = await desk.language.tell<{ items: CompletionItem[] }>(
      'textDocument/completion',
      desk.path,
      { position },
      abort.signal,
    );
    // The word itself is kept by going on: here Enter takes no offer.
    const items = (answer?.items ?? []).filter((i) => !i.preselect);
    const first = items[0];
    if (!first) return null;
    const from = offsetOf(doc, first.textEdit.range.start);
    const typed = doc.sliceString(from, context.pos);
    if (!typed && !context.explicit && before!.text !== '"' && !before!.text.endsWith('@'))
      return null;
    // What is written already needs no completion.
    if (items.every((i) => i.label === typed)) return null;
    items.sort((a, b) => (a.sortText < b.sortText ? -1 : 1));
    return { from, options: items.map((i) => completionOf(desk, i)), filter: false };
  };
}

export function explain(desk: Desk): Extension {
  return hoverTooltip(
    async (view, pos): Promise<Tooltip | null> => {
      const { doc } = view.state;
      const found = await desk.language.at<Hover>(
        'textDocument/hover',
        desk.path,
        positionOf(doc, pos),
      );
      if (!found) return null;
      return {
        pos: offsetOf(doc, found.range.start),
        end: offsetOf(doc, found.range.end),
        above: true,
        create: () => ({ dom: card(found.contents.value) }),
      };
    },
    { hoverTime: 350 },
  );
}

// --- How a call is written ---

const setHelp = StateEffect.define<{ at: number; help: SignatureHelp } | null>();

function signatureCard(help: SignatureHelp): HTMLElement {
  const out = document.createElement('div');
  out.className = 'hover-card signature';
  const chosen = help.signatures[help.activeSignature] ?? help.signatures[0]!;
  const code = document.createElement('code');
  const parameter = chosen.parameters[help.activeParameter];
  const open = chosen.label.indexOf('(');
  const at = parameter ? chosen.label.indexOf(parameter.label, Math.max(0, open)) : -1;
  if (parameter && at >= 0) {
    const mark = document.createElement('b');
    mark.textContent = parameter.label;
    code.append(chosen.label.slice(0, at), mark, chosen.label.slice(at + parameter.label.length));
  } else code.textContent = chosen.label;
  out.append(code);
  const said = parameter?.documentation ? parameter.documentation : chosen.documentation;
  if (said) {
    const p = document.createElement('p');
    p.className = 'param';
    p.textContent = said;
    out.append(p);
  }
  return out;
}

const signatures = StateField.define<Tooltip | null>({
  create: () => null,
  update(value, transaction) {
    for (const effect of transaction.effects) {
      if (!effect.is(setHelp)) continue;
      const told = effect.value;
      return told
        ? { pos: told.at, above: true, create: () => ({ dom: signatureCard(told.help) }) }
        : null;
    }
    return value && transaction.docChanged
      ? { ...value, pos: transaction.changes.mapPos(value.pos) }
      : value;
  },
  provide: (field) => showTooltip.from(field),
});

/** Shown from an opening bracket or a comma on, as long as the caret is in the call. */
export function signatureHelp(desk: Desk): Extension {
  const watcher = ViewPlugin.fromClass(
    class {
      private timer = 0;
      update(update: ViewUpdate): void {
        const shown = update.state.field(signatures) !== null;
        const typed = update.transactions.some((t) => t.isUserEvent('input'));
        let opens = false;
        if (typed)
          update.changes.iterChanges((_a, _b, _c, _d, text) => {
            opens ||= /[(,]/.test(text.toString());
          });
        if (opens || (shown && (update.docChanged || update.selectionSet))) this.soon(update.view);
      }
      destroy(): void {
        clearTimeout(this.timer);
      }
      private soon(view: EditorView): void {
        clearTimeout(this.timer);
        this.timer = window.setTimeout(() => void this.show(view), 60);
      }
      private async show(view: EditorView): Promise<void> {
        const { state } = view;
        const at = state.selection.main.head;
        const help = await desk.language.at<SignatureHelp>(
          'textDocument/signatureHelp',
          desk.path,
          positionOf(state.doc, at),
        );
        if (view.state.selection.main.head !== at) return;
        view.dispatch({ effects: setHelp.of(help?.signatures.length ? { at, help } : null) });
      }
    },
  );
  const close = keymap.of([
    {
      key: 'Escape',
      run: (view) => {
        if (!view.state.field(signatures)) return false;
        view.dispatch({ effects: setHelp.of(null) });
        return true;
      },
    },
  ]);
  const blur = EditorView.domEventHandlers({
    blur: (_event, view) => {
      if (view.state.field(signatures)) view.dispatch({ effects: setHelp.of(null) });
    },
  });
  return [signatures, watcher, close, blur];
}
