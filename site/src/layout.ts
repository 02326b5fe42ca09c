// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What stands around the text of every page: the head, the menu, the headings beside it, and the pages
// before and behind.

import { escaped } from './html';
import { relative } from './links';
import type { Content } from './markdown';
import type { MenuGroup, Page } from './pages';
import { PLAYGROUND } from './playground';

export interface Parts {
  page: Page;
  content: Content;
  menu: MenuGroup[];
  /** A model that can be turned, as a path within the site. */
  model?: string | undefined;
  /** The example that the playground opens. */
  example?: string | undefined;
}

function menuOf(page: Page, menu: MenuGroup[]): string {
  const rows = menu.map((group) => {
    const here = group.pages.some((each) => each.path === page.path);
    const items = group.pages.map((each) => {
      const current = each.path === page.path ? ' aria-current="page"' : '';
      return `<li><a href="${relative(page.path, each.path)}"${current}>${escaped(each.title)}</a></li>`;
    });
    const open = here || !group.folded ? ' open' : '';
    return `<details${open}><summary>${group.title}</summary><ul>${items.join('')}</ul></details>`;
  });
  return rows.join('');
}

function headingsOf(content: Content): string {
  if (content.headings.length < 2) return '';
  const rows = content.headings.map(
    ({ title, anchor }) => `<li><a href="#${anchor}">${escaped(title)}</a></li>`,
  );
  return `<nav class="headings" aria-label="On this page"><p>On this page</p><ul>${rows.join('')}</ul></nav>`;
}

/** The pages before and behind this one, in the order of the menu. */
function neighboursOf(page: Page, menu: MenuGroup[]): string {
  const all = menu.flatMap((group) => group.pages);
  const at = all.findIndex((each) => each.path === page.path);
  if (at < 0) return '';
  const link = (other: Page | undefined, name: string, word: string) =>
    other
      ? `<a rel="${name}" href="${relative(page.path, other.path)}"><span>${word}</span>${escaped(other.title)}</a>`
      : '<span></span>';
  return `<nav class="neighbours" aria-label="Pages before and behind">${link(all[at - 1], 'prev', 'Before')}${link(all[at + 1], 'next', 'Next')}</nav>`;
}

/** A model to turn, which is loaded when somebody asks for it. */
function modelOf(page: Page, model: string | undefined): string {
  if (!model) return '';
  const script = relative(page.path, 'assets/turn.js');
  return `<figure class="turn" data-model="${relative(page.path, model)}" data-script="${script}">
<button type="button">Turn the model</button>
<figcaption>Drag to turn, scroll to come closer, drag with the right button to move.</figcaption></figure>`;
}

function tryOf(page: Page, example: string | undefined): string {
  if (!example) return '';
  const address = `${relative(page.path, PLAYGROUND)}#example=${example}`;
  return `<p class="try"><a href="${address}">Try it in the browser</a></p>`;
}

export function layout({ page, content, menu, model, example }: Parts): string {
  const asset = (name: string) => relative(page.path, `assets/${name}`);
  const home = relative(page.path, 'index.html');
  const title = page.path === 'index.html' ? 'Gable' : `${page.title} · Gable`;
  const text = content.html.replace(
    '</h1>',
    () => `</h1>${modelOf(page, model)}${tryOf(page, example)}`,
  );
  // The theme is set before anything is drawn, so that no page flashes.
  return `<!doctype html>
<html lang="en" data-theme="light">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(title)}</title>
<meta name="description" content="Gable turns rules into places: the open engine for shape grammars.">
<link rel="icon" href="${asset('icon.svg')}" type="image/svg+xml">
<link rel="stylesheet" href="${asset('site.css')}">
<script>try{var t=localStorage.getItem('gable-theme')}catch(e){}document.documentElement.dataset.theme=t||(matchMedia('(prefers-color-scheme: dark)').matches?'dark':'light')</script>
<script defer src="${asset('site.js')}" data-index="${asset('search.js')}" data-home="${home}"></script>
</head>
<body>
<a class="skip" href="#text">To the text</a>
<header>
<button type="button" class="menu-button" aria-controls="menu" aria-expanded="false">Menu</button>
<a class="brand" href="${home}"><img src="${asset('icon.svg')}" alt="" width="22" height="22">Gable</a>
<div class="search"><input type="search" id="search" placeholder="Search" aria-label="Search the documentation" autocomplete="off" role="combobox" aria-expanded="false" aria-controls="found"><ul id="found" role="listbox" aria-label="Found" hidden></ul></div>
<button type="button" class="theme-button" aria-label="Light or dark">◐</button>
</header>
<div class="page">
<nav id="menu" class="menu" aria-label="Pages">${menuOf(page, menu)}</nav>
<main id="text" tabindex="-1">${text}${neighboursOf(page, menu)}</main>
${headingsOf(content)}
</div>
</body>
</html>
`;
}
