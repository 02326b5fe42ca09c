// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Daylight: how bright and of which colour sun and sky are, by the height of the sun. Above 28
// degrees all is as at noon; then the sun turns yellow and red, the sky goes when it is below the
// horizon, and at night the moon shines and rooms are lit.

import * as THREE from 'three';

export interface Daylight {
  /** What shines: the sun, or the moon below the horizon. */
  moon: boolean;
  light: THREE.Color;
  /** How bright that is, and the sky. */
  strength: number;
  sky: THREE.Color;
  skyStrength: number;
  /** How bright what is behind the model is, of full daylight, and how red its horizon. */
  air: number;
  glow: number;
  /** The share of rooms behind glass with light in them. */
  lit: number;
}

const SUNLIGHT = new THREE.Color(0xfff1dc);
const LOW_SUN = new THREE.Color(0xff9a4a);
const MOONLIGHT = new THREE.Color(0xa9c0ea);
const SKYLIGHT = new THREE.Color(0xe4edf4);
const NIGHT_SKY = new THREE.Color(0x5d78b0);
/** At noon. */
const SUN = 2.9;
const SKY = 1.7;
const MOON = 0.7;
const NIGHT = 0.5;
/** As in pictures of the night. */
const MOST_LIT = 0.4;

/** From 0 to 1 between two heights, smoothly. */
function between(low: number, high: number, elevation: number): number {
  return THREE.MathUtils.smoothstep(elevation, low, high);
}

/** `elevation` of the sun, in degrees above the horizon. */
export function daylight(elevation: number): Daylight {
  const moon = elevation < -2;
  const direct = between(-2, 10, elevation);
  const day = between(-12, 8, elevation);
  const dark = 1 - between(-10, -2, elevation);
  return {
    moon,
    light: moon ? MOONLIGHT.clone() : LOW_SUN.clone().lerp(SUNLIGHT, between(0, 28, elevation)),
    strength: moon ? MOON * dark : SUN * direct,
    sky: NIGHT_SKY.clone().lerp(SKYLIGHT, day),
    skyStrength: NIGHT + (SKY - NIGHT) * day,
    air: 0.12 + 0.88 * between(-12, 10, elevation),
    glow: between(-12, -1, elevation) * (1 - between(1, 16, elevation)),
    lit: MOST_LIT * (1 - between(-6, 2, elevation)),
  };
}
