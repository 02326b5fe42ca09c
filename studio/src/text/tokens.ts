// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rule text as words, marks, strings and comments, the same for all notations. Nothing is refused:
// the editor works on text that is being written.

export type TokenKind = 'name' | 'number' | 'string' | 'comment' | 'mark' | 'annotation';

export interface Token {
  kind: TokenKind;
  from: number;
  to: number;
  text: string;
}

const PATTERN = new RegExp(
  [
    /(\/\/[^\n]*|#[^\n]*|\/\*[\s\S]*?(?:\*\/|$))/,
    /("(?:[^"\\\n]|\\.)*"?)/,
    /(@[A-Za-z_]\w*)/,
    /([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*)/,
    /(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?|\.\d+)/,
    /(-->|->|==|!=|<=|>=|&&|\|\||[^\s])/,
  ]
    .map((part) => part.source)
    .join('|'),
  'g',
);

const KINDS: TokenKind[] = ['comment', 'string', 'annotation', 'name', 'number', 'mark'];

/** All tokens, comments too. A dotted name is one token. */
export function tokenize(text: string): Token[] {
  const out: Token[] = [];
  for (const match of text.matchAll(PATTERN)) {
    const group = match.slice(1).findIndex((g) => g !== undefined);
    out.push({
      kind: KINDS[group]!,
      from: match.index,
      to: match.index + match[0].length,
      text: match[0],
    });
  }
  return out;
}

/** Where a bracket ends that begins at a token; the last token when it does not. */
export function closing(tokens: Token[], open: number): number {
  let depth = 0;
  for (let i = open; i < tokens.length; ++i) {
    const text = tokens[i]!.kind === 'mark' ? tokens[i]!.text : '';
    if (text === '(' || text === '{' || text === '[') ++depth;
    if (text === ')' || text === '}' || text === ']') --depth;
    if (depth === 0) return i;
  }
  return tokens.length - 1;
}

/** Whether a token is the first of its line. */
export function startsLine(text: string, token: Token): boolean {
  const line = text.lastIndexOf('\n', token.from - 1) + 1;
  return text.slice(line, token.from).trim() === '';
}

export function lineOf(text: string, offset: number): number {
  let line = 1;
  for (let i = text.indexOf('\n'); i >= 0 && i < offset; i = text.indexOf('\n', i + 1)) ++line;
  return line;
}
