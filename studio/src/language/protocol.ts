// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the page takes of the language server protocol, and places in a text: the server counts
// lines and characters from 0, the page offsets.

import type { Text } from '@codemirror/state';

export interface Position {
  line: number;
  character: number;
}

export interface Range {
  start: Position;
  end: Position;
}

export interface Location {
  uri: string;
  range: Range;
}

export interface TextEdit {
  range: Range;
  newText: string;
}

/** Edits by address. */
export interface WorkspaceEdit {
  changes: Record<string, TextEdit[]>;
}

/** A mistake; severities are 1 error, 2 warning, 3 note. */
export interface Diagnostic {
  range: Range;
  severity: number;
  code: string;
  message: string;
}

export interface CompletionItem {
  label: string;
  kind: number;
  detail?: string;
  documentation?: string;
  sortText: string;
  preselect?: boolean;
  insertTextFormat: number;
  textEdit: TextEdit;
}

/** Kinds of completions that the page treats each in its own way. */
export const FILE = 17;
export const COLOR = 16;

export interface Signature {
  label: string;
  documentation: string;
  parameters: { label: string; documentation: string }[];
}

export interface SignatureHelp {
  signatures: Signature[];
  activeSignature: number;
  activeParameter: number;
}

export interface Hover {
  contents: { value: string };
  range: Range;
}

export interface CodeAction {
  title: string;
  isPreferred?: boolean;
  diagnostics: Diagnostic[];
  edit: WorkspaceEdit;
}

export interface ColorMark {
  range: Range;
  color: { red: number; green: number; blue: number; alpha: number };
}

export interface Fold {
  startLine: number;
  endLine: number;
}

export interface InlayHint {
  position: Position;
  label: string;
  /** 1: a value behind what is written; 2: the name of a parameter before it. */
  kind: number;
}

/** A place of the page's text; what is beyond its end is its end. */
export function offsetOf(doc: Text, at: Position): number {
  if (at.line >= doc.lines) return doc.length;
  const line = doc.line(at.line + 1);
  return Math.min(line.to, line.from + at.character);
}

export function positionOf(doc: Text, offset: number): Position {
  const line = doc.lineAt(Math.min(offset, doc.length));
  return { line: line.number - 1, character: offset - line.from };
}

/** The same of a plain text. */
export function positionIn(text: string, offset: number): Position {
  let line = 0;
  let from = 0;
  for (let i = text.indexOf('\n'); i >= 0 && i < offset; i = text.indexOf('\n', from)) {
    ++line;
    from = i + 1;
  }
  return { line, character: offset - from };
}

export function offsetIn(text: string, at: Position): number {
  let from = 0;
  for (let line = 0; line < at.line; ++line) {
    const end = text.indexOf('\n', from);
    if (end < 0) return text.length;
    from = end + 1;
  }
  const end = text.indexOf('\n', from);
  return Math.min(end < 0 ? text.length : end, from + at.character);
}

/** A text after edits that do not overlap. */
export function edited(text: string, edits: TextEdit[]): string {
  const placed = edits.map((e) => ({
    from: offsetIn(text, e.range.start),
    to: offsetIn(text, e.range.end),
    insert: e.newText,
  }));
  let out = text;
  for (const e of placed.sort((a, b) => b.from - a.from))
    out = out.slice(0, e.from) + e.insert + out.slice(e.to);
  return out;
}

/** The address of a file below a folder. */
export function uriOf(root: string, path: string): string {
  return `file://${`${root}/${path}`.split('/').map(encodeURIComponent).join('/')}`;
}

/** The path of an address below a folder; null for what is elsewhere. */
export function pathOf(root: string, uri: string): string | null {
  if (!uri.startsWith('file://')) return null;
  const path = decodeURIComponent(uri.slice('file://'.length));
  return path.startsWith(`${root}/`) ? path.slice(root.length + 1) : null;
}
