// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the type checker does not see. Prettier lays out the text; columns are limited here as well,
// for the lines that it cannot break.
import js from '@eslint/js';
import svelte from 'eslint-plugin-svelte';
import globals from 'globals';
import ts from 'typescript-eslint';

const columns = { code: 100, ignoreUrls: true };
// A file of the page has one purpose; a function fits a screen.
const sizes = {
  'max-len': ['error', columns],
  'max-lines': ['error', 600],
  'max-lines-per-function': ['error', 100],
};

export default ts.config(
  js.configs.recommended,
  ...ts.configs.recommended,
  ...svelte.configs.recommended,
  {
    files: ['src/**/*.ts', 'src/**/*.svelte'],
    languageOptions: {
      globals: globals.browser,
      parserOptions: { parser: ts.parser, extraFileExtensions: ['.svelte'] },
    },
    rules: {
      ...sizes,
      eqeqeq: 'error',
      '@typescript-eslint/no-non-null-assertion': 'off',
      // Keys of lists whose items have no name of their own would only be their index.
      'svelte/require-each-key': 'off',
      // The compiler's own warnings are checked by svelte-check.
      'svelte/no-unused-svelte-ignore': 'off',
      'svelte/no-useless-mustaches': 'off',
      // Collections that no panel reads need not be watched.
      'svelte/prefer-svelte-reactivity': 'off',
      // `void studio.selected` in an effect says what the effect depends on.
      'no-void': 'off',
    },
  },
  // A suite of tests is one function.
  { files: ['src/**/*.test.ts'], rules: { 'max-lines-per-function': 'off' } },
  {
    files: ['e2e/**/*.mjs', '*.js', '*.ts'],
    languageOptions: { globals: { ...globals.node, ...globals.browser } },
    rules: {
      ...sizes,
      // A journey is read from its top to its end, and has grammars and rules as they are written.
      'max-lines-per-function': 'off',
      'max-len': ['error', { ...columns, ignoreStrings: true, ignoreTemplateLiterals: true }],
      // What a page gives back is a promise that the evaluation waits for.
      'no-constant-binary-expression': 'off',
    },
  },
);
