// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The index of the search. It is a script and no data file, since a browser fetches no files of a page
// that it has opened from a disk.

import MiniSearch from 'minisearch';
import { kSearchOptions, type Found } from '../client/search_options';
import type { Section } from './markdown';
import type { Page } from './pages';

/** How much of a section is told with what was found. */
const kExcerpt = 150;

export class SearchText {
  private readonly index = new MiniSearch<Found & { text: string }>(kSearchOptions);
  private count = 0;

  add(page: Page, sections: Section[]): void {
    for (const { title, anchor, text } of sections) {
      const words = text.replace(/\s+/g, ' ').trim();
      this.index.add({
        id: this.count++,
        page: page.title,
        group: page.group,
        title,
        url: page.path + (anchor ? `#${anchor}` : ''),
        excerpt: words.length > kExcerpt ? `${words.slice(0, kExcerpt)}…` : words,
        text: words,
      });
    }
  }

  script(): string {
    return `globalThis.gableSearchIndex=${JSON.stringify(JSON.stringify(this.index))};`;
  }
}
