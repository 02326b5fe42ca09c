// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vitest/config';

// The page is built into build/studio of the repository, where the program looks for it.
export default defineConfig({
  plugins: [svelte()],
  build: { outDir: '../build/studio', emptyOutDir: true, target: 'es2022', assetsInlineLimit: 0 },
  // Tests read examples and reference pages of the repository. By number: a bare machine may not
  // know the name localhost.
  server: { host: '127.0.0.1', fs: { allow: ['..'] } },
  test: {
    include: [
      'src/**/*.test.ts',
      'viewer/**/*.test.ts',
      'playground/**/*.test.{ts,mjs}',
      '*.test.ts',
    ],
    environment: 'node',
    css: true,
    testTimeout: 30_000,
  },
});
