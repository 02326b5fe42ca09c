// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One history for all that a person changes: text, attributes, seed, shapes, in order of time. A
// drag and a burst of typing are one step each. It survives a reload as JSON.

/** At an offset one text stands for another. */
export interface TextChange {
  path: string;
  at: number;
  removed: string;
  inserted: string;
}

/** A place of a rule file before and after, as JSON. */
export interface PlaceChange {
  main: string;
  before: string;
  after: string;
}

export interface Step {
  label: string;
  texts: TextChange[];
  place: PlaceChange | null;
}

interface Kept extends Step {
  /** Steps with the same key that follow each other soon are one. */
  group: string;
  time: number;
  /** The gesture that made it, where it was one. */
  gesture?: number;
}

const GROUP_MS = 500;
const MOST_STEPS = 500;
const MOST_KEPT_BYTES = 300_000;

/** The one change that makes `after` of `before`; null when they are equal. */
export function difference(path: string, before: string, after: string): TextChange | null {
  if (before === after) return null;
  const most = Math.min(before.length, after.length);
  let head = 0;
  while (head < most && before[head] === after[head]) ++head;
  let tail = 0;
  while (tail < most - head && before[before.length - 1 - tail] === after[after.length - 1 - tail])
    ++tail;
  return {
    path,
    at: head,
    removed: before.slice(head, before.length - tail),
    inserted: after.slice(head, after.length - tail),
  };
}

/** The text after a change, or null where the text is not the one that was changed. */
export function applied(text: string, change: TextChange): string | null {
  if (text.slice(change.at, change.at + change.removed.length) !== change.removed) return null;
  return text.slice(0, change.at) + change.inserted + text.slice(change.at + change.removed.length);
}

export const inverse = (c: TextChange): TextChange => ({
  ...c,
  removed: c.inserted,
  inserted: c.removed,
});

/** Two changes that follow each other as one, where they touch. */
function joined(first: TextChange, next: TextChange): TextChange | null {
  if (first.path !== next.path) return null;
  const end = first.at + first.inserted.length;
  if (next.removed === '' && next.at === end)
    return { ...first, inserted: first.inserted + next.inserted };
  if (next.inserted === '' && next.at + next.removed.length === end) {
    const left = first.inserted.length - next.removed.length;
    if (left >= 0) return { ...first, inserted: first.inserted.slice(0, left) };
    return {
      ...first,
      at: next.at,
      removed: next.removed.slice(0, -left) + first.removed,
      inserted: '',
    };
  }
  return null;
}

const changesNothing = (step: Step) =>
  !step.texts.length && !!step.place && step.place.before === step.place.after;

export class History {
  private done: Kept[] = [];
  private undone: Kept[] = [];

  constructor(private readonly now: () => number = Date.now) {}

  get undoLabel(): string {
    return this.done.at(-1)?.label ?? '';
  }
  get redoLabel(): string {
    return this.undone.at(-1)?.label ?? '';
  }
  get undoSteps(): number {
    return this.done.length;
  }
  get redoSteps(): number {
    return this.undone.length;
  }

  /**
   * Adds a step, or makes the last one longer when both are of one group and close in time. Steps
   * of one gesture are one however much time lies between them.
   */
  record(step: Step, group: string, gesture = 0): void {
    if (!step.texts.length && !step.place) return;
    this.undone = [];
    const last = this.done.at(-1);
    const time = this.now();
    const ofOne = last && group && last.group === group && (last.gesture ?? 0) === gesture;
    if (ofOne && (gesture > 0 || time - last.time < GROUP_MS)) {
      for (const change of step.texts) {
        const both = last.texts.length ? joined(last.texts.at(-1)!, change) : null;
        if (both) last.texts[last.texts.length - 1] = both;
        else last.texts.push(change);
      }
      if (step.place)
        last.place = { ...step.place, before: last.place?.before ?? step.place.before };
      last.time = time;
      if (changesNothing(last)) this.done.pop();
      return;
    }
    const held = gesture ? { gesture } : {};
    this.done.push({ ...step, texts: [...step.texts], group, time, ...held });
    if (this.done.length > MOST_STEPS) this.done.shift();
  }

  /** What takes a gesture back that was given up; null where it changed nothing. */
  takeBack(gesture: number): Step | null {
    if (!gesture || this.done.at(-1)?.gesture !== gesture) return null;
    const step = this.undo();
    this.undone.pop();
    return step;
  }

  /** The next edit begins a step of its own. */
  close(): void {
    const last = this.done.at(-1);
    if (last) last.group = '';
  }

  /** What takes the last step back, changes in the order in which they are to be applied. */
  undo(): Step | null {
    const step = this.done.pop();
    if (!step) return null;
    step.group = '';
    this.undone.push(step);
    const place = step.place && {
      ...step.place,
      before: step.place.after,
      after: step.place.before,
    };
    return { label: step.label, texts: [...step.texts].reverse().map(inverse), place };
  }

  redo(): Step | null {
    const step = this.undone.pop();
    if (!step) return null;
    this.done.push(step);
    return { label: step.label, texts: [...step.texts], place: step.place };
  }

  /** The latest steps, as far as they have room. */
  keep(): string {
    let bytes = 0;
    let first = this.done.length;
    while (first > 0 && bytes < MOST_KEPT_BYTES) bytes += JSON.stringify(this.done[--first]).length;
    return JSON.stringify({
      done: this.done.slice(bytes < MOST_KEPT_BYTES ? first : first + 1),
      undone: this.undone.slice(-50),
    });
  }

  /** Takes what `keep` gave; text that is none of its own leaves the history empty. */
  recall(text: string): void {
    try {
      const kept = JSON.parse(text) as { done: Kept[]; undone: Kept[] };
      const valid = (s: Kept) => typeof s.label === 'string' && Array.isArray(s.texts);
      if (!kept.done.every(valid) || !kept.undone.every(valid)) return;
      // Gestures are counted anew.
      this.done = kept.done.map((s) => ({ ...s, group: '', gesture: 0 }));
      this.undone = kept.undone;
    } catch {
      // A history that cannot be read is none.
    }
  }
}
