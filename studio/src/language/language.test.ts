// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { Text } from '@codemirror/state';
import { expect, it } from 'vitest';
import { template } from '../editor/assist';
import { wordsOf } from '../editor/looks';
import { Away, Cancelled, Connection, type Wire } from './connection';
import { Language } from './language.svelte';
import { blocksOf } from './markdown';
import { edited, offsetIn, offsetOf, pathOf, positionIn, positionOf, uriOf } from './protocol';

class FakeWire implements Wire {
  onopen: Wire['onopen'] = null;
  onmessage: Wire['onmessage'] = null;
  onclose: Wire['onclose'] = null;
  said: { id?: number; method: string; params: Record<string, unknown> }[] = [];
  send(text: string): void {
    this.said.push(JSON.parse(text) as (typeof this.said)[0]);
  }
  close(): void {
    this.onclose?.({} as CloseEvent);
  }
  open(): void {
    this.onopen?.({} as Event);
  }
  answer(message: object): void {
    this.onmessage?.({ data: JSON.stringify(message) } as MessageEvent<unknown>);
  }
  methods(): string[] {
    return this.said.map((m) => m.method);
  }
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

it('answers requests, refuses what was taken back or asked of one that ended', async () => {
  const wire = new FakeWire();
  const connection = new Connection(wire, () => undefined);
  await expect(connection.request('a', {})).rejects.toThrow(Away);
  wire.open();
  const first = connection.request('a', {});
  wire.answer({ id: 1, result: 7 });
  expect(await first).toBe(7);
  const abort = new AbortController();
  const second = connection.request('b', {}, abort.signal);
  abort.abort();
  await expect(second).rejects.toThrow(Cancelled);
  expect(wire.said.at(-1)).toMatchObject({ method: '$/cancelRequest', params: { id: 2 } });
  const third = connection.request('c', {});
  wire.answer({ id: 3, error: { code: -32803, message: 'no such name' } });
  await expect(third).rejects.toThrow('no such name');
  const last = connection.request('d', {});
  wire.close();
  await expect(last).rejects.toThrow(Away);
});

async function connected(texts: { path: string; text: string }[]) {
  const wires: FakeWire[] = [];
  const language = new Language({
    root: '/p',
    texts: () => texts,
    wire: () => {
      wires.push(new FakeWire());
      return wires.at(-1)!;
    },
  });
  const begin = async () => {
    language.connect();
    wires.at(-1)!.open();
    wires.at(-1)!.answer({ id: 1, result: {} });
    await settled();
  };
  await begin();
  return { language, wires, begin };
}

it('sends what has changed of a text when something is asked, and nothing before', async () => {
  const texts = [{ path: 'a b.cga', text: 'Lot -->\n  X' }];
  const { language, wires } = await connected(texts);
  const [wire] = wires as [FakeWire];
  expect(wire.methods()).toEqual(['initialize', 'initialized', 'textDocument/didOpen']);
  texts[0]!.text = 'Lot -->\n  Yard X';
  texts[0]!.text = 'Lot -->\n  Yards X';
  language.touched();
  language.touched();
  expect(wire.said.length).toBe(3);
  const asked = language.ask('textDocument/hover', 'a b.cga');
  expect(wire.methods().slice(3)).toEqual(['textDocument/didChange', 'textDocument/hover']);
  expect(wire.said[3]!.params).toMatchObject({
    textDocument: { uri: 'file:///p/a%20b.cga', version: 2 },
    contentChanges: [
      {
        range: { start: { line: 1, character: 2 }, end: { line: 1, character: 2 } },
        text: 'Yards ',
      },
    ],
  });
  wire.answer({ id: 2, result: null });
  expect(await asked).toBeNull();
  texts.pop();
  void language.tell('textDocument/hover', 'other.cga');
  expect(wire.methods().slice(5)).toEqual(['textDocument/didClose', 'textDocument/hover']);
});

it('keeps the mistakes of the text as it is, with what mends them', async () => {
  const texts = [{ path: 'a.cga', text: 'X' }];
  const { language, wires } = await connected(texts);
  const [wire] = wires as [FakeWire];
  const range = { start: { line: 0, character: 0 }, end: { line: 0, character: 1 } };
  const finding = { range, severity: 1, code: 'c', message: 'm' };
  const publish = (version: number, diagnostics: unknown[]) =>
    wire.answer({
      method: 'textDocument/publishDiagnostics',
      params: { uri: 'file:///p/a.cga', version, diagnostics },
    });
  publish(9, [finding]);
  await settled();
  expect(language.mistakes.size).toBe(0);
  publish(1, [finding]);
  const mend = { title: 'Mend it', diagnostics: [finding], edit: { changes: {} } };
  wire.answer({ id: 2, result: [mend] });
  await settled();
  expect(language.mistakes.get('a.cga')).toEqual([{ ...finding, actions: [mend] }]);
  publish(1, []);
  await settled();
  expect(language.mistakes.size).toBe(0);
});

it('tells a server that comes back all texts again', async () => {
  const texts = [{ path: 'a.cga', text: 'X' }];
  const { language, wires, begin } = await connected(texts);
  const before = language.session;
  wires[0]!.close();
  await begin();
  expect(wires[1]!.methods()).toContain('textDocument/didOpen');
  expect(language.session).toBe(before + 1);
});

it('finds places of a text, each way', () => {
  const text = 'one\ntwo\n\nfour';
  const doc = Text.of(text.split('\n'));
  for (let i = 0; i <= text.length; ++i) {
    expect(positionIn(text, i)).toEqual(positionOf(doc, i));
    expect(offsetIn(text, positionIn(text, i))).toBe(i);
    expect(offsetOf(doc, positionOf(doc, i))).toBe(i);
  }
  expect(offsetIn(text, { line: 9, character: 0 })).toBe(text.length);
  expect(offsetIn(text, { line: 0, character: 99 })).toBe(3);
  expect(pathOf('/p q', uriOf('/p q', 'a/ü.cga'))).toBe('a/ü.cga');
  expect(pathOf('/p', 'file:///other/a.cga')).toBeNull();
  const range = (a: number, b: number) => ({
    start: positionIn(text, a),
    end: positionIn(text, b),
  });
  const edits = [
    { range: range(0, 3), newText: '1' },
    { range: range(4, 4), newText: 'the ' },
  ];
  expect(edited(text, edits)).toBe('1\nthe two\n\nfour');
});

it('reads tokens, templates and Markdown', () => {
  const doc = Text.of(['attr height = 9', 'Lot --> X']);
  const data = [0, 0, 4, 1, 0, 0, 5, 6, 9, 1, 1, 0, 3, 5, 1, 0, 8, 1, 6, 0];
  expect(wordsOf(doc, data).map((w) => [doc.sliceString(w.from, w.to), w.className])).toEqual([
    ['attr', 't-keyword'],
    ['height', 't-attribute'],
    ['Lot', 't-rule t-declared'],
    ['X', 't-leaf'],
  ]);
  expect(template('split(${1|x,y,z|}) { ${2:~1} : A }')).toBe('split(${1:x}) { ${2:~1} : A }');
  expect(blocksOf('# A\n\none\ntwo\n\n```cga\nx <b>\n```\n- p\n- q\n|a|b|\n|-|-|\n|1|2|')).toEqual([
    { kind: 'heading', text: 'A' },
    { kind: 'text', text: 'one two' },
    { kind: 'code', text: 'x <b>' },
    { kind: 'list', items: ['p', 'q'] },
    {
      kind: 'table',
      rows: [
        ['a', 'b'],
        ['1', '2'],
      ],
    },
  ]);
});
