// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';

// The studio's page with the engine of build/wasm in a worker, as static files for any folder of
// any server. tools/playground.sh adds the examples.
export default defineConfig({
  base: './',
  plugins: [
    svelte(),
    {
      name: 'playground',
      transformIndexHtml: {
        order: 'pre',
        handler: (html) =>
          html
            .replace('/src/main.ts', '/playground/main.ts')
            .replace('<title>Gable studio', '<title>Gable playground'),
      },
    },
  ],
  resolve: { alias: { 'gable-wasm': new URL('../build/wasm', import.meta.url).pathname } },
  worker: { format: 'es' },
  build: {
    outDir: '../build/playground',
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0,
  },
});
