// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Keys that the editor, the view or a page take themselves. All others stand in commands.ts; the
// list under `?` shows both.

export const KEYS: [string, string][] = [
  ['F8', 'next problem'],
  ['Shift F8', 'previous problem'],
  ['F12', 'go to where a name is defined'],
  ['Shift F12', 'where a name is used'],
  ['F2', 'rename'],
  ['F9', 'guide: stop at the rule of this line'],
  ['Ctrl .', 'mend what is marked on this line'],
  ['Ctrl Enter', 'select the shapes of the rule'],
  ['Ctrl Space', 'complete'],
  ['Ctrl /', 'comment'],
  ['F', 'frame the selection'],
  ['Shift F', 'frame all'],
  ['W', 'wireframe'],
  ['S', 'scopes: none, of the selection, of all below'],
  ['H', 'handles of attributes'],
  ['1 2 3', 'orbit, fly, walk at eye height'],
  ['W A S D', 'fly and walk; Q E down and up'],
  ['G', 'derivation guide'],
  ['Space', 'guide: play, pause'],
  [', .', 'guide: a step back, on'],
  ['Shift .', 'guide: next stop'],
  ['Esc', 'the shape above; stop deriving'],
];

/** Those of the text, which the palette sends there. */
export const EDITOR_KEYS = new Set([
  'F8',
  'Shift F8',
  'F12',
  'Shift F12',
  'F2',
  'F9',
  'Ctrl .',
  'Ctrl Enter',
  'Ctrl Space',
  'Ctrl /',
]);
