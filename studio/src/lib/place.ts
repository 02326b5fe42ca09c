// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Place: what a model depends on besides the rules.

import type { Standpoint } from '../view/framing';
import type { Example, ShapesSpec } from './client';

/** What makes a place besides the rules. Values are texts as the engine takes them. */
export interface Place {
  start: string;
  /** One that the rules declare; absent: their default. */
  style?: string;
  seed: number;
  attributes: Record<string, string>;
  shapes: ShapesSpec;
  /** Where the usual ones are not enough. */
  limits?: { seconds?: number; shapes?: number };
  /** Seeds of single shapes, which a new seed leaves alone; by index. */
  seeds?: Record<string, number>;
}

export function newPlace(): Place {
  return { start: '', seed: 0, attributes: {}, shapes: { lot: [20, 30] } };
}

/** A word as a shell reads it. */
export function shellWord(text: string): string {
  return /^[\w./:=@%+,-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

/** What `gable generate` and `gable render` take for a place, of what can be said there. */
export function argumentsOf(place: Place): string {
  const { shapes } = place;
  const words: string[] = [];
  if ('file' in shapes) words.push('--shapes', shapes.file);
  else if ('lot' in shapes) words.push('--lot', shapes.lot.join('x'));
  if (place.start) words.push('--start', place.start);
  if (place.style) words.push('--style', place.style);
  if (place.seed) words.push('--seed', String(place.seed));
  for (const [name, value] of Object.entries(place.attributes)) {
    words.push('--set', `${name}=${value}`);
  }
  return words.map(shellWord).join(' ');
}

/** The place of an example that was copied to a folder, as its own arguments have it. */
export function placeOf(example: Pick<Example, 'arguments' | 'shapes'>, folder: string): Place {
  const place = newPlace();
  const words = example.arguments.split(/\s+/);
  const after = (word: string) =>
    words.includes(word) ? words[words.indexOf(word) + 1] : undefined;
  const lot = /^(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)$/.exec(after('--lot') ?? '');
  if (lot) place.shapes = { lot: [Number(lot[1]), Number(lot[2])] };
  place.seed = Number(after('--seed') ?? 0) || 0;
  const file = folder ? `${folder}/buildings.geojson` : 'buildings.geojson';
  if (example.shapes) place.shapes = { file };
  return place;
}

/** The place of rules that nobody has opened before: what lies beside them tells of it. */
export async function placeBeside(
  path: string,
  files: { path: string }[],
  read: (path: string) => Promise<string>,
): Promise<Place> {
  const folder = path.includes('/') ? path.slice(0, path.lastIndexOf('/')) : '';
  const beside = (name: string) => {
    const wanted = folder ? `${folder}/${name}` : name;
    return files.find((f) => f.path === wanted)?.path;
  };
  const told = beside('generate.args');
  const shapes = beside('buildings.geojson') !== undefined;
  if (!told && !shapes) return newPlace();
  const words = told ? await read(told).catch(() => '') : '';
  return placeOf({ arguments: words, shapes }, folder);
}

/** The horizontal angle of view of the page, about, in degrees. */
const ANGLE = 28;
/** Nobody looks at a place from below its ground. */
const LOWEST = 1.6;

/** Where the picture of an example was taken from, for the page's angle of view. */
export function standpointOf(example: Example): Standpoint | null {
  const three = (word: string) => {
    const found = new RegExp(`--${word}[= ](\\S+)`).exec(example.view)?.[1]?.split(',').map(Number);
    return found?.length === 3 && found.every(Number.isFinite) ? found : null;
  };
  const [eye, target] = [three('eye'), three('target')];
  if (!eye || !target) return null;
  const half = (degrees: number) => Math.tan((degrees * Math.PI) / 360);
  const angle = Number(/--fov[= ](\S+)/.exec(example.view)?.[1] ?? ANGLE);
  const away = Math.max(1, half(angle) / half(ANGLE));
  const at = eye.map((v, i) => target[i]! + (v - target[i]!) * away) as [number, number, number];
  at[1] = Math.max(at[1], Math.min(LOWEST, eye[1]!));
  return { position: at, target: target as [number, number, number], ahead: true };
}
