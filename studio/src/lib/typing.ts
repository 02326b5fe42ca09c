// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

const TEXT = [
  'input:not([type=checkbox], [type=radio], [type=range], [type=button], [type=file])',
  'textarea',
  'select',
  '.cm-content',
].join(', ');

/** Whether keys pressed there write something, so that single keys are no commands. */
export function isTyping(target: EventTarget | null): boolean {
  return target instanceof Element && !!target.closest(TEXT);
}
