// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Server: the transport to the program gable on this machine. Its token comes with the address.

import type { Transport } from './transport';

const TOKEN = 'gable.token';

/** The token of the address, which then no longer shows it. */
function tokenGiven(): string {
  const url = new URL(location.href);
  const given = url.searchParams.get('token') ?? '';
  if (!given) return '';
  url.searchParams.delete('token');
  history.replaceState(null, '', url);
  return given;
}

export class Server implements Transport {
  readonly kept = true;
  /** Called when another page of this address has handed over the token of a new server. */
  handedOver: (() => void) | null = null;
  private token: string;
  private readonly channel = new BroadcastChannel('gable.token');

  constructor() {
    this.channel.onmessage = (event: MessageEvent<unknown>) => {
      if (typeof event.data !== 'string' || event.data === this.token) return;
      this.token = event.data;
      sessionStorage.setItem(TOKEN, event.data);
      this.handedOver?.();
    };
    const fresh = tokenGiven();
    this.token = fresh || (sessionStorage.getItem(TOKEN) ?? '');
    if (!fresh) return;
    sessionStorage.setItem(TOKEN, fresh);
    // Pages that were left by a server before go on with this one.
    this.channel.postMessage(fresh);
  }

  send(
    method: string,
    path: string,
    body?: string | Blob,
    signal?: AbortSignal,
  ): Promise<Response> {
    return fetch(`/api/${path}`, {
      method,
      headers: { 'X-Gable-Token': this.token },
      ...(body === undefined ? {} : { body }),
      ...(signal ? { signal } : {}),
    });
  }

  /** The token goes among the protocols: a WebSocket has no headers. */
  languageWire(): WebSocket {
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    return new WebSocket(`${scheme}//${location.host}/api/language`, [
      'gable-language',
      this.token,
    ]);
  }
}
