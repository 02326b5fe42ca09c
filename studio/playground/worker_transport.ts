// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// WorkerTransport: the transport to the engine in a worker of this page. Files live in the worker's
// memory; what is to outlast the page goes into its address (address.ts).

import type { Wire } from '../src/language/connection';
import type { Transport } from '../src/lib/transport';
import type { FromWorker, ToWorker } from './messages';

interface Waiting {
  resolve: (answer: Response) => void;
  reject: (error: Error) => void;
}

/** Statuses whose answers have no body. */
const EMPTY = [204, 304];

export class WorkerTransport implements Transport {
  readonly kept = false;
  handedOver: (() => void) | null = null;
  private last = 0;
  private readonly waiting = new Map<number, Waiting>();
  private readonly worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
  private wire: Wire | null = null;
  private broken = '';

  constructor() {
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.take(data);
    this.worker.onerror = (event) => this.break(event.message || 'the engine could not be loaded');
  }

  send(
    method: string,
    path: string,
    body?: string | Blob,
    signal?: AbortSignal,
  ): Promise<Response> {
    if (this.broken) return Promise.reject(new Error(this.broken));
    if (signal?.aborted) return Promise.reject(new DOMException('dropped', 'AbortError'));
    const id = ++this.last;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      signal?.addEventListener('abort', () => {
        if (!this.waiting.delete(id)) return;
        this.post({ kind: 'drop', id });
        reject(new DOMException('dropped', 'AbortError'));
      });
      this.post({ kind: 'ask', id, method, path, body: body ?? null });
    });
  }

  languageWire(): Wire {
    const wire: Wire = {
      send: (text) => this.post({ kind: 'say', text }),
      close: () => undefined,
      onopen: null,
      onmessage: null,
      onclose: null,
    };
    this.wire = wire;
    this.post({ kind: 'talk' });
    // Whoever asked for the wire sets its handlers first.
    queueMicrotask(() => wire.onopen?.(new Event('open')));
    return wire;
  }

  private post(message: ToWorker): void {
    this.worker.postMessage(message);
  }

  private take(message: FromWorker): void {
    if (message.kind === 'broken') return this.break(message.why);
    if (message.kind === 'said') {
      this.wire?.onmessage?.(new MessageEvent('message', { data: message.text }));
      return;
    }
    const waiting = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    const { status, headers, body } = message;
    waiting?.resolve(new Response(EMPTY.includes(status) ? null : body, { status, headers }));
  }

  private break(why: string): void {
    this.broken = `The engine broke off: ${why}. Load the page again.`;
    for (const { reject } of this.waiting.values()) reject(new Error(this.broken));
    this.waiting.clear();
    this.wire?.onclose?.(new CloseEvent('close'));
  }
}
