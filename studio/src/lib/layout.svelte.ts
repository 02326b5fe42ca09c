// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which panels are open and how wide they are: kept in the browser, per window class.

type Panel = 'editor' | 'dock' | 'problems';

interface Sizes {
  editor: number;
  dock: number;
}

const DEFAULTS: Record<string, Sizes> = {
  small: { editor: 392, dock: 292 },
  middle: { editor: 468, dock: 332 },
  large: { editor: 560, dock: 372 },
};

const windowClass = () => (innerWidth < 1440 ? 'small' : innerWidth < 1800 ? 'middle' : 'large');

export class Layout {
  editor = $state(true);
  dock = $state(true);
  problems = $state(false);
  sizes = $state<Sizes>(this.read());
  readonly columns = $derived(
    `grid-template-columns: ${this.editor ? `${this.sizes.editor}px ` : ''}minmax(0, 1fr)${this.dock ? ` ${this.sizes.dock}px` : ''}`,
  );

  private read(): Sizes {
    const fallback = DEFAULTS[windowClass()]!;
    try {
      return {
        ...fallback,
        ...(JSON.parse(
          localStorage.getItem(`gable.sizes.${windowClass()}`) ?? '{}',
        ) as Partial<Sizes>),
      };
    } catch {
      return fallback;
    }
  }

  toggle(panel: Panel): void {
    this[panel] = !this[panel];
  }

  alone(): void {
    const open = this.editor || this.dock;
    this.editor = this.dock = !open;
  }

  resize(panel: keyof Sizes, width: number): void {
    const [least, most] = panel === 'editor' ? [300, 900] : [260, 520];
    const other = panel === 'editor' ? this.sizes.dock : this.sizes.editor;
    this.sizes = {
      ...this.sizes,
      [panel]: Math.round(Math.max(least, Math.min(most, width, innerWidth - other - 420))),
    };
    localStorage.setItem(`gable.sizes.${windowClass()}`, JSON.stringify(this.sizes));
  }

  reset(panel: keyof Sizes): void {
    this.resize(panel, DEFAULTS[windowClass()]![panel]);
  }
}
