// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files that are dropped on the page: they are copied into the project and opened as what they are.

import type { Studio } from './studio.svelte';

type Kind = 'rules' | 'shapes' | 'model' | 'shared' | 'other';

const KINDS: [RegExp, Kind][] = [
  [/\.gable\.json$/i, 'shared'],
  [/\.(cga|gbbg|grammar|pg3d|park)$/i, 'rules'],
  [/\.geojson$/i, 'shapes'],
  [/\.(obj|mtl|glb|gltf|png|jpe?g)$/i, 'model'],
  [/\.(csv|txt|md|json)$/i, 'other'],
];

export function kindOf(name: string): Kind | null {
  return KINDS.find(([pattern]) => pattern.test(name))?.[1] ?? null;
}

/** A name that no file of the project has: "a.cga", "a-2.cga", ... */
export function freePath(path: string, taken: ReadonlySet<string>): string {
  const dot = path.lastIndexOf('.');
  let out = path;
  for (let i = 2; taken.has(out); ++i) out = `${path.slice(0, dot)}-${i}${path.slice(dot)}`;
  return out;
}

/** Copies files into the project, all or none, and opens the last of them that can be opened. */
export async function takeFiles(studio: Studio, files: File[]): Promise<void> {
  const refused = files.find((f) => !kindOf(f.name) || /[\\/:]|^\./.test(f.name));
  if (refused) return studio.fail(`${refused.name} is no kind of file that a project takes.`);
  await studio.attempt('What was dropped could not be taken', async () => {
    const shared = files.find((f) => kindOf(f.name) === 'shared');
    if (shared) {
      const { openShared } = await import('./sharing');
      const said = await openShared(studio, await shared.text());
      if (said) studio.fail(said);
      return;
    }
    await studio.refreshFiles();
    const taken = new Set(studio.files.map((f) => f.path));
    const copies: [string, Blob][] = [];
    for (const file of files) {
      // Models name their materials and pictures: they keep their names, in one folder.
      const folder = kindOf(file.name) === 'model' ? 'assets/' : '';
      const path = freePath(folder + file.name, taken);
      taken.add(path);
      copies.push([path, file]);
    }
    await studio.client.create(copies);
    await studio.refreshFiles();
    const last = (kind: Kind) => copies.filter(([path]) => kindOf(path) === kind).at(-1)?.[0];
    const rules = last('rules');
    const shapes = last('shapes');
    if (rules) await studio.openRules(rules);
    if (shapes && studio.main) studio.change({ shapes: { file: shapes }, seeds: {} }, 'Shapes');
    studio.say(`Copied into the project: ${copies.map(([path]) => path).join(', ')}`);
  });
}
