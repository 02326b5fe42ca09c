// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

export interface Answer {
  status: number;
  headers: [string, string][];
  body: Uint8Array<ArrayBuffer>;
}

export interface Engine {
  put(path: string, bytes: Uint8Array): void;
  ask(method: string, path: string, query?: [string, string][], body?: Uint8Array): Answer;
  language: {
    begin(): void;
    hear(message: string): void;
    step(): boolean;
    /** Seconds until there is something to do without a message; below 0: never. */
    wait(): number;
    said(): string | null;
  };
}

export function openEngine(
  makeGable: (settings: { wasmBinary: ArrayBuffer | Uint8Array }) => Promise<unknown>,
  wasmBinary: ArrayBuffer | Uint8Array,
  files?: [string, Uint8Array][],
): Promise<Engine>;
