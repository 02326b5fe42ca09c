// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A place as one text: rules with all that they import, shapes, attributes, seed. As a link it is
// compressed; as a file it is JSON. What comes from elsewhere is data: paths and kinds are checked
// here, and again by the server.

import type { ShapesSpec } from './client';
import type { Place } from './place';

export interface Bundle {
  gable: 1;
  name: string;
  main: string;
  place: Place;
  /** The example that it is a copy of: `files` are those that have been changed. */
  example?: string;
  /** Texts by path; those of binary files as "base64:...". */
  files: Record<string, string>;
}

/** Links beyond this are cut by mail programs and chats. */
export const LONGEST_LINK = 30_000;
const LARGEST_BUNDLE = 20_000_000;
const MOST_FILES = 200;
const KINDS =
  /\.(cga|gbbg|grammar|pg3d|park|geojson|json|obj|mtl|gltf|glb|png|jpg|jpeg|csv|txt|md)$/i;

async function through(
  bytes: Uint8Array<ArrayBuffer>,
  stream: { readable: ReadableStream; writable: WritableStream },
): Promise<Uint8Array<ArrayBuffer>> {
  const piped = new Blob([bytes])
    .stream()
    .pipeThrough(stream as ReadableWritablePair<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

export function toBase64(bytes: Uint8Array): string {
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000)
    text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
  return out;
}

/** The part of a link behind "#share=". */
export async function encode(bundle: Bundle): Promise<string> {
  const bytes = await through(
    new TextEncoder().encode(JSON.stringify(bundle)),
    new CompressionStream('deflate'),
  );
  return toBase64(bytes).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

function plain(path: string): boolean {
  return (
    path.length < 300 &&
    KINDS.test(path) &&
    path.split('/').every((part) => /^[^.\\:][^\\:]*$/.test(part))
  );
}

function isShapes(value: unknown): value is ShapesSpec {
  const s = value as { lot?: unknown; file?: unknown; polygon?: unknown };
  const numbers = (v: unknown) =>
    Array.isArray(v) && v.every((n) => typeof n === 'number' && Number.isFinite(n));
  if (numbers(s.lot)) return (s.lot as number[]).length === 2;
  if (Array.isArray(s.polygon))
    return (
      s.polygon.length >= 3 && s.polygon.every((p) => numbers(p) && (p as number[]).length === 2)
    );
  return typeof s.file === 'string';
}

/** A bundle of JSON text; a sentence where it is none. */
export function check(text: string): Bundle | string {
  if (text.length > LARGEST_BUNDLE) return 'This is larger than a shared place can be.';
  let b: Bundle;
  try {
    b = JSON.parse(text) as Bundle;
  } catch {
    return 'This is no shared place of Gable.';
  }
  if (
    b?.gable !== 1 ||
    typeof b.name !== 'string' ||
    typeof b.main !== 'string' ||
    typeof b.files !== 'object' ||
    !b.files
  )
    return 'This is no shared place of Gable.';
  const paths = Object.keys(b.files);
  const example = b.example !== undefined;
  if (example && !/^[\w-]{1,60}$/.test(String(b.example)))
    return 'This shared place names no example.';
  if (paths.length > MOST_FILES || ![...paths, b.main].every(plain))
    return 'This shared place names files that it must not.';
  if (!example && !paths.includes(b.main)) return 'This shared place names files that it must not.';
  if (!Object.values(b.files).every((t) => typeof t === 'string'))
    return 'This is no shared place of Gable.';
  const p = b.place;
  if (
    !p ||
    typeof p.seed !== 'number' ||
    typeof p.start !== 'string' ||
    typeof p.attributes !== 'object' ||
    !isShapes(p.shapes)
  )
    return 'The place in it cannot be read.';
  if (!Object.values(p.attributes).every((v) => typeof v === 'string'))
    return 'The place in it cannot be read.';
  return b;
}

/** A bundle of a link, of what stands behind its "#share=", or of a file's text. */
export async function decode(text: string): Promise<Bundle | string> {
  const trimmed = text.trim();
  if (trimmed.startsWith('{')) return check(trimmed);
  const code = /#share=([\w-]+)/.exec(trimmed)?.[1] ?? /^[\w-]{20,}$/.exec(trimmed)?.[0] ?? '';
  if (!code) return 'This is no link to a shared place: one has #share= in it.';
  try {
    const bytes = await through(
      fromBase64(code.replaceAll('-', '+').replaceAll('_', '/')),
      new DecompressionStream('deflate'),
    );
    if (bytes.length > LARGEST_BUNDLE) return 'This is larger than a shared place can be.';
    return check(new TextDecoder().decode(bytes));
  } catch {
    return 'This link is not complete. Copy all of it.';
  }
}
