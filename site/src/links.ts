// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where links of the Markdown files lead within the site. What they lead to is noted, so that it comes
// along: pictures and models as they are, texts and folders as pages that show them.

import { existsSync, readdirSync, statSync } from 'node:fs';
import { extname, join, posix } from 'node:path';
import type { Page } from './pages';

/** Files that a browser shows or saves as they are. */
const kAsTheyAre = new Set(['.png', '.jpg', '.svg', '.glb', '.webm', '.gpkg', '.csv', '.json']);

/** The address of `to` on the page `from`; both are paths within the site. */
export function relative(from: string, to: string): string {
  return posix.relative(posix.dirname(from), to) || posix.basename(to);
}

export class Links {
  private readonly pages: Map<string, Page>;
  private readonly copied = new Set<string>();
  private readonly shown = new Set<string>();
  private readonly listed = new Set<string>();

  constructor(
    private readonly root: string,
    pages: Page[],
  ) {
    this.pages = new Map(pages.map((page) => [page.source, page]));
  }

  files(): string[] {
    return [...this.copied].sort();
  }
  sources(): string[] {
    return [...this.shown].sort();
  }
  folders(): string[] {
    return [...this.listed].sort();
  }

  sourcePath(path: string): string {
    return `source/${path}.html`;
  }
  folderPath(path: string): string {
    return `source/${path}/index.html`;
  }

  /** The address of a link of `page`. Throws where it leads to nothing. */
  resolve(page: Page, link: string): string {
    if (/^[a-z][a-z0-9+.-]*:/i.test(link)) return link;
    const [target = '', anchor] = link.split('#');
    const tail = anchor === undefined ? '' : `#${anchor}`;
    if (!target) return tail;
    const path = posix.normalize(
      posix.join(posix.dirname(page.source), decodeURIComponent(target)),
    );
    return relative(page.path, this.within(page, path.replace(/\/$/, ''))) + tail;
  }

  private within(page: Page, path: string): string {
    const file = join(this.root, path);
    if (path.startsWith('..') || !existsSync(file)) {
      throw new Error(`${page.source}: the link to ${path} leads to nothing`);
    }
    const known = this.pages.get(path) ?? this.pages.get(posix.join(path, 'README.md'));
    if (known) return known.path;
    if (statSync(file).isDirectory()) return this.folder(path);
    if (kAsTheyAre.has(extname(path))) {
      this.copied.add(path);
      return path;
    }
    this.shown.add(path);
    return this.sourcePath(path);
  }

  /** A folder is a list of its files, each of which is shown. */
  private folder(path: string): string {
    this.listed.add(path);
    for (const name of readdirSync(join(this.root, path))) {
      const file = posix.join(path, name);
      const whole = !statSync(join(this.root, file)).isDirectory();
      if (whole && !kAsTheyAre.has(extname(name))) this.shown.add(file);
    }
    return this.folderPath(path);
  }
}
