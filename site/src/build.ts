// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Makes the site: each Markdown file and each notebook of the documentation becomes a page, each file that a page links to
// comes along, and nothing is fetched from elsewhere when somebody reads it.
//
//   node build.mjs --root REPOSITORY --out FOLDER [--models FOLDER]
//
// `--models` is a folder with NAME.glb for examples; their pages let the reader turn them.

import { cpSync, existsSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { bundleClient } from './bundle';
import { galleryPage } from './gallery';
import { highlighter } from './highlight';
import { layout } from './layout';
import { Links } from './links';
import { Markdown } from './markdown';
import { findPages, navigation, textOf, type Page } from './pages';
import { SearchText } from './search';
import { folderPage, sourcePage } from './source';

interface Options {
  root: string;
  out: string;
  models: string | undefined;
}

function options(): Options {
  const { values } = parseArgs({
    options: {
      root: { type: 'string', default: '..' },
      out: { type: 'string', default: '../build/site' },
      models: { type: 'string' },
    },
  });
  const models = values.models && existsSync(values.models) ? resolve(values.models) : undefined;
  return { root: resolve(values.root), out: resolve(values.out), models };
}

function write(out: string, path: string, text: string): void {
  const file = join(out, path);
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, text);
}

/** Where the model of an example's page is, within the site; nothing where there is none. */
function modelOf(page: Page, models: string | undefined): string | undefined {
  const example = /^examples\/([^/]+)\/README\.md$/.exec(page.source)?.[1];
  if (!models || !example || !existsSync(join(models, `${example}.glb`))) return undefined;
  return `models/${example}.glb`;
}

async function main(): Promise<void> {
  const { root, out, models } = options();
  const pages = findPages(root);
  const links = new Links(root, pages);
  const colour = await highlighter(root);
  const markdown = new Markdown(root, links, colour);
  const search = new SearchText();
  const menu = navigation(pages);

  rmSync(out, { recursive: true, force: true });
  for (const page of pages) {
    const text = textOf(root, page.source);
    const model = modelOf(page, models);
    const content =
      page.source === 'examples/README.md'
        ? galleryPage(markdown.page(page, text), pages, root, markdown, links, models)
        : markdown.page(page, text);
    write(out, page.path, layout({ page, content, menu, model }));
    search.add(page, content.sections);
    if (model && models) {
      mkdirSync(join(out, 'models'), { recursive: true });
      cpSync(join(models, basename(model)), join(out, model));
    }
  }

  // What pages link to comes along; pages of sources link to nothing further.
  for (const path of links.sources()) {
    const page: Page = { source: path, path: links.sourcePath(path), title: path, group: 'Files' };
    write(out, page.path, layout({ page, content: await sourcePage(root, path, colour), menu }));
  }
  for (const path of links.folders()) {
    const page: Page = { source: path, path: links.folderPath(path), title: path, group: 'Files' };
    write(out, page.path, layout({ page, content: folderPage(root, path), menu }));
  }
  for (const path of links.files()) {
    mkdirSync(dirname(join(out, path)), { recursive: true });
    cpSync(join(root, path), join(out, path));
  }

  write(out, 'assets/search.js', search.script());
  await bundleClient(root, join(out, 'assets'));
  console.log(
    `${pages.length} pages, ${links.sources().length} files shown, ${links.files().length} files copied`,
  );
}

await main();
