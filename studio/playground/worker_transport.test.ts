// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type { FromWorker, ToWorker } from './messages';
import { WorkerTransport } from './worker_transport';

/** A worker that answers when it is told to. */
class Played {
  readonly heard: ToWorker[] = [];
  ended = false;
  onmessage: ((event: { data: FromWorker }) => void) | null = null;
  onerror: ((event: { message: string }) => void) | null = null;
  postMessage(message: ToWorker): void {
    this.heard.push(message);
  }
  terminate(): void {
    this.ended = true;
  }
  say(data: FromWorker): void {
    this.onmessage?.({ data });
  }
  asked(): string[] {
    return this.heard.flatMap((m) => (m.kind === 'ask' ? [`${m.id} ${m.method} ${m.path}`] : []));
  }
}

const answer = (id: number, text = '{}'): FromWorker => ({
  kind: 'answer',
  id,
  status: 200,
  headers: [],
  body: new TextEncoder().encode(text),
});

let workers: Played[];
let transport: WorkerTransport;

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal('CloseEvent', class extends Event {});
  workers = [];
  transport = new WorkerTransport(() => {
    workers.push(new Played());
    return workers.at(-1) as unknown as Worker;
  });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it('ends a worker that is long at what is not wanted, and gives the next one the files', async () => {
  const made = transport.send('POST', 'example-copy?name=town');
  workers[0]!.say({ kind: 'begun', id: 1 });
  workers[0]!.say(answer(1));
  await made;
  const abort = new AbortController();
  const gone = transport.send('POST', 'derive', '{}', abort.signal);
  const next = transport.send('POST', 'derive', '{"seed":1}');
  workers[0]!.say({ kind: 'begun', id: 2 });
  abort.abort();
  await expect(gone).rejects.toThrow('dropped');
  expect(workers).toHaveLength(1);
  vi.advanceTimersByTime(2100);
  expect(workers).toHaveLength(2);
  expect(workers[0]!.ended).toBe(true);
  expect(workers[1]!.asked()).toEqual(['1 POST example-copy?name=town', '3 POST derive']);
  workers[1]!.say(answer(1));
  workers[1]!.say(answer(3, 'made'));
  expect(await (await next).text()).toBe('made');
});

it('keeps a worker that comes to its end in time', async () => {
  const abort = new AbortController();
  const gone = transport.send('POST', 'derive', '{}', abort.signal);
  workers[0]!.say({ kind: 'begun', id: 1 });
  abort.abort();
  await expect(gone).rejects.toThrow('dropped');
  workers[0]!.say(answer(1));
  vi.advanceTimersByTime(10_000);
  expect(workers).toHaveLength(1);
});

it('leaves out what has not begun', async () => {
  const abort = new AbortController();
  const gone = transport.send('POST', 'derive', '{}', abort.signal);
  abort.abort();
  await expect(gone).rejects.toThrow('dropped');
  expect(workers[0]!.heard.at(-1)).toEqual({ kind: 'drop', id: 1 });
});

it('refuses what an engine broke off at, and answers the rest with a new one', async () => {
  const wire = transport.languageWire();
  const ended = vi.fn();
  wire.onclose = ended;
  const fatal = transport.send('POST', 'derive');
  const rest = transport.send('GET', 'project');
  workers[0]!.say({ kind: 'begun', id: 1 });
  workers[0]!.say({ kind: 'broken', why: 'unreachable' });
  const told = await fatal;
  expect(told.status).toBe(500);
  expect(await told.json()).toMatchObject({ code: 'engine-broke' });
  expect(workers[1]!.asked()).toEqual(['2 GET project']);
  workers[1]!.say(answer(2));
  expect((await rest).ok).toBe(true);
  expect(ended).toHaveBeenCalledOnce();
});

it('gives up an engine that never starts', async () => {
  const asked = transport.send('GET', 'project');
  for (let i = 0; i < 3; ++i) workers.at(-1)!.say({ kind: 'broken', why: 'no WebAssembly' });
  await expect(asked).rejects.toThrow('no WebAssembly');
  expect(workers).toHaveLength(3);
  await expect(transport.send('GET', 'project')).rejects.toThrow('does not work in this browser');
});
