// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is open on the page. Nothing here is kept.

import type { Mode } from '../view/navigation';
import type { CameraPath } from '../view/camera_path';
import type { Standpoint } from '../view/framing';

export type Tool = 'select' | 'lot' | 'measure';

/** How the view looks at a place. */
export class Look {
  wire = $state(false);
  /** Scopes as boxes: none, that of the selection, or those of all below it, too. */
  scopes = $state<'none' | 'selection' | 'below'>('selection');
  mode = $state<Mode>('orbit');
  sky = $state(false);
  /** Handles of attributes are drawn. */
  handles = $state(true);
  sunOpen = $state(false);
  sun = $state({ elevation: 44, azimuth: -28 });
  /** In place of that, day and hour by the sun; no place is that of the model's map. */
  time = $state({ on: false, day: '2024-06-21', hour: 15, place: '' });
  pathOpen = $state(false);
  path = $state<CameraPath>({ stops: [], speed: 1.4, closed: false });
  /** Where the camera stood when the view was last closed, and over which rules. */
  camera: ({ of: string } & Standpoint) | null = null;
}

export class Ui {
  readonly look = new Look();
  /** What the palette begins with; null while it is closed. */
  palette = $state<string | null>(null);
  share = $state(false);
  exporting = $state(false);
  /** Both sides of a conflict, next to each other. */
  comparing = $state(false);
  /** The rules as a form instead of as text. */
  form = $state(false);
  tool = $state<Tool>('select');
  /** The attribute whose handle is under the pointer or has the focus. */
  attribute = $state('');
  /** The attribute that the wall of variations is over; empty: seeds. */
  vary = $state('');
}

export const ui = new Ui();

/** Presses keys for somebody: "Ctrl Shift Z" on an element. */
export function press(keys: string, target: EventTarget): void {
  const parts = keys.split(' ');
  const last = parts.at(-1) ?? '';
  const shift = parts.includes('Shift');
  const named: Record<string, string> = { Esc: 'Escape', Space: ' ' };
  const key = named[last] ?? (last.length === 1 && !shift ? last.toLowerCase() : last);
  const codes: Record<string, number> = {
    F2: 113,
    F8: 119,
    F12: 123,
    Enter: 13,
    ' ': 32,
    '.': 190,
  };
  target.dispatchEvent(
    new KeyboardEvent('keydown', {
      key,
      keyCode: codes[key] ?? key.toUpperCase().charCodeAt(0),
      ctrlKey: parts.includes('Ctrl'),
      altKey: parts.includes('Alt'),
      shiftKey: shift,
      bubbles: true,
      cancelable: true,
    }),
  );
}
