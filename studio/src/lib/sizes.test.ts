// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { fitted, LEAST } from './sizes';

const both = { editor: true, dock: true };

it('gives panels what they wish for where there is room', () => {
  expect(fitted({ editor: 468, dock: 332 }, 1600, both)).toEqual({ editor: 468, dock: 332 });
  expect(fitted({ editor: 9000, dock: 1 }, 2400, both)).toEqual({ editor: 900, dock: 260 });
});

it('keeps the least width of the view wherever that can be', () => {
  for (let width = 980; width < 2000; width += 13) {
    for (const wished of [
      { editor: 392, dock: 292 },
      { editor: 900, dock: 520 },
      { editor: 300, dock: 520 },
    ]) {
      const { editor, dock } = fitted(wished, width, both);
      expect(width - editor - dock).toBeGreaterThanOrEqual(LEAST.view);
      expect(editor).toBeGreaterThanOrEqual(LEAST.editor);
      expect(dock).toBeGreaterThanOrEqual(LEAST.dock);
    }
    const { editor } = fitted({ editor: 900, dock: 520 }, width, { editor: true, dock: false });
    expect(width - editor).toBeGreaterThanOrEqual(LEAST.view);
  }
});
