// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where rules, attributes and functions are written, and where they are used. It works on the text
// alone, in each notation, so that it also holds for text that the engine does not take yet.

import { notationOf, type Notation } from '../lib/notation';
import { closing, startsLine, tokenize, type Token } from './tokens';

export interface Span {
  from: number;
  to: number;
}

export type DefinitionKind = 'rule' | 'attribute' | 'constant' | 'function';

export interface Definition extends Span {
  kind: DefinitionKind;
  name: string;
  nameSpan: Span;
  /** Names of its parameters; they hold within it alone. */
  parameters: string[];
  /** Behind the arrow or the equals sign, up to the end of the definition. */
  body: Span;
  /** Where its annotations and the comments above it begin; `from` without any. */
  lead: number;
}

export interface RuleFile {
  path: string;
  text: string;
}

export interface Use extends Span {
  path: string;
  definition: boolean;
}

const DECLARES = new Set([
  'attr',
  'const',
  'style',
  'import',
  'version',
  'axiom',
  'shape',
  'terminal',
  'select',
  'use',
  'postprocess',
  'fun',
]);

interface Header {
  /** Tokens: first of the definition, its name, first of the body. */
  first: number;
  name: number;
  body: number;
  kind: DefinitionKind;
}

/** The name in front of an arrow, over a list of parameters; -1 for none. */
function nameBefore(tokens: Token[], arrow: number): number {
  let at = arrow - 1;
  if (tokens[at]?.text === ')') {
    let depth = 0;
    for (; at >= 0; --at) {
      if (tokens[at]!.text === ')') ++depth;
      if (tokens[at]!.text === '(' && --depth === 0) break;
    }
    --at;
  }
  const kind = tokens[at]?.kind;
  return kind === 'name' || kind === 'string' ? at : -1;
}

/** ProGen3d's rules begin with a name in the first column: counts and variables follow it. */
function progenHeaders(text: string, tokens: Token[]): Header[] {
  const out: Header[] = [];
  tokens.forEach((token, i) => {
    if (token.text !== '->') return;
    let first = i;
    while (
      first > 0 &&
      !(
        startsLine(text, tokens[first]!) &&
        text.lastIndexOf('\n', tokens[first]!.from) === tokens[first]!.from - 1
      )
    )
      --first;
    const from = tokens[first]!;
    if (from.kind === 'name' && !out.some((h) => h.first === first))
      out.push({ first, name: first, body: i + 1, kind: 'rule' });
  });
  return out;
}

function headers(text: string, tokens: Token[], notation: Notation): Header[] {
  if (notation === 'ProGen3d') return progenHeaders(text, tokens);
  const out: Header[] = [];
  let depth = 0;
  tokens.forEach((token, i) => {
    if (token.kind === 'mark' && '([{'.includes(token.text)) ++depth;
    if (token.kind === 'mark' && ')]}'.includes(token.text)) --depth;
    if (token.text === '-->' || token.text === '->') {
      const name = nameBefore(tokens, i);
      if (name < 0) return;
      let first = name;
      while (first > 0 && ['inline', 'recursive'].includes(tokens[first - 1]!.text)) --first;
      // A title in front of a GBBG rule's symbol.
      if (
        tokens[first - 1]?.kind === 'string' &&
        notation === 'GBBG' &&
        startsLine(text, tokens[first - 1]!)
      )
        --first;
      out.push({ first, name, body: i + 1, kind: 'rule' });
    } else if (
      (token.text === 'attr' || token.text === 'const') &&
      tokens[i + 1]?.kind === 'name'
    ) {
      const isConst = token.text === 'const';
      const call = tokens[i + 2]?.text === '(' ? closing(tokens, i + 2) + 1 : i + 2;
      const kind = !isConst ? 'attribute' : call > i + 2 ? 'function' : 'constant';
      if (tokens[call]?.text === '=') out.push({ first: i, name: i + 1, body: call + 1, kind });
    } else if (
      token.kind === 'name' &&
      depth === 0 &&
      startsLine(text, token) &&
      !DECLARES.has(token.text)
    ) {
      const before = tokens[i - 1]?.text;
      if (before === 'attr' || before === 'const') return;
      const call = tokens[i + 1]?.text === '(' ? closing(tokens, i + 1) + 1 : i + 1;
      if (tokens[call]?.text === '=')
        out.push({
          first: i,
          name: i,
          body: call + 1,
          kind: call > i + 1 ? 'function' : 'constant',
        });
    }
  });
  return out.sort((a, b) => a.first - b.first);
}

function parametersOf(tokens: Token[], header: Header, notation: Notation): string[] {
  const names: string[] = [];
  if (notation === 'ProGen3d') {
    for (let i = header.name + 1; i < header.body; ++i)
      if (tokens[i]!.kind === 'name' && !/^[A-Z]$/.test(tokens[i]!.text))
        names.push(tokens[i]!.text);
    return names;
  }
  if (tokens[header.name + 1]?.text !== '(') return names;
  const end = closing(tokens, header.name + 1);
  let expects = true;
  for (let i = header.name + 2; i < end; ++i) {
    if (tokens[i]!.text === ',') expects = true;
    else if (expects && tokens[i]!.kind === 'name') {
      names.push(tokens[i]!.text);
      expects = false;
    }
  }
  return names;
}

/** First tokens of statements that are no definitions: import, style, axiom, annotations. */
function otherStarts(text: string, tokens: Token[]): Set<number> {
  const out = new Set<number>();
  let depth = 0;
  tokens.forEach((t, i) => {
    if (t.kind === 'mark' && '([{'.includes(t.text)) ++depth;
    if (t.kind === 'mark' && ')]}'.includes(t.text)) --depth;
    if (
      depth === 0 &&
      (t.kind === 'annotation' || (t.kind === 'name' && DECLARES.has(t.text))) &&
      startsLine(text, t)
    )
      out.add(i);
  });
  return out;
}

/** The annotations and comments right above a definition. */
function leadOf(text: string, all: Token[], from: number): number {
  let lead = from;
  let at = all.findIndex((t) => t.from >= from) - 1;
  if (at < -1) at = all.length - 1;
  while (at >= 0) {
    const gap = text.slice(all[at]!.to, lead);
    if (/\n\s*\n/.test(gap)) break;
    if (all[at]!.kind === 'comment' && startsLine(text, all[at]!)) {
      lead = all[at]!.from;
      --at;
      continue;
    }
    // "@Range(min=1, max=2)": back over the brackets to the annotation.
    let first = at;
    if (all[at]!.text === ')') {
      let depth = 0;
      for (; first >= 0; --first) {
        if (all[first]!.text === ')') ++depth;
        if (all[first]!.text === '(' && --depth === 0) break;
      }
      --first;
    }
    if (all[first]?.kind !== 'annotation') break;
    lead = all[first]!.from;
    at = first - 1;
  }
  return lead;
}

/** All definitions of a text, in its order. */
export function definitions(text: string, notation: Notation): Definition[] {
  const all = tokenize(text);
  const tokens = all.filter((t) => t.kind !== 'comment');
  const heads = headers(text, tokens, notation);
  const starts = new Set([...heads.map((h) => h.first), ...otherStarts(text, tokens)]);
  return heads.map((head) => {
    let end = head.body;
    while (end < tokens.length && !starts.has(end)) ++end;
    const from = tokens[head.first]!.from;
    const to = Math.max(tokens[end - 1]?.to ?? from, tokens[head.body - 1]!.to);
    const name = tokens[head.name]!;
    return {
      kind: head.kind,
      name: name.kind === 'string' ? name.text.slice(1, -1) : name.text,
      nameSpan: { from: name.from, to: name.to },
      parameters: parametersOf(tokens, head, notation),
      from,
      to,
      body: { from: Math.min(tokens[head.body]?.from ?? to, to), to },
      lead: leadOf(text, all, from),
    };
  });
}

/** "id" of `import id : "file"` with the path that it leads to, beside the importing file. */
export function imports(file: RuleFile): { id: string; path: string }[] {
  const tokens = tokenize(file.text).filter((t) => t.kind !== 'comment');
  const out: { id: string; path: string }[] = [];
  tokens.forEach((t, i) => {
    if (
      t.text !== 'import' ||
      tokens[i + 1]?.kind !== 'name' ||
      tokens[i + 2]?.text !== ':' ||
      tokens[i + 3]?.kind !== 'string'
    )
      return;
    out.push({ id: tokens[i + 1]!.text, path: tokens[i + 3]!.text.slice(1, -1) });
  });
  return out;
}

function sameFile(importing: string, written: string, path: string): boolean {
  const folder = importing.includes('/') ? importing.slice(0, importing.lastIndexOf('/') + 1) : '';
  const plain = written.replace(/^\.?\//, '');
  return path === folder + plain || path === plain || path.endsWith(`/${plain}`);
}

/** What stands in front of the names of `path` in each file: '' in itself, 'id.' where imported. */
function prefixes(files: RuleFile[], path: string): Map<string, string[]> {
  const out = new Map<string, string[]>([[path, ['']]]);
  for (let round = 0; round < 4; ++round) {
    for (const file of files) {
      for (const each of imports(file)) {
        for (const [known, list] of [...out]) {
          if (!sameFile(file.path, each.path, known) || known === file.path) continue;
          const mine = out.get(file.path) ?? [];
          for (const prefix of list) {
            const longer = `${each.id}.${prefix}`;
            if (!mine.includes(longer)) mine.push(longer);
          }
          out.set(file.path, mine);
        }
      }
    }
  }
  return out;
}

export interface Target {
  path: string;
  name: string;
  /** The definition whose parameter it is; null for what the whole file knows. */
  within: Span | null;
}

/** What the name at an offset means: a parameter of its rule, or something of a file. */
export function targetAt(files: RuleFile[], path: string, offset: number): Target | null {
  const file = files.find((f) => f.path === path);
  if (!file) return null;
  const notation = notationOf(path);
  const token = tokenize(file.text).find(
    (t) =>
      t.from <= offset &&
      offset <= t.to &&
      (t.kind === 'name' || (t.kind === 'string' && notation === 'GBBG')),
  );
  if (!token) return null;
  const word = token.kind === 'string' ? token.text.slice(1, -1) : token.text;
  const defined = definitions(file.text, notation);
  const around = defined.find((d) => d.from <= token.from && token.to <= d.to);
  if (around?.parameters.includes(word))
    return { path, name: word, within: { from: around.from, to: around.to } };
  if (!word.includes('.')) return { path, name: word, within: null };
  // "id.Name": the longest prefix that is an import.
  const [id = '', ...rest] = word.split('.');
  const imported = imports(file).find((i) => i.id === id);
  const other = imported && files.find((f) => sameFile(path, imported.path, f.path));
  return other
    ? { path: other.path, name: rest.join('.'), within: null }
    : { path, name: word, within: null };
}

/** All places where a target is named, over all files. */
export function uses(files: RuleFile[], target: Target): Use[] {
  const out: Use[] = [];
  const leads = target.within ? new Map([[target.path, ['']]]) : prefixes(files, target.path);
  for (const file of files) {
    const notation = notationOf(file.path);
    const words = (leads.get(file.path) ?? []).map((p) => p + target.name);
    if (!words.length) continue;
    const defined = definitions(file.text, notation);
    for (const token of tokenize(file.text)) {
      const text =
        token.kind === 'string' && notation === 'GBBG' ? token.text.slice(1, -1) : token.text;
      if (
        (token.kind !== 'name' && !(token.kind === 'string' && notation === 'GBBG')) ||
        !words.includes(text)
      )
        continue;
      const around = defined.find((d) => d.from <= token.from && token.to <= d.to);
      if (
        target.within
          ? token.from < target.within.from || token.to > target.within.to
          : around?.parameters.includes(text)
      )
        continue;
      // The name alone, without the imports in front of it.
      const from = token.kind === 'string' ? token.from + 1 : token.to - target.name.length;
      const to = token.kind === 'string' ? token.to - 1 : token.to;
      out.push({
        path: file.path,
        from,
        to,
        definition: defined.some((d) => d.nameSpan.from <= from && to <= d.nameSpan.to),
      });
    }
  }
  return out;
}

/** Where a target is defined. */
export function definitionOf(
  files: RuleFile[],
  target: Target,
): { path: string; definition: Definition } | null {
  const file = files.find((f) => f.path === target.path);
  const definition =
    file && definitions(file.text, notationOf(file.path)).find((d) => d.name === target.name);
  return definition ? { path: target.path, definition } : null;
}

export interface Change extends Span {
  insert: string;
}

/** Applies changes that do not overlap. */
export function applyChanges(text: string, changes: Change[]): string {
  let out = text;
  for (const c of [...changes].sort((a, b) => b.from - a.from))
    out = out.slice(0, c.from) + c.insert + out.slice(c.to);
  return out;
}

/** A sentence where a name cannot be used, or null. */
export function nameTrouble(name: string, taken: Iterable<string>): string | null {
  if (!/^[A-Za-z_]\w*$/.test(name))
    return 'A name is letters, digits and _, and begins with no digit.';
  return [...taken].includes(name) ? `There is already something called ${name}.` : null;
}

/** The changes that give a target another name, by file. */
export function rename(files: RuleFile[], target: Target, name: string): Map<string, Change[]> {
  const out = new Map<string, Change[]>();
  for (const use of uses(files, target)) {
    out.set(use.path, [...(out.get(use.path) ?? []), { from: use.from, to: use.to, insert: name }]);
  }
  return out;
}

/** A name that is free: "Facade_2", "Facade_3", ... */
export function freeName(name: string, taken: Iterable<string>): string {
  const all = new Set(taken);
  const stem = name.replace(/_\d+$/, '');
  for (let i = 2; ; ++i) if (!all.has(`${stem}_${i}`)) return `${stem}_${i}`;
}

/** A copy of a definition under another name, right behind it. */
export function duplicate(text: string, definition: Definition, name: string): Change {
  const copy =
    text.slice(definition.from, definition.nameSpan.from) +
    name +
    text.slice(definition.nameSpan.to, definition.to);
  const gap =
    text.slice(definition.from, definition.to).includes('\n') || text[definition.to] !== '\n'
      ? '\n\n'
      : '\n';
  return { from: definition.to, to: definition.to, insert: gap + copy };
}

/** The text without a definition, its annotations and the comments above it. */
export function removal(text: string, definition: Definition): Change {
  let to = definition.to;
  const line = text.indexOf('\n', to);
  const rest = text.slice(to, line < 0 ? text.length : line);
  if (/^\s*(\/\/.*|#.*)?$/.test(rest)) to = line < 0 ? text.length : line + 1;
  while (text[to] === '\n' && (definition.lead === 0 || text[definition.lead - 1] === '\n')) ++to;
  return { from: definition.lead, to, insert: '' };
}
