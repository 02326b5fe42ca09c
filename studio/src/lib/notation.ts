// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Highlighting of the four notations, line by line. The names of operations and functions come from
// the engine's registry, those of rules and attributes from the text itself.

import { HighlightStyle, StreamLanguage, type StringStream } from '@codemirror/language';
import { tags } from '@lezer/highlight';

export type Notation = 'CGA' | 'GBBG' | 'ProGen3d' | 'Park';

export function notationOf(path: string): Notation {
  if (path.endsWith('.gbbg')) return 'GBBG';
  if (path.endsWith('.grammar') || path.endsWith('.pg3d')) return 'ProGen3d';
  return path.endsWith('.park') ? 'Park' : 'CGA';
}

export interface Names {
  operations: ReadonlySet<string>;
  attributes: ReadonlySet<string>;
}

interface State {
  comment: boolean;
  /** The last word was attr or const: a name is declared. */
  declares: boolean;
}

const KEYWORDS = new Set([
  'attr',
  'const',
  'case',
  'else',
  'import',
  'style',
  'version',
  'extends',
  'with',
  'import',
  'local',
  'inline',
  'recursive',
  'true',
  'false',
  'NIL',
  'repeat',
  'do',
  'if',
  'rule',
  'start',
]);

const ARROW = /-->|->/;

function word(stream: StringStream, state: State, names: Names, notation: Notation): string {
  const text = stream.current();
  const atStart =
    stream.start === stream.indentation() || /^\s*$/.test(stream.string.slice(0, stream.start));
  if (KEYWORDS.has(text)) {
    state.declares = text === 'attr' || text === 'const';
    return 'keyword';
  }
  if (state.declares) {
    state.declares = false;
    return 'attributeName';
  }
  const rest = stream.string.slice(stream.pos);
  if (atStart && ARROW.test(rest.replace(/^\s*(\([^)]*\))?\s*(\d+\s*)?/, '').slice(0, 3)))
    return 'typeName.definition';
  if (names.attributes.has(text)) return 'attributeName';
  if (names.operations.has(text) || names.operations.has(text.split('.')[0]!)) return 'operator';
  if (notation === 'ProGen3d' && /^[A-Z]$/.test(text)) return 'operator';
  return /^\s*=(?!=)/.test(rest) && atStart ? 'attributeName' : 'typeName';
}

export function ruleLanguage(notation: Notation, names: () => Names) {
  return StreamLanguage.define<State>({
    name: notation,
    startState: () => ({ comment: false, declares: false }),
    copyState: (s) => ({ ...s }),
    languageData: {
      commentTokens: { line: '//', block: { open: '/*', close: '*/' } },
      closeBrackets: { brackets: ['(', '[', '{', '"'] },
    },
    token(stream, state) {
      if (state.comment) {
        if (stream.skipTo('*/')) {
          stream.match('*/');
          state.comment = false;
        } else stream.skipToEnd();
        return 'comment';
      }
      if (stream.eatSpace()) return null;
      // All notations know both kinds of comments.
      if (stream.match('//') || stream.match('#')) {
        stream.skipToEnd();
        return 'comment';
      }
      if (stream.match('/*')) {
        state.comment = true;
        return 'comment';
      }
      if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return 'string';
      if (stream.match(/^@\w+/)) return 'annotation';
      if (stream.match(/^'?~?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?%?/)) return 'number';
      if (stream.match(/^[A-Za-z_][\w]*(?:\.[A-Za-z_]\w*)*/))
        return word(stream, state, names(), notation);
      if (stream.match(/^(-->|->|==|!=|<=|>=|&&|\|\|)/)) return 'punctuation';
      stream.next();
      return 'punctuation';
    },
  });
}

export const ruleColors = HighlightStyle.define([
  { tag: tags.keyword, color: 'var(--c-key)' },
  { tag: tags.definition(tags.typeName), color: 'var(--c-rule)', fontWeight: '600' },
  { tag: tags.typeName, color: 'var(--c-ref)' },
  { tag: tags.operator, color: 'var(--c-op)' },
  { tag: tags.attributeName, color: 'var(--c-attr)' },
  { tag: tags.number, color: 'var(--c-num)' },
  { tag: tags.string, color: 'var(--c-str)' },
  { tag: tags.comment, color: 'var(--c-com)', fontStyle: 'italic' },
  { tag: tags.annotation, color: 'var(--c-ann)' },
  { tag: tags.punctuation, color: 'var(--c-pun)' },
]);
