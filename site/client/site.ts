// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What pages do: the theme, the menu on narrow screens, the search, and models that load when they are
// asked for. Without scripts the pages are read as they are.

import MiniSearch from 'minisearch';
import { kSearchOptions, type Found } from './search_options';

declare global {
  var gableSearchIndex: string | undefined;
}

const kMostFound = 12;
const script = document.currentScript as HTMLScriptElement;
/** The address of the site's first page, which addresses in the index are relative to. */
const home = new URL(script.dataset['home']!, document.baseURI);

function loadScript(address: string): Promise<void> {
  return new Promise((done, failed) => {
    const element = document.createElement('script');
    element.src = address;
    element.onload = () => done();
    element.onerror = () => failed(new Error(`${address} could not be loaded`));
    document.head.append(element);
  });
}

function themeButton(): void {
  const root = document.documentElement;
  document.querySelector('.theme-button')!.addEventListener('click', () => {
    root.dataset['theme'] = root.dataset['theme'] === 'dark' ? 'light' : 'dark';
    try {
      localStorage.setItem('gable-theme', root.dataset['theme']);
    } catch {
      // Where nothing may be kept, the theme holds for this page.
    }
  });
}

function menuButton(): void {
  const button = document.querySelector<HTMLButtonElement>('.menu-button')!;
  const menu = document.getElementById('menu')!;
  button.addEventListener('click', () => {
    const open = menu.classList.toggle('open');
    button.setAttribute('aria-expanded', String(open));
  });
  // The page that is open is seen in a long menu, which moves by itself.
  const current = menu.querySelector<HTMLElement>('[aria-current]');
  if (current) menu.scrollTop = current.offsetTop - menu.clientHeight / 2;
}

class Search {
  private readonly field = document.getElementById('search') as HTMLInputElement;
  private readonly list = document.getElementById('found') as HTMLUListElement;
  private index: Promise<MiniSearch<Found>> | undefined;
  private chosen = -1;

  constructor() {
    this.field.addEventListener('focus', () => void this.load());
    this.field.addEventListener('input', () => void this.show());
    this.field.addEventListener('keydown', (event) => this.key(event));
    document.addEventListener('click', (event) => {
      if (!(event.target as Element).closest('.search')) this.close();
    });
    document.addEventListener('keydown', (event) => {
      const writing = (event.target as Element).matches('input, textarea, select');
      if (event.key !== '/' || writing || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      this.field.focus();
    });
  }

  /** The index is read once, when somebody begins to search. */
  private load(): Promise<MiniSearch<Found>> {
    this.index ??= loadScript(script.dataset['index']!).then(() =>
      MiniSearch.loadJSON<Found>(globalThis.gableSearchIndex ?? '', kSearchOptions),
    );
    return this.index;
  }

  private async show(): Promise<void> {
    const query = this.field.value.trim();
    if (!query) return this.close();
    const index = await this.load();
    // Typing went on while the index was read.
    if (query !== this.field.value.trim()) return;
    // Sections that have all words first, then those that have some.
    const all = index.search(query, { combineWith: 'AND' });
    const found = [...all, ...index.search(query)] as unknown as Found[];
    // One section of a page, the best: so more pages are seen.
    const pages = new Map<string, Found>();
    for (const each of found) {
      const page = each.url.replace(/#.*/, '');
      if (!pages.has(page)) pages.set(page, each);
    }
    this.fill([...pages.values()].slice(0, kMostFound));
  }

  private fill(found: Found[]): void {
    this.chosen = -1;
    this.list.replaceChildren(...found.map((each, at) => this.row(each, at)));
    if (!found.length) {
      const nothing = document.createElement('li');
      nothing.className = 'nothing';
      nothing.textContent = 'Nothing found';
      this.list.append(nothing);
    }
    this.list.hidden = false;
    this.field.setAttribute('aria-expanded', 'true');
    this.field.removeAttribute('aria-activedescendant');
  }

  private row(found: Found, at: number): HTMLLIElement {
    const row = document.createElement('li');
    row.id = `found-${at}`;
    row.setAttribute('role', 'option');
    const link = document.createElement('a');
    link.href = new URL(found.url, home).href;
    link.tabIndex = -1;
    const part = (className: string, text: string) => {
      const element = document.createElement('span');
      element.className = className;
      element.textContent = text;
      link.append(element);
    };
    part('title', found.title);
    part('where', found.title === found.page ? found.group : `${found.page}, ${found.group}`);
    part('excerpt', found.excerpt);
    row.append(link);
    return row;
  }

  private choose(at: number): void {
    const rows = [...this.list.querySelectorAll('[role=option]')];
    if (!rows.length) return;
    this.chosen = (at + rows.length) % rows.length;
    rows.forEach((row, each) => row.setAttribute('aria-selected', String(each === this.chosen)));
    rows[this.chosen]!.scrollIntoView({ block: 'nearest' });
    this.field.setAttribute('aria-activedescendant', rows[this.chosen]!.id);
  }

  private key(event: KeyboardEvent): void {
    if (event.key === 'ArrowDown') this.choose(this.chosen + 1);
    else if (event.key === 'ArrowUp') this.choose(this.chosen < 0 ? -1 : this.chosen - 1);
    else if (event.key === 'Escape') this.close();
    else if (event.key === 'Enter') {
      const links = this.list.querySelectorAll<HTMLAnchorElement>('[role=option] a');
      links[Math.max(this.chosen, 0)]?.click();
      this.close();
    } else return;
    event.preventDefault();
  }

  private close(): void {
    this.list.hidden = true;
    this.field.setAttribute('aria-expanded', 'false');
  }
}

function models(): void {
  for (const figure of document.querySelectorAll<HTMLElement>('.turn')) {
    const button = figure.querySelector('button')!;
    button.addEventListener('click', async () => {
      button.disabled = true;
      try {
        await loadScript(figure.dataset['script']!);
        await globalThis.gableTurn!(figure, figure.dataset['model']!);
        button.remove();
      } catch {
        button.textContent =
          'The model could not be loaded; pages opened from a disk cannot do so.';
      }
    });
  }
}

themeButton();
menuButton();
new Search();
models();
