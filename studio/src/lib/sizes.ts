// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Widths of the panels beside the view, in CSS pixels.

export interface Sizes {
  editor: number;
  dock: number;
}

export const LEAST = { editor: 300, dock: 260, view: 420 };
export const MOST: Sizes = { editor: 900, dock: 520 };

export type WindowClass = 'small' | 'middle' | 'large';

export const windowClass = (width: number): WindowClass =>
  width < 1440 ? 'small' : width < 1800 ? 'middle' : 'large';

/** The widths that are wished for, less what the view needs: wider panels give more. */
export function fitted(
  wished: Sizes,
  width: number,
  beside: { editor: boolean; dock: boolean },
): Sizes {
  const clamp = (panel: keyof Sizes) =>
    Math.max(LEAST[panel], Math.min(MOST[panel], wished[panel]));
  const sizes = { editor: clamp('editor'), dock: clamp('dock') };
  const used = (beside.editor ? sizes.editor : 0) + (beside.dock ? sizes.dock : 0);
  let lacking = used + LEAST.view - width;
  const spare = {
    editor: beside.editor ? sizes.editor - LEAST.editor : 0,
    dock: beside.dock ? sizes.dock - LEAST.dock : 0,
  };
  const all = spare.editor + spare.dock;
  if (lacking <= 0 || all <= 0) return sizes;
  lacking = Math.min(lacking, all);
  const fromEditor = Math.ceil((lacking * spare.editor) / all);
  return {
    editor: sizes.editor - fromEditor,
    dock: sizes.dock - Math.max(0, lacking - fromEditor),
  };
}
