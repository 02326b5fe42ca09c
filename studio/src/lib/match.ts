// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Finding by a few letters: "flh" finds floorHeight. Letters at the beginning of a word and letters
// that follow each other weigh more.

export interface Match {
  score: number;
  /** Offsets of the letters that were found. */
  letters: number[];
}

const startsWord = (text: string, i: number): boolean =>
  i === 0 ||
  /[^A-Za-z0-9]/.test(text[i - 1]!) ||
  (/[a-z0-9]/.test(text[i - 1]!) && /[A-Z]/.test(text[i]!));

/** How well a query fits a text; null where its letters are not all there, in order. */
export function match(query: string, text: string): Match | null {
  const wanted = query.toLowerCase().replace(/\s+/g, '');
  const lower = text.toLowerCase();
  if (!wanted) return { score: 0, letters: [] };
  const whole = lower.indexOf(query.toLowerCase().trim());
  if (whole >= 0) {
    const letters = [...query.trim()].map((_, i) => whole + i);
    const score =
      100 +
      (startsWord(text, whole) ? 40 : 0) +
      (whole === 0 ? 30 : 0) +
      (lower.length === wanted.length ? 50 : 0);
    return { score: score - text.length / 10, letters };
  }
  const letters: number[] = [];
  let score = 0;
  let at = 0;
  for (const letter of wanted) {
    // The beginning of a word is preferred to the next place in its middle.
    let found = -1;
    for (let i = at; i < lower.length; ++i) {
      if (lower[i] !== letter) continue;
      if (found < 0) found = i;
      if (startsWord(text, i) || i === at) {
        found = i;
        break;
      }
    }
    if (found < 0) return null;
    score += startsWord(text, found) ? 8 : found === at && at > 0 ? 5 : 1;
    letters.push(found);
    at = found + 1;
  }
  return { score: score - text.length / 10, letters };
}

/** Parts of a text, those that were found marked. */
export function parts(text: string, letters: number[]): { text: string; hit: boolean }[] {
  const hits = new Set(letters);
  const out: { text: string; hit: boolean }[] = [];
  for (let i = 0; i < text.length; ++i) {
    const last = out.at(-1);
    if (last && last.hit === hits.has(i)) last.text += text[i];
    else out.push({ text: text[i]!, hit: hits.has(i) });
  }
  return out;
}
