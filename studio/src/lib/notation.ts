// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The forms that all notations share, line by line: comments, strings, numbers, signs. They are
// coloured at once; what the words mean the language server says.

import { HighlightStyle, StreamLanguage } from '@codemirror/language';
import { tags } from '@lezer/highlight';

export type Notation = 'CGA' | 'GBBG' | 'ProGen3d' | 'Park';

export function notationOf(path: string): Notation {
  if (path.endsWith('.gbbg')) return 'GBBG';
  if (path.endsWith('.grammar') || path.endsWith('.pg3d')) return 'ProGen3d';
  return path.endsWith('.park') ? 'Park' : 'CGA';
}

/** In a comment, or a string of CGA, over several lines. */
interface State {
  comment: boolean;
  string: boolean;
}

export function ruleLanguage(notation: Notation) {
  return StreamLanguage.define<State>({
    name: notation,
    startState: () => ({ comment: false, string: false }),
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
      if (state.string) {
        stream.match(/^(?:[^"\\]|\\.)*\\?/);
        state.string = !stream.match('"');
        return 'string';
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
      if (stream.match(/^"(?:[^"\\]|\\.)*"/)) return 'string';
      if (stream.match('"')) {
        stream.skipToEnd();
        state.string = notation === 'CGA';
        return 'string';
      }
      if (stream.match(/^\d+(?:\.\d+)?(?:[eE][+-]?\d+)?/)) return 'number';
      if (stream.match(/^[@A-Za-z_]\w*/)) return 'name';
      stream.next();
      return 'punctuation';
    },
  });
}

export const ruleColors = HighlightStyle.define([
  { tag: tags.number, color: 'var(--c-num)' },
  { tag: tags.string, color: 'var(--c-str)' },
  { tag: tags.comment, color: 'var(--c-com)', fontStyle: 'italic' },
  { tag: tags.punctuation, color: 'var(--c-pun)' },
]);
