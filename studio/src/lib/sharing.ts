// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Puts a place of the project into a bundle, and a bundle into the project.

import { referredBy, resolved } from './references';
import { decode, fromBase64, toBase64, type Bundle } from './share';
import type { Studio } from './studio.svelte';

const TEXTS = /\.(cga|gbbg|grammar|pg3d|park|geojson|json|obj|mtl|gltf|csv|txt|md)$/i;

async function contentOf(studio: Studio, path: string): Promise<string | Uint8Array> {
  const doc = studio.documents.doc(path);
  if (doc) return doc.text;
  if (TEXTS.test(path)) return (await studio.client.read(path)).text;
  return new Uint8Array(await studio.client.readBytes(path));
}

/** The place that is open, with all files that its rules, its values and its models name. */
export async function bundleOf(studio: Studio): Promise<Bundle> {
  await studio.refreshFiles();
  const known = new Set(studio.files.map((f) => f.path));
  const folder = studio.main.slice(0, studio.main.lastIndexOf('/') + 1);
  const files: Record<string, string> = {};
  const queue = [studio.main];
  const { shapes, attributes } = studio.place;
  if ('file' in shapes) queue.push(shapes.file);
  for (const value of Object.values(attributes)) {
    queue.push(...resolved(value.replace(/^"|"$/g, ''), folder, known));
  }
  for (let path = queue.pop(); path !== undefined; path = queue.pop()) {
    if (files[path] !== undefined) continue;
    const content = await contentOf(studio, path);
    files[path] = typeof content === 'string' ? content : `base64:${toBase64(content)}`;
    queue.push(...referredBy(path, content, known));
  }
  const name = studio.main.slice(studio.main.lastIndexOf('/') + 1).replace(/\.\w+$/, '');
  const place = JSON.parse(JSON.stringify(studio.place)) as Bundle['place'];
  return withoutFolder({ gable: 1, name, main: studio.main, place, files });
}

/** Paths count from the folder that all files lie in. */
export function withoutFolder(bundle: Bundle): Bundle {
  const folder = bundle.main.slice(0, bundle.main.lastIndexOf('/') + 1);
  if (!folder || !Object.keys(bundle.files).every((p) => p.startsWith(folder))) return bundle;
  const { shapes } = bundle.place;
  return {
    ...bundle,
    main: bundle.main.slice(folder.length),
    files: Object.fromEntries(
      Object.entries(bundle.files).map(([p, t]) => [p.slice(folder.length), t]),
    ),
    place:
      'file' in shapes
        ? { ...bundle.place, shapes: { ...shapes, file: shapes.file.slice(folder.length) } }
        : bundle.place,
  };
}

/** Opens what somebody shared as a copy in a folder of its own; a sentence where that fails. */
export async function openShared(studio: Studio, text: string): Promise<string | null> {
  const bundle = await decode(text);
  if (typeof bundle === 'string') return bundle;
  const stem = `shared-${bundle.name.replace(/[^\w-]/g, '') || 'place'}`;
  let folder = stem;
  for (let i = 2; studio.files.some((f) => f.path.startsWith(`${folder}/`)); ++i)
    folder = `${stem}-${i}`;
  try {
    await studio.client.create(
      Object.entries(bundle.files).map(([path, content]) => [
        `${folder}/${path}`,
        content.startsWith('base64:') ? new Blob([fromBase64(content.slice(7))]) : content,
      ]),
    );
    await studio.refreshFiles();
    const place = bundle.place;
    const shapes =
      'file' in place.shapes
        ? { ...place.shapes, file: `${folder}/${place.shapes.file}` }
        : place.shapes;
    await studio.openRules(`${folder}/${bundle.main}`, { ...place, shapes });
  } catch (error) {
    return `It could not be opened: ${(error as Error).message}`;
  }
  studio.say(`Opened a copy in ${folder}`);
  return null;
}
