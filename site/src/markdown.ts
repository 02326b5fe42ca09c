// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Markdown as HTML. Headings get the names that they have on the usual viewers, so that links between
// pages hold; links and pictures lead into the site; pictures have their sizes, so nothing jumps.

import { closeSync, openSync, readSync } from 'node:fs';
import { join, posix } from 'node:path';
import MarkdownIt from 'markdown-it';
import type { Highlight } from './highlight';
import { relative, type Links } from './links';
import type { Page } from './pages';
import { fragmentOf, PLAYGROUND } from './playground';

/** A heading and the text below it, for the search. */
export interface Section {
  title: string;
  anchor: string;
  text: string;
}

export interface Content {
  html: string;
  sections: Section[];
  /** The headings of the second level, for the list beside the text. */
  headings: { title: string; anchor: string }[];
}

/** The name of a heading, without the number that tells equal ones apart. */
export function slug(heading: string): string {
  return heading
    .toLowerCase()
    .replace(/[^\p{L}\p{N}_\- ]/gu, '')
    .replace(/ /g, '-');
}

/** Width and height of a PNG, from its first bytes; nothing for other files. */
export function pngSize(file: string): [width: number, height: number] | undefined {
  const bytes = Buffer.alloc(24);
  const handle = openSync(file, 'r');
  readSync(handle, bytes, 0, 24, 0);
  closeSync(handle);
  if (bytes.toString('latin1', 1, 4) !== 'PNG') return undefined;
  return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
}

type Token = ReturnType<MarkdownIt['parse']>[number];

/** What a part of a line says. */
function wordsOf(part: Token): string {
  if (part.type === 'softbreak' || part.type === 'hardbreak') return ' ';
  return part.type === 'image' ? '' : part.content;
}

/** The text of a line without its marks. */
const plain = (line: Token | undefined): string => (line?.children ?? []).map(wordsOf).join('');

export class Markdown {
  private readonly parser: MarkdownIt;

  constructor(
    private readonly root: string,
    private readonly links: Links,
    colour: Highlight,
    private readonly playground = false,
  ) {
    this.parser = new MarkdownIt({ html: true, linkify: false, typographer: false });
    const rules = this.parser.renderer.rules;
    rules.fence = (tokens, at, _, page: Page) => {
      const token = tokens[at]!;
      const language = token.info.trim().split(/\s/)[0] ?? '';
      return colour(token.content, language) + this.tryIt(page, language, token.content);
    };
    rules.code_block = (tokens, at) => colour(tokens[at]!.content, '');
    // Wide tables scroll by themselves, not the page.
    rules.table_open = () => '<div class="scroll" tabindex="0" role="region"><table>';
    rules.table_close = () => '</table></div>';
    // A table without words in its head is one for layout.
    rules.th_open = (tokens, at, settings, _, self) => {
      const empty = !tokens[at + 1]?.content;
      return empty ? '<td>' : self.renderToken(tokens, at, settings);
    };
    rules.th_close = (tokens, at) => (tokens[at - 1]?.content ? '</th>' : '</td>');
  }

  page(page: Page, text: string): Content {
    const tokens = this.parser.parse(text, {});
    this.lead(page, tokens);
    const { sections, headings } = this.divide(page, tokens);
    return {
      html: this.parser.renderer.render(tokens, this.parser.options, page),
      sections,
      headings,
    };
  }

  /** A link that opens rules in the playground. */
  private tryIt(page: Page, language: string, text: string): string {
    const fragment = this.playground && language === 'cga' && fragmentOf(page.title, text);
    if (!fragment) return '';
    return `<p class="try"><a href="${relative(page.path, PLAYGROUND)}${fragment}">Try it</a></p>`;
  }

  /** Links and pictures lead into the site. */
  private lead(page: Page, tokens: Token[]): void {
    for (const token of tokens) {
      if (token.children) this.lead(page, token.children);
      if (token.type === 'link_open') {
        token.attrSet('href', this.links.resolve(page, token.attrGet('href') ?? ''));
      }
      if (token.type === 'image') this.picture(page, token);
    }
  }

  private picture(page: Page, token: Token): void {
    const source = token.attrGet('src') ?? '';
    token.attrSet('src', this.links.resolve(page, source));
    token.attrSet('loading', 'lazy');
    if (/^[a-z]+:/.test(source)) return;
    const file = posix.join(posix.dirname(page.source), decodeURIComponent(source));
    const size = pngSize(join(this.root, file));
    if (!size) return;
    token.attrSet('width', String(size[0]));
    token.attrSet('height', String(size[1]));
  }

  /** Names the headings, and collects what stands below each. */
  private divide(page: Page, tokens: Token[]): Omit<Content, 'html'> {
    const sections: Section[] = [{ title: page.title, anchor: '', text: '' }];
    const headings: Content['headings'] = [];
    const names = new Map<string, number>();
    tokens.forEach((token, at) => {
      if (token.type === 'heading_open') {
        const title = plain(tokens[at + 1]);
        const name = slug(title);
        const before = names.get(name) ?? 0;
        names.set(name, before + 1);
        const anchor = before ? `${name}-${before}` : name;
        token.attrSet('id', anchor);
        if (token.tag === 'h2') headings.push({ title, anchor });
        if (token.tag !== 'h1') sections.push({ title, anchor, text: '' });
        return;
      }
      const heading = tokens[at - 1]?.type === 'heading_open';
      const words = token.type === 'inline' && !heading ? plain(token) : '';
      const code = token.type === 'fence' ? token.content : '';
      sections[sections.length - 1]!.text += words || code ? `${words || code} ` : '';
    });
    return { sections, headings };
  }
}
