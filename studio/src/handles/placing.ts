// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where handles stand in the picture: dimensions beside the model, out of each other's way, on the
// shape that is nearest. A handle that would be too small, or has no room, is left out.

import type { Align, Handle } from './annotation';
import {
  cornersOf,
  cross,
  dot,
  gap,
  hull,
  inHull,
  length,
  mid,
  minus,
  pixelsAMetre,
  plus,
  pointIn,
  unit,
  type Box,
  type Eye,
  type P2,
  type P3,
} from './geometry';

/** A dimension: from its fixed end to the one that is dragged. */
export interface Line {
  kind: 'line';
  from: P3;
  to: P3;
  /** What it measures: the ends of the shape that thin lines lead to. */
  feet: [P3, P3];
  /** Further equal ones in its line. */
  more: [P3, P3][];
  /** What a metre of the dimension is of the measured length: two where both ends move. */
  length: number;
}
/** A circle about an axis. */
export interface Ring {
  kind: 'ring';
  middle: P3;
  axis: P3;
  /** From where angles count. */
  zero: P3;
  radius: number;
}
/** Something to press, beside the shape. */
export interface Spot {
  kind: 'spot';
  at: P2;
  foot: P2;
}

export interface Placed {
  handle: Handle;
  node: number;
  /** Of a shape and the side of it: what was found to be hidden is not tried again. */
  key: string;
  form: Line | Ring | Spot;
}

/** A shape that may carry a handle. */
export interface Candidate {
  node: number;
  box: Box;
}

const LEAST_PIXELS = 14;
const BESIDE = 28;
const NEXT = 24;
const MOST_BESIDE = 190;
/** Lines nearer to each other are hard to grasp. */
const APART = 17;
const RING_PIXELS = 46;
const MOVE_PIXELS = 34;
/** Half of what is pressed, and where it gives way to. */
const SPOT_PIXELS = 14;
const ASIDE = [0, 30, -30, 60, -60];
/** Beside the shape, or else upon it. */
const BESIDES = [28, 52, 76, 100, 124, -28, -52, -76, -100];
/** Of the shapes nearest to the camera so many are looked at. */
const MOST_TRIED = 6;
const MOST_CHAIN = 60;

const TOWARDS: Record<Align, [number, number]> = {
  default: [0, 0],
  left: [-1, 0],
  right: [1, 0],
  top: [0, -1],
  bottom: [0, 1],
  topLeft: [-0.7, -0.7],
  topRight: [0.7, -0.7],
  bottomLeft: [-0.7, 0.7],
  bottomRight: [0.7, 0.7],
};

/** An edge of a box to be measured, and the way out of the picture of the box. */
interface Edge {
  name: string;
  from: P3;
  to: P3;
  out: P3 | null;
  /** It is on the outline of the box. */
  outer: boolean;
}

function edgesOf(handle: Handle, box: Box, eye: Eye): Edge[] {
  const { axis, reference, translate } = handle;
  const [b, c] = [(axis + 1) % 3, (axis + 2) % 3] as [0 | 1 | 2, 0 | 1 | 2];
  const share: P3 = [...translate];
  const edge = (name: string, i: number, j: number, out: P3 | null, outer: boolean): Edge => {
    const at: P3 = [...share];
    at[b] += i;
    at[c] += j;
    const from = pointIn(box, at);
    return { name, from, to: plus(from, box.axes[axis], box.size[axis]), out, outer };
  };
  if (reference === 'center') return [edge('c', 0.5, 0.5, null, false)];
  const seen = (side: 0 | 1 | 2, i: number): boolean => {
    const at: P3 = [0.5, 0.5, 0.5];
    at[side] = i;
    return dot(minus(eye.position, pointIn(box, at)), box.axes[side]) * (i ? 1 : -1) > 0;
  };
  const normal = (side: 0 | 1 | 2, i: number): P3 => {
    const n = box.axes[side];
    return i ? n : [-n[0], -n[1], -n[2]];
  };
  const flat = (side: 0 | 1 | 2) => box.size[side] <= 1e-9;
  const out: Edge[] = [];
  for (const i of flat(b) ? [0] : [0, 1]) {
    for (const j of flat(c) ? [0] : [0, 1]) {
      if (reference === 'origin' && (i || j)) continue;
      const name = `${i}${j}`;
      // A line leaves towards the picture's side, a flat scope within its plane, a box within the
      // face that is seen.
      if (flat(b) && flat(c)) out.push(edge(name, i, j, null, true));
      else if (flat(b)) out.push(edge(name, i, j, normal(c, j), true));
      else if (flat(c)) out.push(edge(name, i, j, normal(b, i), true));
      else {
        const [first, second] = [seen(b, i), seen(c, j)];
        const outer = first !== second;
        out.push(edge(name, i, j, first ? normal(c, j) : normal(b, i), outer));
      }
    }
  }
  return out;
}

/** From the axis of a box outwards, across what is seen. */
function radius(handle: Handle, box: Box, eye: Eye): Edge {
  const { axis, align } = handle;
  const along = box.axes[axis];
  const [b, c] = [(axis + 1) % 3, (axis + 2) % 3] as [0 | 1 | 2, 0 | 1 | 2];
  const share: P3 = [0.5, 0.5, 0.5];
  share[axis] = /^top/.test(align) ? 1 : 0;
  for (const i of [0, 1, 2] as const) share[i] += handle.translate[i];
  const from = pointIn(box, share);
  let right = unit(cross(unit(minus(from, eye.position)), along));
  if (length(right) < 0.5) right = box.axes[b];
  if (/left/i.test(align)) right = [-right[0], -right[1], -right[2]];
  const far = Math.max(box.size[b], box.size[c]) / 2;
  return { name: 'r', from, to: plus(from, right, far), out: null, outer: true };
}

/** What stands in the way: the model's outline, and what was placed before. */
export class Room {
  private readonly lines: [P2, P2][] = [];
  constructor(
    private readonly eye: Eye,
    /** Around the model of the lot. */
    private readonly outline: P2[],
  ) {}

  inSight = (p: P2): boolean =>
    p.x > 8 && p.y > 8 && p.x < this.eye.width - 8 && p.y < this.eye.height - 8;

  free = (line: [P2, P2]): boolean => this.lines.every((other) => gap(line, other) > APART);

  outside = (p: P2): boolean => this.outline.length < 3 || !inHull(this.outline, p, 8);

  take(line: [P2, P2]): void {
    this.lines.push(line);
  }
}

/** Away from the middle of the box, across a line of the picture. */
function acrossInPicture(a: P2, b: P2, middle: P2, align: Align): P2 {
  const l = Math.hypot(b.x - a.x, b.y - a.y) || 1;
  const out = { x: (a.y - b.y) / l, y: (b.x - a.x) / l };
  const [x, y] = TOWARDS[align];
  const wished = x * out.x + y * out.y;
  const away = ((a.x + b.x) / 2 - middle.x) * out.x + ((a.y + b.y) / 2 - middle.y) * out.y;
  const turn = Math.abs(wished) > 0.1 ? wished : Math.abs(away) > 2 ? away : out.x || 1;
  return turn < 0 ? { x: -out.x, y: -out.y } : out;
}

/** A point of the world that a pixel shows, as far from the eye as another is. */
function lifted(eye: Eye, at: P3, by: P2): P3 | null {
  const p = eye.project(at);
  if (!p) return null;
  return plus(
    eye.position,
    eye.ray({ x: p.x + by.x, y: p.y + by.y }),
    length(minus(at, eye.position)),
  );
}

interface Option {
  form: Line;
  key: string;
  node: number;
  seen: [P2, P2];
  cost: number;
}

/** The ends of an edge so many pixels beside it. */
function besides(
  handle: Handle,
  edge: Edge,
  eye: Eye,
  pixels: number,
  middle: P2,
): [P3, P3] | null {
  if (pixels === 0) return [edge.from, edge.to];
  const a = eye.project(edge.from);
  const b = eye.project(edge.to);
  if (!a || !b) return null;
  const scale = edge.out ? pixelsAMetre(eye, mid(edge.from, edge.to), edge.out) : 0;
  const full = pixelsAMetre(
    eye,
    mid(edge.from, edge.to),
    unit(cross(unit(minus(edge.from, eye.position)), [0, 1, 0])),
  );
  if (edge.out && handle.slip === 'scope' && scale > 0.3 * full) {
    const far = pixels / scale;
    return [plus(edge.from, edge.out, far), plus(edge.to, edge.out, far)];
  }
  const out = acrossInPicture(a, b, middle, handle.align);
  const by = { x: out.x * pixels, y: out.y * pixels };
  const from = lifted(eye, edge.from, by);
  // Moved as one, so that the length stays.
  return from && [from, plus(from, minus(edge.to, edge.from))];
}

function lineOption(
  handle: Handle,
  { node, box }: Candidate,
  edge: Edge,
  eye: Eye,
  room: Room,
): Option | null {
  const middle = eye.project(pointIn(box, [0.5, 0.5, 0.5]));
  const [a, b] = [eye.project(edge.from), eye.project(edge.to)];
  if (!middle || !a || !b || Math.hypot(a.x - b.x, a.y - b.y) < LEAST_PIXELS) return null;
  const inside = handle.slip === 'inside' || handle.reference === 'radial';
  let fallback: Option | null = null;
  for (let pixels = inside ? 0 : BESIDE; pixels <= MOST_BESIDE; pixels += NEXT) {
    const ends = besides(handle, edge, eye, pixels, middle);
    const seen = ends && [eye.project(ends[0]), eye.project(ends[1])];
    if (!ends || !seen?.[0] || !seen[1]) return null;
    const both: [P2, P2] = [seen[0], seen[1]];
    const centre = { x: (both[0].x + both[1].x) / 2, y: (both[0].y + both[1].y) / 2 };
    if (!room.inSight(both[1]) || !room.inSight(centre) || !room.free(both)) continue;
    const [x, y] = TOWARDS[handle.align];
    const side = (centre.x - middle.x) * x + (centre.y - middle.y) * y;
    const option: Option = {
      form: {
        kind: 'line',
        from: ends[0],
        to: ends[1],
        feet: [edge.from, edge.to],
        more: [],
        length: length(minus(edge.to, edge.from)),
      },
      key: `${handle.id}|${node}|${edge.name}`,
      node,
      seen: both,
      // Outlines first, what is wished next, then what is near; right and below among equals.
      cost:
        (edge.outer ? 0 : 4000) -
        (handle.align === 'default' ? 0 : 10 * side) +
        pixels -
        (centre.x + centre.y) / 50,
    };
    if (inside || room.outside(centre)) return option;
    fallback ??= { ...option, cost: option.cost + 1000 };
  }
  // Close to the model everything is within its outline.
  return fallback;
}

/** Those that stand in one line with the chosen one, as parts of a wall do. */
function chainOf(handle: Handle, chosen: Option, candidates: Candidate[], eye: Eye): [P3, P3][] {
  const { form } = chosen;
  const along = unit(minus(form.feet[1], form.feet[0]));
  const out: [P3, P3][] = [];
  const name = chosen.key.slice(chosen.key.lastIndexOf('|') + 1);
  for (const { node, box } of candidates) {
    if (node === chosen.node || out.length >= MOST_CHAIN) continue;
    const edge = edgesOf(handle, box, eye).find((e) => e.name === name);
    if (!edge) continue;
    const off = minus(edge.from, form.feet[0]);
    const far = dot(off, along);
    const beside = length(minus(off, plus([0, 0, 0], along, far)));
    const turned = Math.abs(dot(unit(minus(edge.to, edge.from)), along)) < 0.9999;
    if (turned || beside > 1e-3 * (1 + form.length)) continue;
    const by = minus(form.from, form.feet[0]);
    out.push([plus(edge.from, by), plus(edge.to, by)]);
  }
  return out;
}

/** What of several shapes is nearest to the camera and in sight comes first. */
function nearest(candidates: Candidate[], eye: Eye, room: Room): Candidate[] {
  return candidates
    .map((c) => ({ c, middle: pointIn(c.box, [0.5, 0.5, 0.5]) }))
    .map(({ c, middle }) => ({
      c,
      p: eye.project(middle),
      far: length(minus(middle, eye.position)),
    }))
    .filter(({ p }) => p && room.inSight(p))
    .sort((a, b) => a.far - b.far)
    .slice(0, MOST_TRIED)
    .map(({ c }) => c);
}

function placeLine(
  handle: Handle,
  candidates: Candidate[],
  eye: Eye,
  room: Room,
  hidden: ReadonlySet<string>,
): Placed | null {
  let best: Option | null = null;
  for (const [rank, candidate] of candidates.entries()) {
    const edges =
      handle.reference === 'radial'
        ? [radius(handle, candidate.box, eye)]
        : edgesOf(handle, candidate.box, eye);
    for (const edge of edges) {
      const option = lineOption(handle, candidate, edge, eye, room);
      if (!option || hidden.has(option.key)) continue;
      option.cost += rank * 60;
      if (!best || option.cost < best.cost) best = option;
    }
  }
  if (!best) return null;
  room.take(best.seen);
  return { handle, node: best.node, key: best.key, form: best.form };
}

/** Of a position: a short piece of its axis, as long in any picture. */
function placeMove(handle: Handle, { node, box }: Candidate, eye: Eye, room: Room): Placed | null {
  const edge = edgesOf({ ...handle, reference: 'origin' }, box, eye)[0];
  const along = box.axes[handle.axis];
  const at = handle.reference === 'center' ? pointIn(box, [0.5, 0.5, 0.5]) : edge?.from;
  const scale = at ? pixelsAMetre(eye, at, along) : 0;
  if (!at || scale <= 0) return null;
  const ends: [P3, P3] = [at, plus(at, along, MOVE_PIXELS / scale)];
  const [a, b] = [eye.project(ends[0]), eye.project(ends[1])];
  if (!a || !b || !room.inSight(b) || !room.free([a, b])) return null;
  if (pixelsAMetre(eye, at, unit(cross(minus(at, eye.position), along))) * 0.2 > scale) return null;
  room.take([a, b]);
  const form: Line = { kind: 'line', from: at, to: ends[1], feet: ends, more: [], length: 0 };
  return { handle, node, key: `${handle.id}|${node}|m`, form };
}

function placeRing(handle: Handle, { node, box }: Candidate, eye: Eye, room: Room): Placed | null {
  const share: P3 = handle.reference === 'center' ? [0.5, 0.5, 0.5] : [0, 0, 0];
  for (const i of [0, 1, 2] as const) share[i] += handle.translate[i];
  const middle = pointIn(box, share);
  const axis = box.axes[handle.axis];
  const at = eye.project(middle);
  const view = unit(minus(middle, eye.position));
  // From the side a circle is a line.
  if (!at || !room.inSight(at) || Math.abs(dot(view, axis)) < 0.12) return null;
  const scale = pixelsAMetre(eye, middle, unit(cross(view, axis)));
  if (scale <= 0) return null;
  const form: Ring = {
    kind: 'ring',
    middle,
    axis,
    zero: box.axes[(handle.axis + 1) % 3]!,
    radius: RING_PIXELS / scale,
  };
  return { handle, node, key: `${handle.id}|${node}|a`, form };
}

function placeSpot(handle: Handle, { node, box }: Candidate, eye: Eye, room: Room): Placed | null {
  const seen = cornersOf(box).map((c) => eye.project(c));
  if (seen.some((p) => !p)) return null;
  const points = seen as P2[];
  const [xs, ys] = [points.map((p) => p.x), points.map((p) => p.y)];
  const [left, right, top, bottom] = [
    Math.min(...xs),
    Math.max(...xs),
    Math.min(...ys),
    Math.max(...ys),
  ];
  if (Math.max(right - left, bottom - top) < LEAST_PIXELS) return null;
  const [x, y] = TOWARDS[handle.align === 'default' ? 'top' : handle.align];
  const middle = eye.project(pointIn(box, [0.5, 0.5, 0.5]));
  if (!middle) return null;
  const inside = handle.slip === 'inside';
  const foot = inside
    ? middle
    : {
        x: Math.abs(x) < 0.1 ? middle.x : x < 0 ? left : right,
        y: Math.abs(y) < 0.1 ? middle.y : y < 0 ? top : bottom,
      };
  // Where the shape fills the picture, it has no outside.
  foot.x = Math.max(SPOT_PIXELS * 4, Math.min(eye.width - SPOT_PIXELS * 4, foot.x));
  foot.y = Math.max(SPOT_PIXELS * 4, Math.min(eye.height - SPOT_PIXELS * 4, foot.y));
  for (const pixels of inside ? [0, ...BESIDES] : BESIDES) {
    for (const aside of ASIDE) {
      const at = {
        x: foot.x + x * pixels - y * aside,
        y: foot.y + y * pixels + x * aside,
      };
      const width: [P2, P2] = [
        { x: at.x - SPOT_PIXELS, y: at.y },
        { x: at.x + SPOT_PIXELS, y: at.y },
      ];
      if (!width.every(room.inSight) || !room.free(width)) continue;
      room.take(width);
      return { handle, node, key: `${handle.id}|${node}|s`, form: { kind: 'spot', at, foot } };
    }
  }
  return null;
}

/** Points around a box of the model, for its outline. */
export function outlineOf(eye: Eye, box: Box): P2[] {
  const seen = cornersOf(box).map((c) => eye.project(c));
  return seen.every((p) => p) ? hull(seen as P2[]) : [];
}

/**
 * Places the handles in order; `shapes` gives those that may carry one, `hidden` the places that
 * stand behind something.
 */
export function placeAll(
  handles: Handle[],
  shapes: (handle: Handle) => Candidate[],
  eye: Eye,
  outline: P2[],
  hidden: ReadonlySet<string>,
): Placed[] {
  const room = new Room(eye, outline);
  const out: Placed[] = [];
  for (const handle of handles) {
    const all = shapes(handle);
    const near = nearest(all, eye, room);
    let placed: Placed | null = null;
    if (handle.kind === 'linear') placed = placeLine(handle, near, eye, room, hidden);
    else {
      const place = { move: placeMove, angular: placeRing }[handle.kind as 'move'] ?? placeSpot;
      for (const candidate of near) {
        placed ??= place(handle, candidate, eye, room);
        if (placed && hidden.has(placed.key)) placed = null;
      }
    }
    if (!placed) continue;
    if (placed.form.kind === 'line' && handle.kind === 'linear' && handle.chain) {
      const { form, key, node } = placed;
      const seen: [P2, P2] = [eye.project(form.from)!, eye.project(form.to)!];
      form.more = chainOf(handle, { form, key, node, seen, cost: 0 }, all, eye);
    }
    out.push(placed);
  }
  return out;
}
