// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { defineConfig } from 'vite';

// The page that gable tiles --viewer puts beside tiles: two files, into the folder of the studio's
// page, after that.
export default defineConfig({
  root: 'viewer',
  base: './',
  build: {
    outDir: '../../build/studio/viewer',
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: false,
    rollupOptions: { output: { entryFileNames: 'viewer.js', inlineDynamicImports: true } },
  },
});
