// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Colours of code, by the grammars of the extension for editors. Colours are variables of the style
// sheet, so they follow the theme.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { createCssVariablesTheme, createHighlighterCore } from 'shiki/core';
import { createJavaScriptRegexEngine } from 'shiki/engine/javascript';
import c from 'shiki/langs/c.mjs';
import cmake from 'shiki/langs/cmake.mjs';
import cpp from 'shiki/langs/cpp.mjs';
import json from 'shiki/langs/json.mjs';
import python from 'shiki/langs/python.mjs';
import shell from 'shiki/langs/shellscript.mjs';
import type { LanguageRegistration } from 'shiki';
import { escaped } from './html';

/** Code as HTML: a `pre` with colours, or without where the language is not known. */
export type Highlight = (code: string, language: string) => string;

/** What fences and extensions of files call the languages. */
const kNames: Record<string, string> = {
  cga: 'cga',
  test: 'cga',
  gbbg: 'gbbg',
  park: 'gbbg',
  grammar: 'gbbg',
  pg3d: 'gbbg',
  c: 'c',
  h: 'cpp',
  cpp: 'cpp',
  cmake: 'cmake',
  json: 'json',
  geojson: 'json',
  gltf: 'json',
  python: 'python',
  py: 'python',
  sh: 'shellscript',
};

function grammar(root: string, file: string, name: string): LanguageRegistration {
  const path = join(root, 'editors/vscode/syntaxes', file);
  return { ...(JSON.parse(readFileSync(path, 'utf8')) as LanguageRegistration), name };
}

export async function highlighter(root: string): Promise<Highlight> {
  const theme = createCssVariablesTheme({ name: 'gable', variablePrefix: '--code-' });
  const shiki = await createHighlighterCore({
    themes: [theme],
    langs: [
      grammar(root, 'cga.tmLanguage.json', 'cga'),
      grammar(root, 'grammar.tmLanguage.json', 'gbbg'),
      c,
      cmake,
      cpp,
      json,
      python,
      shell,
    ],
    engine: createJavaScriptRegexEngine({ forgiving: true }),
  });
  return (code, language) => {
    const lang = kNames[language];
    // Code that is wider than the page scrolls; the keyboard reaches it.
    if (!lang) return `<pre class="code" tabindex="0"><code>${escaped(code)}</code></pre>`;
    return shiki
      .codeToHtml(code.replace(/\n$/, ''), { lang, theme: 'gable' })
      .replace(/^<pre[^>]*>/, '<pre class="code" tabindex="0">');
  };
}
