// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which panels are open and how wide they are: kept in the browser, per window class. The view
// keeps its least width: panels give way to it, and in small windows they lie over it.

import { fitted, LEAST, MOST, windowClass, type Sizes } from './sizes';

type Panel = 'editor' | 'dock' | 'problems';

const DEFAULTS: Record<string, Sizes> = {
  small: { editor: 392, dock: 292 },
  middle: { editor: 468, dock: 332 },
  large: { editor: 560, dock: 372 },
};

export class Layout {
  private width = $state(innerWidth);
  private open = $state({ editor: true, dock: true });
  /** Panels that lie over the view are opened for a while only. */
  private above = $state({ editor: false, dock: false });
  private wished = $state<Sizes>(this.read());
  problems = $state(false);
  readonly over = $derived({ editor: this.width < 900, dock: this.width < 1280 });
  readonly editor = $derived(this.over.editor ? this.above.editor : this.open.editor);
  readonly dock = $derived(this.over.dock ? this.above.dock : this.open.dock);
  /** Widths as they are now. */
  readonly sizes = $derived(
    fitted(this.wished, this.width, {
      editor: this.editor && !this.over.editor,
      dock: this.dock && !this.over.dock,
    }),
  );
  readonly columns = $derived(
    `grid-template-columns: ${this.column('editor')} minmax(0, 1fr) ${this.column('dock')}`,
  );

  constructor() {
    addEventListener('resize', () => this.fit());
  }

  toggle(panel: Panel): void {
    if (panel === 'problems') this.problems = !this.problems;
    else if (this.over[panel]) this.above[panel] = !this.above[panel];
    else this.open[panel] = !this.open[panel];
  }

  /** The view alone, or all panels that have room beside it. */
  alone(): void {
    const open = this.editor || this.dock;
    this.open = { editor: !open, dock: !open };
    this.above = { editor: false, dock: false };
  }

  resize(panel: keyof Sizes, width: number): void {
    const other = panel === 'editor' ? 'dock' : 'editor';
    const beside = this[other] && !this.over[other] ? this.sizes[other] : 0;
    const room = this.over[panel] ? this.width - 40 : this.width - beside - LEAST.view;
    const size = Math.max(LEAST[panel], Math.min(MOST[panel], width, room));
    this.wished = { ...this.wished, [panel]: Math.round(size) };
    localStorage.setItem(`gable.sizes.${windowClass(this.width)}`, JSON.stringify(this.wished));
  }

  reset(panel: keyof Sizes): void {
    this.resize(panel, DEFAULTS[windowClass(this.width)]![panel]);
  }

  private fit(): void {
    const before = windowClass(this.width);
    this.width = innerWidth;
    if (windowClass(this.width) !== before) this.wished = this.read();
  }

  private column(panel: keyof Sizes): string {
    return this[panel] && !this.over[panel] ? `${this.sizes[panel]}px` : '0';
  }

  private read(): Sizes {
    const name = windowClass(innerWidth);
    const fallback = DEFAULTS[name]!;
    try {
      const kept = localStorage.getItem(`gable.sizes.${name}`) ?? '{}';
      return { ...fallback, ...(JSON.parse(kept) as Partial<Sizes>) };
    } catch {
      return fallback;
    }
  }
}
