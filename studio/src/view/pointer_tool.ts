// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What tools that work on the canvas with the pointer have in common.

type Hears = (event: PointerEvent) => void;

/** Hands the canvas's pointer to a tool, under a cross; gives what takes it back. */
export function takePointer(
  canvas: HTMLCanvasElement,
  onmove: Hears,
  ondown: Hears,
  onup: Hears,
): () => void {
  canvas.addEventListener('pointermove', onmove);
  canvas.addEventListener('pointerdown', ondown);
  canvas.addEventListener('pointerup', onup);
  canvas.style.cursor = 'crosshair';
  return () => {
    canvas.removeEventListener('pointermove', onmove);
    canvas.removeEventListener('pointerdown', ondown);
    canvas.removeEventListener('pointerup', onup);
    canvas.style.cursor = '';
  };
}
