// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Makes the site: each Markdown file and each notebook of the documentation becomes a page, each file that a page links to
// comes along, and nothing is fetched from elsewhere when somebody reads it.
//
//   node build.mjs --root REPOSITORY --out FOLDER [--models FOLDER] [--playground FOLDER]
//
// `--models` is a folder with NAME.glb for examples; their pages let the reader turn them. `--playground` is the one that
// tools/playground.sh has made; examples and rules on pages then open in it.

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
import { exampleOf } from './playground';
import { SearchText } from './search';
import { folderPage, sourcePage } from './source';

interface Options {
  root: string;
  out: string;
  models: string | undefined;
  playground: string | undefined;
}

function options(): Options {
  const { values } = parseArgs({
    options: {
      root: { type: 'string', default: '..' },
      out: { type: 'string', default: '../build/site' },
      models: { type: 'string' },
      playground: { type: 'string' },
    },
  });
  const found = (folder: string | undefined) =>
    folder && existsSync(folder) ? resolve(folder) : undefined;
  const { models, playground } = values;
  return {
    root: resolve(values.root),
    out: resolve(values.out),
    models: found(models),
    playground: found(playground),
  };
}

function write(out: string, path: string, text: string): void {
  const file = join(out, path);
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, text);
}

/** Where the model of an example's page is, within the site; nothing where there is none. */
function modelOf(page: Page, models: string | undefined): string | undefined {
  const example = exampleOf(page.source);
  if (!models || !example || !existsSync(join(models, `${example}.glb`))) return undefined;
  return `models/${example}.glb`;
}

/** The example that the playground opens for a page. Places from maps are for the program. */
function opened(page: Page, root: string, playground: string | undefined): string | undefined {
  const example = playground ? exampleOf(page.source) : undefined;
  const notations = ['cga', 'gbbg', 'grammar', 'park'];
  const rules = notations.some((n) =>
    existsSync(join(root, `examples/${example}/${example}.${n}`)),
  );
  return rules ? example : undefined;
}

async function main(): Promise<void> {
  const { root, out, models, playground } = options();
  const pages = findPages(root);
  const links = new Links(root, pages);
  const colour = await highlighter(root);
  const markdown = new Markdown(root, links, colour, !!playground);
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
    write(
      out,
      page.path,
      layout({ page, content, menu, model, example: opened(page, root, playground) }),
    );
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

  if (playground) cpSync(playground, join(out, 'playground'), { recursive: true });
  write(out, 'assets/search.js', search.script());
  await bundleClient(root, join(out, 'assets'));
  console.log(
    `${pages.length} pages, ${links.sources().length} files shown, ${links.files().length} files copied`,
  );
}

await main();
