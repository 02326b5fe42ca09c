// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

/** Gives a file to the person at the page, who finds it among the downloads. */
export function saveAs(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
