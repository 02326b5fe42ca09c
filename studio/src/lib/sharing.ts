// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Puts a place of the project into a bundle, and a bundle into the project.

import type { Place } from './place';
import { referredBy, resolved } from './references';
import { decode, encode, fromBase64, LONGEST_LINK, toBase64, type Bundle } from './share';
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

/**
 * The same where Gable's examples come with the page: of a copy of an example only what has been
 * changed.
 */
async function smallBundleOf(studio: Studio): Promise<Bundle> {
  const { example, main } = studio;
  if (!example || !main.startsWith(`${example.folder}/`)) return bundleOf(studio);
  const edited = studio.documents.open.filter((doc) => doc.text !== doc.saved);
  return {
    gable: 1,
    name: example.name,
    main: moved(main, example.folder, example.name),
    example: example.name,
    place: placeIn(studio.place, example.folder, example.name),
    files: Object.fromEntries(
      edited.map(({ path, text }) => [moved(path, example.folder, example.name), text]),
    ),
  };
}

/** The bundle that a link holds. */
export async function linkOf(studio: Studio): Promise<{ bundle: Bundle; link: string }> {
  const bundle = await (studio.client.kept ? bundleOf(studio) : smallBundleOf(studio));
  return { bundle, link: `#share=${await encode(bundle)}` };
}

/** The address of the page with the place in it; empty where it is too large for a link. */
export async function addressOf(studio: Studio): Promise<string> {
  const { link } = await linkOf(studio);
  return link.length > LONGEST_LINK ? '' : link;
}

/** A path with another folder in front. */
function moved(path: string, from: string, to: string): string {
  return path.startsWith(`${from}/`) ? to + path.slice(from.length) : path;
}

function placeIn(place: Place, from: string, to: string): Place {
  const copy = JSON.parse(JSON.stringify(place)) as Place;
  if ('file' in copy.shapes) copy.shapes.file = moved(copy.shapes.file, from, to);
  return copy;
}

/** Opens a copy of the example, and in it the texts that were changed. */
async function openChanged(studio: Studio, bundle: Bundle, name: string): Promise<void> {
  const folder = await studio.client.copyExample(name);
  await studio.refreshFiles();
  studio.example = { name, folder };
  const texts: [string, string][] = [];
  for (const [path, text] of Object.entries(bundle.files)) {
    const here = moved(path, name, folder);
    await studio.documents.load(here);
    texts.push([here, text]);
  }
  const place = placeIn(bundle.place, name, folder);
  await studio.openRules(moved(bundle.main, name, folder), place);
  studio.editAll(texts, 'Open what was shared');
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
  const { example } = bundle;
  if (example) {
    try {
      await openChanged(studio, bundle, example);
      return null;
    } catch (error) {
      return `It could not be opened: ${(error as Error).message}`;
    }
  }
  studio.example = null;
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
