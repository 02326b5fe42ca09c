// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a file looks like that rules may name: a picture itself, a model as far as its size.

import { shown } from '../lib/fields';
import type { Studio } from '../lib/studio.svelte';

const PICTURE = /\.(png|jpe?g|webp)$/i;
const MODEL = /\.(glb|gltf|obj)$/i;

/** Where in the project rules find an asset: as they write it, in `assets`, beside themselves. */
export function placesOf(rules: string, asset: string): string[] {
  const plain = asset.replace(/^\//, '');
  const folder = rules.includes('/') ? rules.slice(0, rules.lastIndexOf('/') + 1) : '';
  return [...new Set([`assets/${plain}`, plain, `${folder}assets/${plain}`, `${folder}${plain}`])];
}

function captioned(content: HTMLElement | null, caption: string): HTMLElement {
  const out = document.createElement('figure');
  out.className = 'preview';
  if (content) out.append(content);
  const text = document.createElement('figcaption');
  text.textContent = caption;
  out.append(text);
  return out;
}

async function picture(studio: Studio, path: string): Promise<HTMLElement> {
  const image = document.createElement('img');
  const url = URL.createObjectURL(new Blob([await studio.client.readBytes(path)]));
  image.src = url;
  image.alt = '';
  await image.decode();
  URL.revokeObjectURL(url);
  return captioned(image, `${image.naturalWidth} × ${image.naturalHeight}`);
}

async function model(studio: Studio, path: string): Promise<HTMLElement> {
  const { modelPicture } = await import('../view/model_picture');
  const preview = await studio.client.model(path);
  const [least, most] = [preview.bounds.slice(0, 3), preview.bounds.slice(3, 6)];
  const size = most.map((v, i) => shown(v - least[i]!)).join(' × ');
  return captioned(await modelPicture(studio.client, preview), `${size} m`);
}

export async function previewOf(
  studio: Studio,
  rules: string,
  asset: string,
): Promise<HTMLElement | null> {
  const path = placesOf(rules, asset).find((p) => studio.files.some((f) => f.path === p));
  if (!path) return null;
  try {
    if (PICTURE.test(path)) return await picture(studio, path);
    if (MODEL.test(path)) return await model(studio, path);
  } catch {
    // A file that cannot be read has no picture.
  }
  return null;
}
