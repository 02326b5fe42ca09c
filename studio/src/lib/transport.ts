// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Transport: how what the page asks gets its answer. From a server (server.ts), or from the engine
// in a worker of the page itself (playground/worker_transport.ts). The page cannot tell which, but
// for `kept`.

import type { Wire } from '../language/connection';

export interface Transport {
  /** Whether files are kept: there is a disk, and a program that draws pictures. */
  readonly kept: boolean;
  /** Called when the page has been handed over to another server. */
  handedOver: (() => void) | null;
  /** A request of docs/dev/studio-protocol.md; `path` stands behind /api/, with its query. */
  send(method: string, path: string, body?: string | Blob, signal?: AbortSignal): Promise<Response>;
  /** A connection to the language server. */
  languageWire(): Wire;
}
