// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Scripts, styles and fonts of the pages. Colours and fonts are those of the studio.

import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build } from 'esbuild';

/** A pitched roof. */
const kIcon = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32"><rect width="32" height="32" rx="7" fill="#0b7a68"/><path d="M5 18 16 7l11 11M9 16v9h14v-9" fill="none" stroke="#fff" stroke-width="2.6" stroke-linecap="round" stroke-linejoin="round"/></svg>`;

export async function bundleClient(root: string, out: string): Promise<void> {
  const folder = join(root, 'site/client');
  mkdirSync(join(out, 'fonts'), { recursive: true });
  await build({
    entryPoints: [join(folder, 'site.ts'), join(folder, 'turn.ts')],
    outdir: out,
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2022',
    logLevel: 'warning',
    legalComments: 'eof',
  });
  const tokens = readFileSync(join(root, 'studio/src/styles/tokens.css'), 'utf8');
  const style = readFileSync(join(folder, 'site.css'), 'utf8');
  writeFileSync(join(out, 'site.css'), tokens.replace(/\.\.\/fonts\//g, 'fonts/') + style);
  for (const file of ['inter.woff2', 'jetbrains-mono.woff2']) {
    copyFileSync(join(root, 'studio/src/fonts', file), join(out, 'fonts', file));
  }
  for (const file of ['LICENSE-inter.txt', 'LICENSE-jetbrains-mono.txt']) {
    copyFileSync(join(root, 'studio/src/fonts', file), join(out, 'fonts', file));
  }
  writeFileSync(join(out, 'icon.svg'), kIcon);
}
