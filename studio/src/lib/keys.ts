// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The keys that the page shows under `?`.

export const KEYS: [string, string][] = [
  ['Ctrl S', 'save the file'],
  ['Ctrl Z', 'undo; outside of the text: the last value'],
  ['Ctrl Shift Z', 'redo'],
  ['Ctrl B', 'editor'],
  ['Ctrl I', 'shapes and inspector'],
  ['Ctrl J', 'problems'],
  ['Ctrl \\', 'view alone'],
  ['F8', 'next problem'],
  ['F12', 'go to the rule'],
  ['Ctrl Enter', 'select the shapes of the rule'],
  ['Shift Alt F', 'format'],
  ['Ctrl Space', 'complete'],
  ['R', 'new seed'],
  ['F', 'frame the selection'],
  ['Shift F', 'frame all'],
  ['W', 'wireframe'],
  ['S', 'scopes: none, of the selection, of all below'],
  ['1 2 3', 'orbit, fly, walk at eye height'],
  ['W A S D', 'fly and walk; Q E down and up'],
  ['G', 'derivation guide'],
  ['Space', 'guide: play, pause'],
  [', .', 'guide: a step back, on'],
  ['Shift .', 'guide: next stop'],
  ['Esc', 'the shape above; stop deriving'],
  ['Alt 1', 'rules'],
  ['Alt 4', 'gallery'],
  ['Alt N', 'new rules'],
  ['?', 'this list'],
];
