// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// unpackLzma: reads the .lzma files that tools/pack_bytes.py writes. Browsers unpack gzip alone, of
// which the same files would be a third larger.
//
// The content is bits, each coded by how likely it was where it stands: literal bytes, and matches,
// which are a length and a distance back. Of twelve states each says what came last.

/** Chances of a zero bit, of 2048; all begin at one half. */
type Chances = Uint16Array;
const chances = (count: number): Chances => new Uint16Array(count).fill(1024);

const HEADER = 13;
const STATES = 12;
/** States below this follow a literal. */
const AFTER_MATCH = 7;
const SHORTEST = 2;

class Bits {
  private range = 0xffffffff;
  private code: number;
  private at: number;

  constructor(
    private readonly bytes: Uint8Array,
    begin: number,
  ) {
    this.code = new DataView(bytes.buffer, bytes.byteOffset).getUint32(begin + 1);
    this.at = begin + 5;
  }

  /** One byte in for one out, with zeros behind the end: a file that is cut off has too few. */
  get beyondEnd(): boolean {
    return this.at > this.bytes.length;
  }

  private widen(): void {
    if (this.range >= 0x1000000) return;
    this.range = (this.range << 8) >>> 0;
    this.code = ((this.code << 8) | this.bytes[this.at++]!) >>> 0;
  }

  bit(of: Chances, i: number): number {
    const chance = of[i]!;
    const bound = (this.range >>> 11) * chance;
    const isOne = this.code >= bound;
    if (isOne) {
      this.range -= bound;
      this.code -= bound;
      of[i] = chance - (chance >>> 5);
    } else {
      this.range = bound;
      of[i] = chance + ((2048 - chance) >>> 5);
    }
    this.widen();
    return isOne ? 1 : 0;
  }

  /** Bits that are as likely as not. */
  even(count: number): number {
    let value = 0;
    for (let i = 0; i < count; ++i) {
      this.range >>>= 1;
      const isOne = this.code >= this.range;
      if (isOne) this.code -= this.range;
      this.widen();
      value = value * 2 + (isOne ? 1 : 0);
    }
    return value;
  }

  /** A number of so many bits, the highest first; each has a chance for all that may be before it. */
  tree(of: Chances, at: number, bits: number): number {
    let node = 1;
    for (let i = 0; i < bits; ++i) node = node * 2 + this.bit(of, at + node);
    return node - (1 << bits);
  }

  /** The same, the lowest bit first. */
  treeUpwards(of: Chances, at: number, bits: number): number {
    let node = 1;
    let value = 0;
    for (let i = 0; i < bits; ++i) {
      const bit = this.bit(of, at + node);
      node = node * 2 + bit;
      value |= bit << i;
    }
    return value;
  }
}

class Lengths {
  private readonly choice = chances(2);
  private readonly short: Chances;
  private readonly middle: Chances;
  private readonly long = chances(256);

  constructor(positions: number) {
    this.short = chances(positions * 8);
    this.middle = chances(positions * 8);
  }

  next(bits: Bits, position: number): number {
    if (!bits.bit(this.choice, 0)) return bits.tree(this.short, position * 8, 3);
    if (!bits.bit(this.choice, 1)) return 8 + bits.tree(this.middle, position * 8, 3);
    return 16 + bits.tree(this.long, 0, 8);
  }
}

class Distances {
  private readonly slots = chances(4 * 64);
  private readonly near = chances(128);
  private readonly lowest = chances(16);

  /** The distance less one. */
  next(bits: Bits, length: number): number {
    const slot = bits.tree(this.slots, Math.min(length, 3) * 64, 6);
    if (slot < 4) return slot;
    const more = (slot >>> 1) - 1;
    const begin = (2 | (slot & 1)) * 2 ** more;
    if (slot < 14) return begin + bits.treeUpwards(this.near, begin - slot, more);
    return begin + bits.even(more - 4) * 16 + bits.treeUpwards(this.lowest, 0, 4);
  }
}

class Unpacking {
  private readonly out: Uint8Array<ArrayBuffer>;
  private readonly bits: Bits;
  private readonly literals: Chances;
  private readonly lengths: Lengths;
  private readonly lengthsAgain: Lengths;
  private readonly distances = new Distances();
  private readonly isMatch: Chances;
  private readonly isLong: Chances;
  /** Whether a distance comes again, and which of the last four: the last, the one before, and so on. */
  private readonly isAgain = [0, 1, 2, 3].map(() => chances(STATES));
  private last = [0, 0, 0, 0];
  private state = 0;
  private at = 0;

  constructor(
    bytes: Uint8Array,
    size: number,
    private readonly context: number,
    private readonly literalMask: number,
    private readonly positionMask: number,
  ) {
    this.out = new Uint8Array(size);
    this.bits = new Bits(bytes, HEADER);
    this.literals = chances(0x300 * ((literalMask + 1) << context));
    this.lengths = new Lengths(positionMask + 1);
    this.lengthsAgain = new Lengths(positionMask + 1);
    this.isMatch = chances(STATES * (positionMask + 1));
    this.isLong = chances(STATES * (positionMask + 1));
  }

  run(): Uint8Array<ArrayBuffer> {
    while (this.at < this.out.length) {
      const position = this.at & this.positionMask;
      const place = this.state * (this.positionMask + 1) + position;
      if (!this.bits.bit(this.isMatch, place)) this.literal();
      else this.copy(this.match(position, place));
      if (this.bits.beyondEnd) throw new Error('a packed file is cut off');
    }
    return this.out;
  }

  private literal(): void {
    const before = this.at > 0 ? this.out[this.at - 1]! : 0;
    const context =
      ((this.at & this.literalMask) << this.context) + (before >>> (8 - this.context));
    const base = 0x300 * context;
    let node = 1;
    if (this.state >= AFTER_MATCH) {
      // What a longer match would have been is unlikely, and tells of the rest.
      let would = this.out[this.at - this.last[0]! - 1]!;
      while (node < 0x100) {
        const bit = (would >>> 7) & 1;
        would <<= 1;
        const is = this.bits.bit(this.literals, base + ((1 + bit) << 8) + node);
        node = node * 2 + is;
        if (is !== bit) break;
      }
    }
    while (node < 0x100) node = node * 2 + this.bits.bit(this.literals, base + node);
    this.out[this.at++] = node;
    this.state = this.state < 4 ? 0 : this.state - (this.state < 10 ? 3 : 6);
  }

  /** The length of a match, with its distance as the last. */
  private match(position: number, place: number): number {
    const afterMatch = this.state >= AFTER_MATCH;
    if (!this.bits.bit(this.isAgain[0]!, this.state)) {
      const length = this.lengths.next(this.bits, position);
      this.last = [this.distances.next(this.bits, length), ...this.last.slice(0, 3)];
      this.state = afterMatch ? 10 : 7;
      return length + SHORTEST;
    }
    if (!this.bits.bit(this.isAgain[1]!, this.state)) {
      if (!this.bits.bit(this.isLong, place)) {
        this.state = afterMatch ? 11 : 9;
        return 1;
      }
    } else this.recall();
    const length = this.lengthsAgain.next(this.bits, position);
    this.state = afterMatch ? 11 : 8;
    return length + SHORTEST;
  }

  /** Brings the second, third or fourth of the last distances to the front. */
  private recall(): void {
    let which = 1;
    while (which < 3 && this.bits.bit(this.isAgain[which + 1]!, this.state)) ++which;
    const [distance] = this.last.splice(which, 1);
    this.last.unshift(distance!);
  }

  private copy(length: number): void {
    const distance = this.last[0]! + 1;
    if (distance > this.at || length > this.out.length - this.at) {
      throw new Error('a packed file is damaged');
    }
    for (let i = 0; i < length; ++i, ++this.at) this.out[this.at] = this.out[this.at - distance]!;
  }
}

/** The content of a .lzma file that tells its size. Throws where the file is cut off or damaged. */
export function unpackLzma(bytes: Uint8Array): Uint8Array<ArrayBuffer> {
  if (bytes.length < HEADER + 5) throw new Error('a packed file is cut off');
  const settings = bytes[0]!;
  const size = Number(new DataView(bytes.buffer, bytes.byteOffset).getBigUint64(5, true));
  if (settings >= 225 || size > 2 ** 31) throw new Error('a packed file is damaged');
  const context = settings % 9;
  const literalBits = Math.floor(settings / 9) % 5;
  const positionBits = Math.floor(settings / 45);
  const masks = [(1 << literalBits) - 1, (1 << positionBits) - 1] as const;
  return new Unpacking(bytes, size, context, ...masks).run();
}
