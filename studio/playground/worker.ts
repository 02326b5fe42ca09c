// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The worker that has the engine. Requests are answered one after the other; between two of them it
// hears whether later ones are still wanted. The language server works while nothing else is asked.

import makeGable from 'gable-wasm/gable.mjs';
import wasmAddress from 'gable-wasm/gable.wasm.lzma?url';
import { openEngine, type Engine } from '../../apps/gable_wasm/engine.mjs';
import { unpacked } from './examples';
import { unpackLzma } from './lzma';
import type { FromWorker, ToWorker } from './messages';

type Ask = Extract<ToWorker, { kind: 'ask' }>;

const asked: Ask[] = [];
let engine: Engine | null = null;
let timer = 0;
let busy = false;
const turns = new MessageChannel();
turns.port1.onmessage = () => void turn();

const post = (message: FromWorker, transfer: Transferable[] = []) =>
  self.postMessage(message, { transfer });

/** Lets messages that have come be heard first. */
function again(): void {
  turns.port2.postMessage(null);
}

async function fetched(address: string | URL): Promise<Uint8Array<ArrayBuffer>> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${String(address)} is missing`);
  return unpackLzma(new Uint8Array(await answer.arrayBuffer()));
}

/** The examples lie beside the page, as tools/pack_examples.py packs them. */
async function examples(): Promise<[string, Uint8Array][]> {
  const plain = await fetched(new URL('../examples.pack', self.location.href));
  return unpacked(plain).map(([path, bytes]) => [`/examples/${path}`, bytes]);
}

async function start(): Promise<void> {
  const [wasm, files] = await Promise.all([fetched(wasmAddress), examples()]);
  engine = await openEngine(makeGable, wasm, files);
  again();
}

async function answer(engine: Engine, { id, method, path, body }: Ask): Promise<void> {
  post({ kind: 'begun', id });
  const url = new URL(path, 'http://engine/api/');
  const bytes =
    typeof body === 'string'
      ? new TextEncoder().encode(body)
      : new Uint8Array((await body?.arrayBuffer()) ?? []);
  const told = engine.ask(method, url.pathname, [...url.searchParams], bytes);
  post({ kind: 'answer', id, ...told }, [told.body.buffer]);
}

function speak({ language }: Engine): boolean {
  const worked = language.step();
  for (let text = language.said(); text !== null; text = language.said())
    post({ kind: 'said', text });
  return worked;
}

async function turn(): Promise<void> {
  // Requests are answered in their order, also where a body has to be waited for.
  if (!engine || busy) return;
  clearTimeout(timer);
  const next = asked.shift();
  if (next) {
    busy = true;
    await answer(engine, next);
    busy = false;
  } else if (!speak(engine)) {
    const wait = engine.language.wait();
    if (wait >= 0) timer = self.setTimeout(again, wait * 1000);
    return;
  }
  again();
}

function broken(error: unknown): void {
  engine = null;
  post({ kind: 'broken', why: error instanceof Error ? error.message : String(error) });
}

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if (data.kind === 'ask') asked.push(data);
  else if (data.kind === 'drop') {
    const at = asked.findIndex((ask) => ask.id === data.id);
    if (at >= 0) asked.splice(at, 1);
  } else if (data.kind === 'say') engine?.language.hear(data.text);
  else engine?.language.begin();
  again();
};
self.onunhandledrejection = (event) => broken(event.reason);
start().catch(broken);
