// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From one point to another, in metres and degrees; y is up.

export type Point3 = [number, number, number];

export interface Lengths {
  length: number;
  /** On the ground. */
  across: number;
  /** Below zero for down. */
  up: number;
  /** Degrees from level, 0 to 90. */
  slope: number;
}

export function lengths(from: Point3, to: Point3): Lengths {
  const [x, up, z] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  const across = Math.hypot(x, z);
  return {
    length: Math.hypot(across, up),
    across,
    up,
    slope: (Math.atan2(Math.abs(up), across) * 180) / Math.PI,
  };
}
