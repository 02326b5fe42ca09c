// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which files become pages, what they are called, and in which order the menu has them.

import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { notebookText } from './notebook';

export interface Page {
  /** The file, relative to the repository. */
  source: string;
  /** The page, relative to the site. */
  path: string;
  title: string;
  /** The part of the menu that it stands in. */
  group: string;
}

export interface MenuGroup {
  title: string;
  pages: Page[];
  /** Folded until a page of it is open. */
  folded: boolean;
}

/** What stands first in the menu, in this order; pages that no line names follow in that of their files. */
const kOrder = [
  'README.md',
  'docs/guide/first-rules.md',
  'docs/guide/installing.md',
  'docs/guide/studio.md',
  'docs/guide/your-lot.md',
  'docs/guide/imports.md',
  'docs/guide/regions.md',
  'docs/guide/materials.md',
  'docs/guide/sharing.md',
  'docs/guide/games.md',
  'docs/guide/debugging.md',
  'docs/guide/rule-tests.md',
  'docs/guide/projects.md',
  'docs/guide/cityengine.md',
  'docs/guide/gbbg.md',
  'docs/guide/park.md',
  'docs/guide/progen3d.md',
  'docs/guide/city.md',
  'docs/guide/tiles.md',
  'docs/guide/planning-a-country.md',
  'docs/guide/suburb.md',
  'docs/guide/castle.md',
  'docs/guide/blender.md',
  'docs/guide/editors.md',
  'docs/guide/python.md',
  'docs/guide/embedding.md',
  'examples/README.md',
  'docs/reference/README.md',
  'docs/reference/operations.md',
  'docs/reference/functions.md',
  'docs/reference/attributes.md',
  'docs/reference/selectors.md',
  'docs/reference/diagnostics.md',
  'docs/reference/command-line.md',
  'docs/reference/profiles.md',
  'docs/design/life-of-a-rule.md',
  'docs/dev/architecture.md',
  'CONTRIBUTING.md',
];

/** Folders and their group; the first that a file's path begins with. */
const kGroups: readonly (readonly [prefix: string, title: string, folded: boolean])[] = [
  ['README.md', 'Begin', false],
  ['docs/guide/', 'Guides', false],
  ['docs/notebooks/', 'Notebooks', true],
  ['examples/', 'Examples', true],
  ['docs/reference/operations/', 'Operations', true],
  ['docs/reference/functions/', 'Functions', true],
  ['docs/reference/', 'Reference', false],
  ['docs/design/', 'Design', true],
  ['docs/', 'Developing', true],
  ['editors/', 'Developing', true],
  ['tests/', 'Developing', true],
  ['CONTRIBUTING.md', 'Developing', true],
  ['CHANGELOG.md', 'Developing', true],
];

/** Folders of the repository with pages. */
const kFolders = ['docs', 'examples', 'editors', 'tests/cases'];

function pagesIn(root: string, folder: string): string[] {
  const found: string[] = [];
  for (const name of readdirSync(join(root, folder)).sort()) {
    if (name === 'node_modules') continue;
    const path = folder ? `${folder}/${name}` : name;
    if (statSync(join(root, path)).isDirectory()) found.push(...pagesIn(root, path));
    else if (/\.(md|ipynb)$/.test(name)) found.push(path);
  }
  return found;
}

/** The first heading of a text without its marks, or nothing. */
export function titleOf(text: string): string | undefined {
  const heading = /^#[ \t]+(.+?)[ \t#]*$/m.exec(text)?.[1];
  return heading?.replace(/\[([^\]]*)\]\([^)]*\)/g, '$1').replace(/[`*]/g, '');
}

/** `README.md` is the index of its folder. */
export function pathOf(source: string): string {
  return source.replace(/(^|\/)README\.md$/, '$1index.html').replace(/\.(md|ipynb)$/, '.html');
}

/** A page's text in Markdown. */
export function textOf(root: string, source: string): string {
  const text = readFileSync(join(root, source), 'utf8');
  return source.endsWith('.ipynb') ? notebookText(text) : text;
}

export function findPages(root: string): Page[] {
  const files = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md'];
  for (const folder of kFolders) files.push(...pagesIn(root, folder));
  const rank = (file: string) => {
    const place = kOrder.indexOf(file);
    return place < 0 ? kOrder.length : place;
  };
  return files
    .map((source) => {
      const group = kGroups.find(([prefix]) => source.startsWith(prefix))?.[1] ?? 'Developing';
      const title = titleOf(textOf(root, source)) ?? source;
      return { source, path: pathOf(source), title, group };
    })
    .sort((a, b) => rank(a.source) - rank(b.source) || (a.source < b.source ? -1 : 1));
}

export function navigation(pages: Page[]): MenuGroup[] {
  const groups = new Map<string, MenuGroup>();
  for (const [, title, folded] of kGroups) {
    if (!groups.has(title)) groups.set(title, { title, pages: [], folded });
  }
  // Licences of data are read from the pages of their examples.
  const listed = pages.filter((page) => !page.source.endsWith('/NOTICE.md'));
  for (const page of listed) groups.get(page.group)?.pages.push(page);
  return [...groups.values()].filter((group) => group.pages.length > 0);
}
