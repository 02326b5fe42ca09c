// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// WorkerTransport: the transport to the engine in a worker of this page. Files live in the worker's
// memory; what is to outlast the page goes into its address (address.ts).
//
// Nothing interrupts the engine. So where it is long at what nobody waits for any more, or breaks
// off, its worker is ended, and a new one gets the same files.

import type { Wire } from '../src/language/connection';
import type { Transport } from '../src/lib/transport';
import type { FromWorker, ToWorker } from './messages';

type Ask = Extract<ToWorker, { kind: 'ask' }>;

interface Waiting {
  ask: Ask;
  resolve: (answer: Response) => void;
  reject: (error: Error) => void;
}

/** Statuses whose answers have no body. */
const EMPTY = [204, 304];
/** What makes or changes files of the project. */
const MAKES = /^(PUT file|POST files|POST example-copy|POST asset)\b/;
/** A worker that is longer than this at what is not wanted any more is ended. */
const PATIENCE_MS = 2000;
/** An engine that breaks off so often with nothing asked of it does so always. */
const MOST_BREAKS = 3;

const refusal = (code: string, message: string) =>
  new Response(JSON.stringify({ code, message }), { status: 500 });

export class WorkerTransport implements Transport {
  readonly kept = false;
  handedOver: (() => void) | null = null;
  private last = 0;
  private readonly waiting = new Map<number, Waiting>();
  /** What has made the files that there are. */
  private readonly made: Ask[] = [];
  private atWork: { id: number; began: number } | null = null;
  private worker: Worker;
  private wire: Wire | null = null;
  private breaks = 0;
  private broken = '';

  constructor(private readonly makeWorker: () => Worker = newWorker) {
    this.worker = this.begin();
  }

  send(
    method: string,
    path: string,
    body?: string | Blob,
    signal?: AbortSignal,
  ): Promise<Response> {
    if (this.broken) return Promise.reject(new Error(this.broken));
    if (signal?.aborted) return Promise.reject(new DOMException('dropped', 'AbortError'));
    const ask: Ask = { kind: 'ask', id: ++this.last, method, path, body: body ?? null };
    return new Promise((resolve, reject) => {
      this.waiting.set(ask.id, { ask, resolve, reject });
      signal?.addEventListener('abort', () => {
        if (!this.waiting.delete(ask.id)) return;
        this.drop(ask.id);
        reject(new DOMException('dropped', 'AbortError'));
      });
      this.post(ask);
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

  private begin(): Worker {
    const worker = this.makeWorker();
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      if (worker === this.worker) this.take(data);
    };
    worker.onerror = (event) => this.break(event.message || 'it could not be loaded');
    return worker;
  }

  private drop(id: number): void {
    const { atWork } = this;
    if (atWork?.id !== id) return this.post({ kind: 'drop', id });
    setTimeout(
      () => {
        if (this.atWork === atWork) this.beginAgain();
      },
      Math.max(0, PATIENCE_MS - (performance.now() - atWork.began)),
    );
  }

  private beginAgain(): void {
    this.worker.terminate();
    this.atWork = null;
    this.worker = this.begin();
    for (const ask of this.made) this.post(ask);
    for (const { ask } of this.waiting.values()) this.post(ask);
    // The language server is looked for again by who hears of its end.
    this.wire?.onclose?.(new CloseEvent('close'));
  }

  private take(message: FromWorker): void {
    switch (message.kind) {
      case 'broken':
        return this.break(message.why);
      case 'said':
        this.wire?.onmessage?.(new MessageEvent('message', { data: message.text }));
        return;
      case 'begun':
        this.atWork = { id: message.id, began: performance.now() };
        return;
      case 'answer':
        this.atWork = null;
        this.answered(message);
    }
  }

  private answered({ id, status, headers, body }: Extract<FromWorker, { kind: 'answer' }>): void {
    const waiting = this.waiting.get(id);
    if (!waiting) return;
    this.waiting.delete(id);
    const { ask, resolve } = waiting;
    if (status < 300 && MAKES.test(`${ask.method} ${ask.path}`)) this.made.push(ask);
    resolve(new Response(EMPTY.includes(status) ? null : body, { status, headers }));
  }

  /** What was at work is refused, and all else goes on. */
  private break(why: string): void {
    const id = this.atWork?.id ?? 0;
    const culprit = this.waiting.get(id);
    if (!this.atWork && ++this.breaks >= MOST_BREAKS) return this.giveUp(why);
    this.waiting.delete(id);
    this.beginAgain();
    culprit?.resolve(
      refusal('engine-broke', `the engine broke off (${why}): give it less to do at a time`),
    );
  }

  private giveUp(why: string): void {
    this.broken = `The engine does not work in this browser: ${why}. Load the page again.`;
    for (const { reject } of this.waiting.values()) reject(new Error(this.broken));
    this.waiting.clear();
    this.wire?.onclose?.(new CloseEvent('close'));
  }
}

function newWorker(): Worker {
  return new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
}
