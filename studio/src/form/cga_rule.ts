// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is written behind the arrow of a rule, as a tree of fields. Each field knows where its text
// is, so that an edit replaces this piece of text and nothing else.

import type { Change, Span } from '../text/rules';
import { closing, tokenize, type Token } from '../text/tokens';

export interface Field extends Span {
  text: string;
}

/** An operation or a successor: a name, what stands in its brackets, what stands in its braces. */
export interface Call extends Span {
  kind: 'call';
  name: Field;
  args: Field[];
  blocks: Block[];
}

export interface Mark extends Span {
  kind: 'mark';
  text: string;
}

/** `{ head : items | head : items }*` */
export interface Block extends Span {
  slots: Slot[];
  repeated: boolean;
}

export interface Slot extends Span {
  /** A size, a selector; null for a repeated group. */
  head: Field | null;
  group: Block | null;
  body: Body | null;
}

export type Item = Call | Mark;

/** One way that a rule may go: under a condition, by chance, or the only one. */
export interface Branch extends Span {
  kind: 'case' | 'else' | 'chance' | 'plain';
  /** The condition or the number of percent. */
  head: Field | null;
  items: Item[];
  nested: Body | null;
}

export interface Body extends Span {
  branches: Branch[];
}

class Reader {
  constructor(
    readonly source: string,
    readonly tokens: Token[],
  ) {}

  field(first: number, end: number): Field | null {
    if (first >= end) return null;
    const from = this.tokens[first]!.from;
    const to = this.tokens[end - 1]!.to;
    return { from, to, text: this.source.slice(from, to) };
  }

  span(first: number, end: number): Span {
    const from = this.tokens[first]?.from ?? this.source.length;
    return { from, to: end > first ? this.tokens[end - 1]!.to : from };
  }

  /** Where a mark stands between two tokens outside of brackets; `end` for nowhere. */
  find(mark: string, first: number, end: number): number {
    for (let i = first; i < end; ++i) {
      const t = this.tokens[i]!;
      if (t.kind !== 'mark') continue;
      if (t.text === mark) return i;
      if ('([{'.includes(t.text)) i = closing(this.tokens, i);
    }
    return end;
  }

  private isChance(i: number): boolean {
    return (
      this.tokens[i]?.kind === 'number' &&
      this.tokens[i + 1]?.text === '%' &&
      this.tokens[i + 2]?.text === ':'
    );
  }

  body(first: number, end: number): Body {
    const starts: { at: number; kind: Branch['kind'] }[] = [];
    const chances = this.isChance(first);
    let depth = 0;
    for (let i = first; i < end; ++i) {
      const t = this.tokens[i]!;
      if (t.kind === 'mark' && '([{'.includes(t.text)) {
        i = closing(this.tokens, i);
        continue;
      }
      if (chances && this.isChance(i)) starts.push({ at: i, kind: 'chance' });
      else if (t.text === 'case') {
        if (!chances && (starts.length === 0 ? i === first : depth === 0))
          starts.push({ at: i, kind: 'case' });
      } else if (t.text === 'else' && starts.length && depth === 0)
        starts.push({ at: i, kind: 'else' });
      // In a list of chances a case belongs to the branch that it stands in, with its else.
      if (chances && t.text === 'case') ++depth;
      if (chances && t.text === 'else' && depth > 0) --depth;
    }
    if (!starts.length)
      return {
        ...this.span(first, end),
        branches: [this.branch('plain', first, first, first, end)],
      };
    const branches = starts.map(({ at, kind }, i) => {
      const stop = starts[i + 1]?.at ?? end;
      const colon = this.find(':', at, stop);
      const head = kind === 'else' ? at + 1 : kind === 'case' ? at + 1 : at;
      return this.branch(kind, at, head, Math.min(colon, stop), stop);
    });
    return { ...this.span(first, end), branches };
  }

  private branch(
    kind: Branch['kind'],
    first: number,
    head: number,
    colon: number,
    end: number,
  ): Branch {
    const isPlain = kind === 'plain';
    const headEnd = kind === 'chance' ? colon - 1 : colon;
    const from = isPlain ? first : Math.min(colon + 1, end);
    const inner = this.tokens[from]?.text === 'case' || (from < end && this.isChance(from));
    return {
      ...this.span(first, end),
      kind,
      head: isPlain || kind === 'else' ? null : this.field(head, headEnd),
      items: inner && !isPlain ? [] : this.items(from, end),
      nested: inner && !isPlain ? this.body(from, end) : null,
    };
  }

  private items(first: number, end: number): Item[] {
    const out: Item[] = [];
    for (let i = first; i < end;) {
      const t = this.tokens[i]!;
      if (t.kind !== 'name') {
        out.push({ kind: 'mark', text: t.text, from: t.from, to: t.to });
        ++i;
        continue;
      }
      const call = this.call(i, end);
      out.push(call.item);
      i = call.next;
    }
    return out;
  }

  private call(at: number, end: number): { item: Call; next: number } {
    let next = at + 1;
    const args: Field[] = [];
    const blocks: Block[] = [];
    if (this.tokens[next]?.text === '(' && next < end) {
      const close = Math.min(closing(this.tokens, next), end - 1);
      for (let i = next + 1; i < close;) {
        const comma = this.find(',', i, close);
        const field = this.field(i, comma);
        if (field) args.push(field);
        i = comma + 1;
      }
      next = close + 1;
    }
    while (next < end && this.tokens[next]?.text === '{') {
      const close = Math.min(closing(this.tokens, next), end - 1);
      const repeated = this.tokens[close + 1]?.text === '*' && close + 1 < end;
      blocks.push(this.block(next, close, repeated));
      next = close + (repeated ? 2 : 1);
    }
    const name = this.tokens[at]!;
    return {
      item: {
        kind: 'call',
        ...this.span(at, next),
        name: { from: name.from, to: name.to, text: name.text },
        args,
        blocks,
      },
      next,
    };
  }

  private block(open: number, close: number, repeated: boolean): Block {
    const slots: Slot[] = [];
    for (let i = open + 1; i < close;) {
      const bar = this.find('|', i, close);
      if (this.tokens[i]!.text === '{') {
        const inner = Math.min(closing(this.tokens, i), bar - 1);
        slots.push({
          ...this.span(i, bar),
          head: null,
          group: this.block(i, inner, this.tokens[inner + 1]?.text === '*'),
          body: null,
        });
      } else {
        const colon = this.find(':', i, bar);
        const has = colon < bar;
        slots.push({
          ...this.span(i, bar),
          head: has ? this.field(i, colon) : null,
          group: null,
          body: this.body(has ? colon + 1 : i, bar),
        });
      }
      i = bar + 1;
    }
    return { ...this.span(open, close + (repeated ? 2 : 1)), slots, repeated };
  }
}

/** The body of a rule; offsets are those of the whole text. */
export function parseBody(text: string, body: Span): Body {
  const tokens = tokenize(text).filter(
    (t) => t.kind !== 'comment' && t.from >= body.from && t.to <= body.to,
  );
  return new Reader(text, tokens).body(0, tokens.length);
}

/** Takes an item out, with the blanks or the line that only it stood on. */
export function removeItem(text: string, item: Span): Change {
  const line = text.lastIndexOf('\n', item.from - 1) + 1;
  let end = text.indexOf('\n', item.to);
  if (end < 0) end = text.length;
  const alone = text.slice(line, item.from).trim() === '' && text.slice(item.to, end).trim() === '';
  if (alone && line > 0) return { from: line - 1, to: end, insert: '' };
  let { from } = item;
  while (text[from - 1] === ' ') --from;
  return { from, to: item.to, insert: '' };
}

/** Puts text behind an item, or at the beginning of a body that has none. */
export function insertAfter(text: string, after: Span | null, body: Span, insert: string): Change {
  if (!after)
    return {
      from: body.from,
      to: body.from,
      insert: text[body.from - 1] === ' ' ? `${insert} ` : ` ${insert}`,
    };
  const line = text.lastIndexOf('\n', after.from - 1) + 1;
  const before = text.slice(line, after.from);
  const glue = before.trim() === '' ? `\n${before}` : ' ';
  return { from: after.to, to: after.to, insert: glue + insert };
}

/** A further slot at the end of a block. */
export function addSlot(block: Block, insert: string): Change {
  const last = block.slots.at(-1);
  if (!last) return { from: block.from + 1, to: block.from + 1, insert: ` ${insert} ` };
  return { from: last.to, to: last.to, insert: ` | ${insert}` };
}

export function removeSlot(block: Block, index: number): Change {
  const slot = block.slots[index]!;
  const next = block.slots[index + 1];
  const before = block.slots[index - 1];
  if (before) return { from: before.to, to: slot.to, insert: '' };
  return { from: slot.from, to: next?.from ?? slot.to, insert: '' };
}

/** Half of the time this, half of the time nothing: what a choice begins with. */
export function makeChoice(text: string, body: Span): Change {
  return {
    from: body.from,
    to: body.to,
    insert: `50% : ${text.slice(body.from, body.to)} else : NIL`,
  };
}

/** A further possibility, in front of the else. */
export function addChance(body: Body): Change {
  const rest = body.branches.find((b) => b.kind === 'else');
  const at = rest ? rest.from : body.to;
  return { from: at, to: at, insert: rest ? '10% : NIL ' : ' 10% : NIL' };
}
