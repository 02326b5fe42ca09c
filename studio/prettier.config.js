// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
export default {
  printWidth: 100,
  singleQuote: true,
  plugins: ['prettier-plugin-svelte'],
  overrides: [{ files: '*.svelte', options: { parser: 'svelte' } }],
};
