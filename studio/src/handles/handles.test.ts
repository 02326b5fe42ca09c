// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { describe, expect, it } from 'vitest';
import type { Field } from '../lib/fields';
import type { AttributeInfo, RuleInfo, Tree } from '../lib/protocol';
import { Shapes } from '../lib/tree';
import { handlesOf, shapesOf, type Handle } from './annotation';
import { alongLine, hull, inHull, onPlane, unit, type Box, type Eye, type P3 } from './geometry';
import { outlineOf, placeAll, type Line, type Spot } from './placing';
import { allowed, label, lengthFor, valueFor } from './values';

/** Looks along -z from a height, with a picture of 800 by 600. */
function eyeAt(position: P3): Eye {
  const scale = 800;
  return {
    position,
    width: 800,
    height: 600,
    project: ([x, y, z]) => {
      const depth = position[2] - z;
      if (depth <= 0) return null;
      return {
        x: 400 + ((x - position[0]) / depth) * scale,
        y: 300 - ((y - position[1]) / depth) * scale,
      };
    },
    ray: ({ x, y }) => unit([(x - 400) / scale, (300 - y) / scale, -1]),
  };
}
const FIELD: Field = {
  name: 'h',
  label: 'h',
  doc: '',
  type: 'float',
  control: { kind: 'number', unit: 'm', min: 1, max: 20 },
  group: '',
};
const note = (...args: [string, string][]) => ({ name: 'Handle', arguments: args });
const attribute = (...notes: ReturnType<typeof note>[]): AttributeInfo => ({
  name: 'h',
  type: 'float',
  hidden: false,
  annotations: notes,
});
function handle(...args: [string, string][]): Handle {
  return handlesOf([attribute(note(['shape', 'Mass'], ...args))], [FIELD])[0]!;
}
const BOX: Box = {
  origin: [-5, 0, -10],
  axes: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  size: [10, 8, 10],
};
const place = (h: Handle[], eye: Eye, boxes = [BOX], hidden = new Set<string>()) =>
  placeAll(h, () => boxes.map((box, node) => ({ node, box })), eye, outlineOf(eye, BOX), hidden);
const line = (of: ReturnType<typeof place>, i = 0) => of[i]!.form as Line;

describe('annotations', () => {
  it('are read, with what is not written', () => {
    expect(handle()).toMatchObject({
      id: 'h 0',
      rule: 'Mass',
      parameters: 0,
      leaf: false,
      kind: 'linear',
      axis: 1,
      reference: 'edges',
      align: 'default',
      slip: 'scope',
      occlusion: true,
      chain: true,
    });
    const [one] = handlesOf(
      [
        attribute(
          note(
            ['shape', 'Box*^3'],
            ['axis', 'z'],
            ['slip', '{inside,-1}'],
            ['translate', '{0,-0.5,1}'],
            ['repeat', 'none'],
            ['skin', 'diameterArrow'],
            ['color', '#6666ffff'],
            ['occlusion', 'false'],
          ),
        ),
      ],
      [FIELD],
    );
    expect(one).toMatchObject({
      rule: 'Box',
      parameters: 3,
      leaf: true,
      axis: 2,
      slip: 'inside',
      translate: [0, -0.5, 1],
      chain: false,
      bothEnds: true,
      color: '#6666ff',
      occlusion: false,
    });
  });
  it('without effect: no shape, a kind that does not fit, an attribute that is not offered', () => {
    const none = (a: AttributeInfo, fields = [FIELD]) => expect(handlesOf([a], fields)).toEqual([]);
    none(attribute(note(['axis', 'y'])));
    none(attribute(note(['shape', 'A'], ['type', 'toggle'])));
    none(attribute(note(['shape', 'A'])), []);
    expect(
      handlesOf([attribute(note(['shape', 'A']), note(['shape', 'B']))], [FIELD]),
    ).toHaveLength(2);
  });
  it('find the shapes of their rule, with its parameters, in the lot', () => {
    const count = 4;
    const column = (...n: number[]) => Uint32Array.from(n);
    const tree = {
      count,
      names: ['Lot', 'Mass', 'Box'],
      parent: column(0xffffffff, 0, 0xffffffff, 1),
      name: column(0, 1, 1, 2),
      shape: column(0, 0, 1, 0),
      flags: column(4, 4, 4, 1),
      firstLeaf: column(0, 0, 1, 0),
    } as unknown as Tree;
    const rules = [{ name: 'a.Mass', parameters: 0 } as RuleInfo];
    const find = (h: Handle, lot: number) => shapesOf([h], new Shapes(tree), rules, lot).get(h.id);
    expect(find(handle(), 0)).toEqual([1]);
    expect(find(handle(), -1)).toEqual([1, 2]);
    expect(find({ ...handle(), parameters: 2 }, 0)).toEqual([]);
    expect(find({ ...handle(), rule: 'Gone' }, 0)).toEqual([]);
    expect(find({ ...handle(), rule: 'Box', leaf: true }, 0)).toEqual([3]);
    expect(find({ ...handle(), leaf: true }, 0)).toEqual([]);
  });
});

describe('places', () => {
  const eye = eyeAt([0, 4, 40]);
  it('lie outside of the model, on the side that is wished', () => {
    const outline = outlineOf(eye, BOX);
    for (const align of ['left', 'right']) {
      const placed = place([handle(['align', align])], eye);
      const { from, to } = line(placed);
      const p = eye.project([from[0], (from[1] + to[1]) / 2, from[2]])!;
      expect(inHull(outline, p, 0)).toBe(false);
      expect(p.x < 400).toBe(align === 'left');
    }
  });
  it('measure along the axis', () => {
    const [x, y] = place([handle(['axis', 'x']), { ...handle(), id: 'y' }], eye);
    expect((x!.form as Line).length).toBeCloseTo(10);
    expect((y!.form as Line).length).toBeCloseTo(8);
  });
  it('are out of the way of each other, and of what is hidden', () => {
    const two = place([handle(['align', 'left']), { ...handle(['align', 'left']), id: 'b' }], eye);
    expect(line(two, 1).from[0]).toBeLessThan(line(two, 0).from[0] - 0.3);
    const first = place([handle()], eye)[0]!;
    const next = place([handle()], eye, [BOX], new Set([first.key]))[0]!;
    expect(next.key).not.toBe(first.key);
  });
  it('are left out where they are too small, behind the camera or out of sight', () => {
    expect(place([handle()], eyeAt([0, 4, 4000]))).toEqual([]);
    expect(place([handle()], eyeAt([0, 4, -100]))).toEqual([]);
    expect(place([handle()], eyeAt([500, 4, 40]))).toEqual([]);
    expect(place([handle()], eye, [])).toEqual([]);
  });
  it('go on as a chain along one line', () => {
    const floors = [0, 1, 2].map((i): Box => ({
      ...BOX,
      origin: [-5, i * 3, -10],
      size: [10, 3, 10],
    }));
    expect(line(place([handle()], eye, floors)).more).toHaveLength(2);
    expect(line(place([handle(['repeat', 'none'])], eye, floors)).more).toEqual([]);
  });
  it('begin at the origin, the middle or the axis', () => {
    const inside: [string, string] = ['slip', 'inside'];
    expect(line(place([handle(['reference', 'origin'], inside)], eye)).from).toEqual([-5, 0, -10]);
    expect(line(place([handle(['reference', 'center'], inside)], eye)).from).toEqual([0, 0, -5]);
    const radial = line(place([handle(['reference', 'radial'], ['align', 'topLeft'])], eye));
    expect(radial.from).toEqual([0, 8, -5]);
    expect(radial.to[0]).toBeCloseTo(-5);
    expect(radial.length).toBeCloseTo(5);
  });
  it('of what is pressed stay in the picture', () => {
    const toggle: Handle = { ...handle(['align', 'left']), kind: 'toggle' };
    const [near] = place([toggle], eyeAt([0, 4, 3]));
    const { at } = near!.form as Spot;
    expect(at.x).toBeGreaterThan(0);
    const [placed] = place([toggle], eye);
    expect((placed!.form as Spot).at.x).toBeLessThan(400);
  });
});

describe('values', () => {
  it('grow with lengths', () => {
    expect(valueFor(handle(), 8, 8, 2)).toBe(10);
    expect(valueFor(handle(), 4, 12, 3)).toBe(5);
    expect(valueFor(handle(), 0, 12, 3)).toBe(3);
    expect(valueFor(handle(), 4, 12, -99)).toBe(0);
    expect(lengthFor(12, 4, 5)).toBe(15);
    expect(lengthFor(12, 0, 5)).toBe(12);
  });
  it('are those that the attribute may have', () => {
    expect(allowed(FIELD, 25.03, 0.1, false)).toBe(20);
    expect(allowed(FIELD, 9.037, 0.1, false)).toBeCloseTo(9);
    expect(allowed(FIELD, 9.037, 0.1, true)).toBeCloseTo(9.04);
    const free = { ...FIELD, control: { ...FIELD.control, free: true } as Field['control'] };
    expect(allowed(free, 25.03, 0.1, false)).toBe(25);
    const choice: Field = {
      ...FIELD,
      control: { kind: 'choice', choices: ['10', '20', '30'], free: false },
    };
    expect(allowed(choice, 23, 1, false)).toBe(20);
  });
  it('are told with the length where that is another number', () => {
    expect(label(FIELD, 9, 9)).toBe('9\u2009m');
    expect(label(FIELD, 4, 12.8)).toBe('4\u2009m (12.8\u2009m)');
  });
});

it('finds points of lines and planes under a pixel', () => {
  const eye = eyeAt([0, 4, 40]);
  const at = eye.project([5, 6, 0])!;
  expect(alongLine(eye, [5, 0, 0], [0, 1, 0], at)).toBeCloseTo(6);
  expect(alongLine(eye, [0, 4, 0], [0, 0, 1], { x: 400, y: 300 })).toBeNull();
  expect(onPlane(eye, [0, 0, 0], [0, 0, 1], at)![0]).toBeCloseTo(5);
  expect(onPlane(eye, [0, 0, 80], [0, 0, 1], at)).toBeNull();
  const square = hull([0, 10, 5].flatMap((x) => [0, 10, 5].map((y) => ({ x, y }))));
  expect(square).toHaveLength(4);
  expect(inHull(square, { x: 5, y: 5 }, 0)).toBe(true);
  expect(inHull(square, { x: 12, y: 5 }, 1)).toBe(false);
  expect(inHull(square, { x: 12, y: 5 }, 3)).toBe(true);
});
