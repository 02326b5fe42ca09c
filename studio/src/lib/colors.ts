// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One colour for each rule, the same wherever it is named.

/** The number of a rule's colour, 1 to 8. */
export function ruleColor(name: string): number {
  let hash = 7;
  for (let i = 0; i < name.length; ++i) hash = (hash * 31 + name.charCodeAt(i)) >>> 0;
  return (hash % 8) + 1;
}
