// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a file of a project refers to: rules name models, pictures and other rules; models name
// their materials and pictures. Names that are not files of the project are left out.

const RULES = /\.(cga|gbbg|grammar|pg3d|park)$/i;

/** Everything written in quotes, with or without an ending. */
function quoted(text: string): string[] {
  return [...text.matchAll(/"([^"\n]{1,300})"|'([^'\n]{1,300})'/g)].map((m) => m[1] ?? m[2]!);
}

/** Names of an OBJ or MTL file; names may have spaces, options stand before them. */
function ofWavefront(text: string): string[] {
  const out: string[] = [];
  for (const line of text.split('\n')) {
    const found = /^\s*(mtllib|map_\w+|bump|disp|decal|norm|refl)\s+(.+?)\s*$/i.exec(line);
    if (!found) continue;
    const words = found[2]!.split(/\s+/);
    // The whole rest is a name, or each word of it, or what follows the options.
    for (let i = 0; i < words.length; ++i) out.push(words.slice(i).join(' '), words[i]!);
  }
  return out;
}

function ofGltf(json: string): string[] {
  try {
    const model = JSON.parse(json) as Record<string, { uri?: string }[] | undefined>;
    return [...(model.buffers ?? []), ...(model.images ?? [])].flatMap((each) =>
      each.uri && !each.uri.startsWith('data:') ? [decodeURIComponent(each.uri)] : [],
    );
  } catch {
    return [];
  }
}

/** The JSON of a binary glTF. */
function jsonOfGlb(bytes: Uint8Array): string {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20 || view.getUint32(16, true) !== 0x4e4f534a) return '';
  return new TextDecoder().decode(bytes.subarray(20, 20 + view.getUint32(12, true)));
}

function normal(path: string): string {
  const out: string[] = [];
  for (const part of path.replaceAll('\\', '/').split('/')) {
    if (part === '..') out.pop();
    else if (part && part !== '.') out.push(part);
  }
  return out.join('/');
}

/** Files of the project that the file `path` with that content refers to. */
export function referredBy(
  path: string,
  content: string | Uint8Array,
  known: ReadonlySet<string>,
): string[] {
  const folder = path.slice(0, path.lastIndexOf('/') + 1);
  const text = typeof content === 'string' ? content : '';
  let names: string[] = [];
  if (RULES.test(path)) names = quoted(text);
  else if (/\.(obj|mtl)$/i.test(path)) names = ofWavefront(text);
  else if (/\.gltf$/i.test(path)) names = ofGltf(text);
  else if (/\.glb$/i.test(path) && typeof content !== 'string') names = ofGltf(jsonOfGlb(content));
  const out = new Set<string>();
  for (const name of names) for (const file of resolved(name, folder, known)) out.add(file);
  out.delete(path);
  return [...out];
}

/** Files that a name written in a file of a folder may mean. */
export function resolved(name: string, folder: string, known: ReadonlySet<string>): string[] {
  const places = [folder + name, name, `assets/${name}`, `${folder}assets/${name}`].map(normal);
  const exact = places.find((p) => known.has(p));
  if (exact) return [exact];
  // A part of a name that is put together: all of its folder; a name without its ending.
  const stem = /^[\w-]+$/.test(name) ? `${name}.` : '';
  const inFolder = name.endsWith('/') && normal(name) ? places.map((p) => `${p}/`) : [];
  return [...known].filter(
    (file) =>
      inFolder.some((p) => file.startsWith(p)) ||
      (stem && /(^|\/)assets\//.test(file) && file.split('/').at(-1)!.startsWith(stem)),
  );
}
