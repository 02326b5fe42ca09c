// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The Markdown that the server explains words in, as elements: paragraphs, headings, code, lists,
// tables; links are their text. Nothing of it is ever taken for HTML.

type Block =
  | { kind: 'text' | 'heading'; text: string }
  | { kind: 'code'; text: string }
  | { kind: 'list'; items: string[] }
  | { kind: 'table'; rows: string[][] };

const cells = (line: string) =>
  line
    .replace(/^\||\|$/g, '')
    .split(/(?<!\\)\|/)
    .map((c) => c.trim().replace(/\\\|/g, '|'));

/** Text to blocks. */
export function blocksOf(markdown: string): Block[] {
  const out: Block[] = [];
  const lines = markdown.split('\n');
  for (let i = 0; i < lines.length; ++i) {
    const line = lines[i]!;
    const last = out.at(-1);
    const follows = i > 0 && lines[i - 1]!.trim() !== '';
    if (line.startsWith('```')) {
      const code: string[] = [];
      for (++i; i < lines.length && !lines[i]!.startsWith('```'); ++i) code.push(lines[i]!);
      out.push({ kind: 'code', text: code.join('\n') });
    } else if (/^#+ /.test(line)) out.push({ kind: 'heading', text: line.replace(/^#+ /, '') });
    else if (/^\s*[-*] /.test(line)) {
      const item = line.replace(/^\s*[-*] /, '');
      if (last?.kind === 'list') last.items.push(item);
      else out.push({ kind: 'list', items: [item] });
    } else if (line.startsWith('|')) {
      if (/^[|\s:-]+$/.test(line)) continue;
      if (last?.kind === 'table') last.rows.push(cells(line));
      else out.push({ kind: 'table', rows: [cells(line)] });
    } else if (line.trim() && !/^---+$/.test(line) && !line.startsWith('![')) {
      if (last?.kind === 'text' && follows) last.text += ` ${line.trim()}`;
      else out.push({ kind: 'text', text: line.trim() });
    }
  }
  return out;
}

const INLINE = /`([^`]+)`|\*\*([^*]+)\*\*|\*([^*]+)\*|\[((?:[^[\]]|`[^`]*`)+)\]\([^)]*\)/g;

function inline(into: HTMLElement, text: string): HTMLElement {
  let at = 0;
  for (const m of text.matchAll(INLINE)) {
    into.append(text.slice(at, m.index));
    at = m.index + m[0].length;
    if (m[4] !== undefined) {
      inline(into, m[4]);
      continue;
    }
    const part = document.createElement(
      m[1] !== undefined ? 'code' : m[2] !== undefined ? 'b' : 'i',
    );
    part.textContent = m[1] ?? m[2] ?? m[3] ?? '';
    into.append(part);
  }
  into.append(text.slice(at));
  return into;
}

function element(block: Block): HTMLElement {
  if (block.kind === 'code') {
    const pre = document.createElement('code');
    pre.className = 'lines';
    pre.textContent = block.text;
    return pre;
  }
  if (block.kind === 'list') {
    const list = document.createElement('ul');
    for (const item of block.items) list.append(inline(document.createElement('li'), item));
    return list;
  }
  if (block.kind === 'table') {
    const table = document.createElement('table');
    block.rows.forEach((row, i) => {
      const line = table.insertRow();
      for (const cell of row)
        line.append(inline(document.createElement(i === 0 ? 'th' : 'td'), cell));
    });
    return table;
  }
  const p = document.createElement('p');
  if (block.kind === 'heading') p.className = 'heading';
  return inline(p, block.text);
}

/** A card with the text in it. */
export function card(markdown: string, className = 'hover-card'): HTMLElement {
  const out = document.createElement('div');
  out.className = className;
  for (const block of blocksOf(markdown)) out.append(element(block));
  return out;
}
