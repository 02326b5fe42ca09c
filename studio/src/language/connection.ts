// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Requests and notifications of JSON-RPC over a socket. What was asked of a connection that ends is
// refused.

/** What is used of a WebSocket. */
export interface Wire {
  send(text: string): void;
  close(): void;
  onopen: ((event: Event) => void) | null;
  onmessage: ((event: MessageEvent<unknown>) => void) | null;
  onclose: ((event: CloseEvent) => void) | null;
}

interface Waiting {
  resolve: (result: unknown) => void;
  reject: (error: Error) => void;
}

interface Incoming {
  id?: number;
  method?: string;
  params?: unknown;
  result?: unknown;
  error?: { code: number; message: string };
}

/** There is no server now. */
export class Away extends Error {}
/** What was asked is not wanted any more. */
export class Cancelled extends Error {}

const CANCELLED = -32800;

export class Connection {
  /** Called with what the server says by itself. */
  onnotification: (method: string, params: unknown) => void = () => undefined;
  onend: () => void = () => undefined;
  open = false;
  /** How many requests and notifications were sent, for the journeys that count them. */
  sent = 0;
  private last = 0;
  private readonly waiting = new Map<number, Waiting>();

  constructor(
    private readonly wire: Wire,
    onopen: () => void,
  ) {
    wire.onopen = () => {
      this.open = true;
      onopen();
    };
    wire.onmessage = ({ data }) => this.take(String(data));
    wire.onclose = () => this.end();
  }

  notify(method: string, params: unknown): void {
    if (this.open) this.send({ method, params });
  }

  request<T>(method: string, params: unknown, signal?: AbortSignal): Promise<T> {
    if (!this.open) return Promise.reject(new Away('there is no server'));
    if (signal?.aborted) return Promise.reject(new Cancelled(method));
    const id = ++this.last;
    return new Promise<unknown>((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      signal?.addEventListener('abort', () => {
        if (!this.waiting.delete(id)) return;
        this.notify('$/cancelRequest', { id });
        reject(new Cancelled(method));
      });
      this.send({ id, method, params });
    }) as Promise<T>;
  }

  close(): void {
    this.wire.close();
    this.end();
  }

  private send(message: object): void {
    ++this.sent;
    this.wire.send(JSON.stringify({ jsonrpc: '2.0', ...message }));
  }

  private take(text: string): void {
    const message = JSON.parse(text) as Incoming;
    if (message.method !== undefined) {
      if (message.id === undefined) this.onnotification(message.method, message.params);
      return;
    }
    const waiting = this.waiting.get(message.id ?? -1);
    if (!waiting) return;
    this.waiting.delete(message.id!);
    const { error } = message;
    if (!error) waiting.resolve(message.result);
    else if (error.code === CANCELLED) waiting.reject(new Cancelled(error.message));
    else waiting.reject(new Error(error.message));
  }

  private end(): void {
    if (this.wire.onclose === null) return;
    this.wire.onclose = this.wire.onmessage = this.wire.onopen = null;
    this.open = false;
    for (const each of this.waiting.values()) each.reject(new Away('the server has gone'));
    this.waiting.clear();
    this.onend();
  }
}
