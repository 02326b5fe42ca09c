// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Boxes of scopes: lines with axes for the selection, plain lines for many, dashes and a breath of
// colour for what a step has replaced.

import * as THREE from 'three';

export interface ScopeBox {
  /** Twelve numbers: origin, x, y, z. */
  frame: ArrayLike<number>;
  size: ArrayLike<number>;
}

type Point = [number, number, number];

function point(box: ScopeBox, x: number, y: number, z: number): Point {
  const { frame: f } = box;
  return [0, 1, 2].map((i) => f[i]! + f[3 + i]! * x + f[6 + i]! * y + f[9 + i]! * z) as Point;
}

function corner(box: ScopeBox, i: number): Point {
  const { size } = box;
  return point(box, i & 1 ? size[0]! : 0, i & 2 ? size[1]! : 0, i & 4 ? size[2]! : 0);
}

export function corners(box: ScopeBox): Point[] {
  return Array.from({ length: 8 }, (_, i) => corner(box, i));
}

function edges(box: ScopeBox, out: number[]): void {
  for (let i = 0; i < 8; ++i)
    for (const bit of [1, 2, 4])
      if (!(i & bit)) out.push(...corner(box, i), ...corner(box, i | bit));
}

function lines(points: number[], material: THREE.Material): THREE.LineSegments {
  const geometry = new THREE.BufferGeometry().setAttribute(
    'position',
    new THREE.Float32BufferAttribute(points, 3),
  );
  const out = new THREE.LineSegments(geometry, material);
  out.frustumCulled = false;
  return out;
}

const over = (color: THREE.ColorRepresentation, opacity = 1) =>
  new THREE.LineBasicMaterial({ color, opacity, depthTest: false, transparent: true, fog: false });

/** The selection's scope with its axes at the origin. */
export function scopeLines(box: ScopeBox, accent: THREE.Color): THREE.Object3D[] {
  const points: number[] = [];
  edges(box, points);
  const { size } = box;
  const length = Math.max(size[0]!, size[1]!, size[2]!) * 0.25;
  const axis = (x: number, y: number, z: number) => [
    ...point(box, 0, 0, 0),
    ...point(box, x * length, y * length, z * length),
  ];
  return [
    lines(points, over(accent)),
    lines(axis(1, 0, 0), over(0xe0564e)),
    lines(axis(0, 1, 0), over(0x69b545)),
    lines(axis(0, 0, 1), over(0x4f86e0)),
  ];
}

/** The scopes of many shapes in one drawing. */
export function manyScopes(boxes: ScopeBox[], color: THREE.Color): THREE.Object3D {
  const points: number[] = [];
  for (const box of boxes) edges(box, points);
  return lines(
    points,
    new THREE.LineBasicMaterial({ color, transparent: true, opacity: 0.55, fog: false }),
  );
}

const SIDES = [
  0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7,
  1, 7, 3,
];

/** A replaced shape: a dashed box, filled a little. */
export function ghostBox(box: ScopeBox, color: THREE.Color): THREE.Object3D[] {
  const points: number[] = [];
  edges(box, points);
  const dash = Math.max(...Array.from(box.size)) / 40;
  const dashed = lines(
    points,
    new THREE.LineDashedMaterial({
      color,
      dashSize: dash,
      gapSize: dash * 0.8,
      depthTest: false,
      transparent: true,
      fog: false,
    }),
  );
  dashed.computeLineDistances();
  const geometry = new THREE.BufferGeometry().setAttribute(
    'position',
    new THREE.Float32BufferAttribute(corners(box).flat(), 3),
  );
  geometry.setIndex(SIDES);
  const fill = new THREE.Mesh(
    geometry,
    new THREE.MeshBasicMaterial({
      color,
      opacity: 0.1,
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
      fog: false,
    }),
  );
  fill.frustumCulled = false;
  return [dashed, fill];
}

/** Empties a group and frees what it held. */
export function emptyGroup(group: THREE.Group): void {
  group.traverse((o) => {
    if (!(o instanceof THREE.LineSegments || o instanceof THREE.Mesh)) return;
    (o.geometry as THREE.BufferGeometry).dispose();
    (o.material as THREE.Material).dispose();
  });
  group.clear();
}
