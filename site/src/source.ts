// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pages of files and folders that the documentation points to.

import { readdirSync, readFileSync, statSync } from 'node:fs';
import { extname, join } from 'node:path';
import type { Highlight } from './highlight';
import { escaped } from './html';
import type { Content } from './markdown';

/** Longer files are shown up to here. */
const kMostBytes = 200_000;

export async function sourcePage(root: string, path: string, colour: Highlight): Promise<Content> {
  const text = readFileSync(join(root, path), 'utf8').slice(0, kMostBytes);
  const html = `<h1>${escaped(path)}</h1>${colour(text, extname(path).slice(1))}`;
  return { html, sections: [], headings: [] };
}

export function folderPage(root: string, path: string): Content {
  const names = readdirSync(join(root, path)).sort();
  const rows = names.map((name) => {
    const folder = statSync(join(root, path, name)).isDirectory();
    return `<li>${escaped(name)}${folder ? '/' : ''}</li>`;
  });
  const html = `<h1>${escaped(path)}/</h1><ul class="files">${rows.join('')}</ul>`;
  return { html, sections: [], headings: [] };
}
