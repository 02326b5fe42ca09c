// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Links into the playground, where it is part of the site: an example by its name, rules of a page as a
// shared place, in the form of studio/src/lib/share.ts.

import { deflateSync } from 'node:zlib';

/** The folder of the playground within the site. */
export const PLAYGROUND = 'playground/index.html';

/** Rules that make something of a lot: there is a rule, and nothing is read from elsewhere. */
function isWhole(rules: string): boolean {
  return (
    /^\s*[A-Za-z]\w*\s*(\([^)]*\))?\s*-->/m.test(rules) && !/^\s*import\s|^version\b/m.test(rules)
  );
}

/** The part of an address that opens rules; nothing where they are no whole ones. */
export function fragmentOf(title: string, rules: string): string | undefined {
  if (!isWhole(rules)) return undefined;
  const name = title.replace(/[^\w-]+/g, '-').replace(/^-+|-+$/g, '') || 'rules';
  const main = `${name}.cga`;
  const place = { start: '', seed: 0, attributes: {}, shapes: { lot: [20, 30] } };
  const bundle = { gable: 1, name, main, place, files: { [main]: rules } };
  return `#share=${deflateSync(JSON.stringify(bundle), { level: 9 }).toString('base64url')}`;
}

/** The example that a page is about. */
export function exampleOf(source: string): string | undefined {
  return /^examples\/([^/]+)\/README\.md$/.exec(source)?.[1];
}
