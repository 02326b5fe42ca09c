// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The page of all examples: a large picture of each, what it is, and further pictures.

import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { escaped } from './html';
import { relative, type Links } from './links';
import { type Content, type Markdown, pngSize } from './markdown';
import type { Page } from './pages';

/** The pictures of an example, the one that shows it best first. */
function picturesOf(root: string, folder: string, name: string): string[] {
  const all = readdirSync(join(root, folder)).filter((file) => file.endsWith('.png'));
  const first = `${name}.png`;
  return all.sort((a, b) => Number(b === first) - Number(a === first) || (a < b ? -1 : 1));
}

/** The first paragraph of a page that is words. */
export function introduction(html: string): string {
  for (const [, words = ''] of html.matchAll(/<p>([\s\S]*?)<\/p>/g)) {
    if (!/^\s*<(img|a[^>]*><img)/.test(words)) return words.replace(/<\/?a[^>]*>/g, '');
  }
  return '';
}

function card(
  gallery: Page,
  page: Page,
  root: string,
  markdown: Markdown,
  links: Links,
  models: string | undefined,
): string {
  const folder = page.source.replace(/\/README\.md$/, '');
  const name = folder.replace(/^.*\//, '');
  const pictures = picturesOf(root, folder, name).map((file, at) => {
    const source = links.resolve(gallery, `${name}/${file}`);
    const [width, height] = pngSize(join(root, folder, file)) ?? [1600, 900];
    const alt = at ? `${page.title}, another view` : page.title;
    return `<img src="${source}" alt="${escaped(alt)}" width="${width}" height="${height}" loading="lazy">`;
  });
  const words = introduction(
    markdown.page(page, readFileSync(join(root, page.source), 'utf8')).html,
  );
  const turns = models && existsSync(join(models, `${name}.glb`));
  const address = relative(gallery.path, page.path);
  return `<article class="example"><a href="${address}">${pictures[0] ?? ''}</a>
<div class="more">${pictures.slice(1).join('')}</div>
<h3><a href="${address}">${escaped(page.title)}</a></h3><p>${words}</p>
${turns ? `<p><a href="${address}">Turn its model</a></p>` : ''}</article>`;
}

/** The page of examples: cards in the place of its table, and what else it says. */
export function galleryPage(
  content: Content,
  pages: Page[],
  root: string,
  markdown: Markdown,
  links: Links,
  models: string | undefined,
): Content {
  const gallery = pages.find((page) => page.source === 'examples/README.md')!;
  const shown = pages.filter(
    (page) =>
      /^examples\/[^/]+\/README\.md$/.test(page.source) &&
      picturesOf(root, page.source.replace(/\/README\.md$/, ''), '').length > 0,
  );
  const cards = shown.map((page) => card(gallery, page, root, markdown, links, models));
  const table = /<div class="scroll"[^>]*><table>[\s\S]*?<\/table><\/div>/;
  const html = content.html.replace(table, () => `<div class="gallery">${cards.join('')}</div>`);
  return { ...content, html };
}
