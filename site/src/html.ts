// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

/** Text as it is written within HTML, in attributes as well. */
export const escaped = (text: string): string =>
  text.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
