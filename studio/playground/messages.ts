// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the page and the worker with the engine say to each other.

export type ToWorker =
  | { kind: 'ask'; id: number; method: string; path: string; body: string | Blob | null }
  /** The answer is not wanted any more: it is not begun if it has not been. */
  | { kind: 'drop'; id: number }
  | { kind: 'talk' }
  | { kind: 'say'; text: string };

export type FromWorker =
  /** What was asked is at work now, until its answer. */
  | { kind: 'begun'; id: number }
  | {
      kind: 'answer';
      id: number;
      status: number;
      headers: [string, string][];
      body: Uint8Array<ArrayBuffer>;
    }
  | { kind: 'said'; text: string }
  /** The engine could not be started, or broke off: it answers nothing more. */
  | { kind: 'broken'; why: string };
