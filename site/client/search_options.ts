// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the index and those who search it must agree on.

/** A section that was found. */
export interface Found {
  id: number;
  page: string;
  group: string;
  title: string;
  url: string;
  excerpt: string;
}

/** `roofHip` is found as written, and by each of its words. */
function words(text: string): string[] {
  const whole = text.split(/[^\p{L}\p{N}_]+/u).filter((word) => word !== '');
  const parts = whole.flatMap((word) => word.split(/(?<=[a-z])(?=[A-Z])|_/));
  return [...new Set([...whole, ...parts])];
}

/** Words that nobody means when they search. */
const kUnsaid = new Set(
  'a an and do for from how i in into is my of on or the to what with'.split(' '),
);

export const kSearchOptions = {
  fields: ['title', 'page', 'text'],
  storeFields: ['page', 'group', 'title', 'url', 'excerpt'],
  tokenize: words,
  processTerm: (term: string) => (kUnsaid.has(term.toLowerCase()) ? null : term.toLowerCase()),
  searchOptions: {
    prefix: true,
    fuzzy: 0.15,
    boost: { title: 4, page: 3 },
    weights: { prefix: 0.3, fuzzy: 0.15 },
    // The page of a thing comes before those that mention it, and how it is used before how it is made.
    boostDocument: (_: unknown, term: string, found?: Record<string, unknown>) =>
      (String(found?.['title']).toLowerCase() === term.toLowerCase() ? 6 : 1) *
      (/^(Design|Developing|Examples)$/.test(String(found?.['group'])) ? 0.4 : 1),
  },
};
