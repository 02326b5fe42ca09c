// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Gesture: what somebody does between pressing and letting go. All changes that it makes are one
// step of the history, however long it takes, and giving it up takes them all back.

export class Gesture {
  private count = 0;
  private running = false;
  /** Takes back what the gesture of that number has changed; false where it changed nothing. */
  takeBack: ((gesture: number) => boolean) | null = null;

  /** The number of the gesture under way; 0 for none. */
  get active(): number {
    return this.running ? this.count : 0;
  }

  begin(): void {
    ++this.count;
    this.running = true;
  }

  end(): void {
    this.running = false;
  }

  /** Gives the gesture up; false where nothing could be taken back. */
  cancel(): boolean {
    const taken = this.running && !!this.takeBack?.(this.count);
    this.running = false;
    return taken;
  }
}

/** There is one pointer. */
export const gesture = new Gesture();
