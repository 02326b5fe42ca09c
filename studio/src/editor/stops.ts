// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Stops of the derivation guide beside the text: a dot at each rule where playing stops.

import {
  RangeSet,
  RangeSetBuilder,
  StateEffect,
  StateField,
  type Extension,
} from '@codemirror/state';
import { gutter, GutterMarker } from '@codemirror/view';
import type { RuleInfo } from '../lib/protocol';

/** Lines with a stop. */
export const setStops = StateEffect.define<number[]>();

class Stop extends GutterMarker {
  override toDOM(): HTMLElement {
    const out = document.createElement('i');
    out.className = 'cm-stop';
    out.title = 'The guide stops at this rule  F9';
    return out;
  }
}
const STOP = new Stop();

const stops = StateField.define<RangeSet<GutterMarker>>({
  create: () => RangeSet.empty,
  update(value, transaction) {
    let out = value.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(setStops)) continue;
      const builder = new RangeSetBuilder<GutterMarker>();
      const { doc } = transaction.state;
      for (const line of [...effect.value].sort((a, b) => a - b)) {
        if (line < 1 || line > doc.lines) continue;
        const at = doc.line(line).from;
        builder.add(at, at, STOP);
      }
      out = builder.finish();
    }
    return out;
  },
});

/** Dots, and a place to click on for them; `toggle` gets the line. */
export function stopGutter(toggle: (line: number) => void): Extension {
  return [
    stops,
    gutter({
      class: 'cm-stop-gutter',
      markers: (view) => view.state.field(stops),
      domEventHandlers: {
        mousedown(view, block) {
          toggle(view.state.doc.lineAt(block.from).number);
          return true;
        },
      },
    }),
  ];
}

const inFile = (rule: RuleInfo, path: string) =>
  path === rule.file || path.endsWith(`/${rule.file}`);

/** The rule that a line of a file belongs to: the last one that begins there or above. */
export function ruleOfLine(
  rules: readonly RuleInfo[],
  path: string,
  line: number,
): RuleInfo | undefined {
  let out: RuleInfo | undefined;
  for (const rule of rules)
    if (inFile(rule, path) && rule.line <= line && rule.line >= (out?.line ?? 0)) out = rule;
  return out;
}

/** The lines of a file at which rules of some names begin. */
export function linesOf(
  rules: readonly RuleInfo[],
  path: string,
  names: ReadonlySet<string>,
): number[] {
  return rules.filter((r) => names.has(r.name) && inFile(r, path)).map((r) => r.line);
}
