// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lights: the sun and the sky of the view, as three suns of which one shines. The first is where a
// person put it, or the moon at night; its shadows are drawn when the model or the sun has changed,
// not when the camera moves. The second is the same with coarse shadows, for a model that changes
// just now. The third goes about while a still picture is refined.

import * as THREE from 'three';
import { daylight } from './daylight';

const GROUNDLIGHT = 0x9a948a;
/** Degrees above the horizon: the moon. */
const MOON = 38;
/** How much of the light of the sky comes from places in it once a picture is refined. */
const FROM_PLACES = 0.7;
/** A place in the sky stands for much of it: its shadow on the ground has no edge. */
const SCATTER = 0.07;
/** Passes of a still picture come in groups; in each these look from the sun. */
const GROUP = 10;
const SUN_PASSES = new Set([1, 4, 8]);
const SUN_SHARE = SUN_PASSES.size / GROUP;
/** Texels of coarse shadows each way. */
const COARSE = 512;

/** The i-th number of the radical inverse sequence: evenly spread however many are taken. */
export function spread(i: number, base: number): number {
  let out = 0;
  for (let f = 1 / base, n = i; n > 0; n = Math.floor(n / base), f /= base) out += f * (n % base);
  return out;
}

export class Lights {
  readonly group = new THREE.Group();
  /** How far apart, as a share of the shadows' width, the ground looks for its shadow. */
  readonly scatter = { value: 0 };
  /** What the light of the time of day is. */
  day = daylight(44);
  private readonly still = new THREE.DirectionalLight();
  private readonly coarse = new THREE.DirectionalLight();
  private readonly moving = new THREE.DirectionalLight();
  private readonly sky = new THREE.HemisphereLight(0xffffff, GROUNDLIGHT);
  private angles = { elevation: 44, azimuth: -28 };
  private centre = new THREE.Vector3();
  private radius = 10;

  /** `cheap`: on a processor shadows are to cost little. */
  constructor(private readonly cheap: boolean) {
    for (const sun of [this.still, this.coarse, this.moving]) {
      sun.castShadow = true;
      sun.shadow.autoUpdate = false;
      sun.shadow.bias = -0.0004;
      if (cheap) sun.shadow.radius = 0;
      sun.shadow.mapSize.set(cheap ? 1024 : 2048, cheap ? 1024 : 2048);
      this.group.add(sun, sun.target);
    }
    this.coarse.shadow.mapSize.set(COARSE, COARSE);
    this.group.add(this.sky);
    this.shine(this.still);
  }

  /** Metres of a texel of the shadows. */
  get texel(): number {
    return (2 * this.radius) / (this.coarse.visible ? this.coarse : this.still).shadow.mapSize.x;
  }

  /** The shadows of the sun that shines are to be drawn. */
  get stale(): boolean {
    return (this.coarse.visible ? this.coarse : this.still).shadow.needsUpdate;
  }

  /** The model has changed. */
  forget(): void {
    this.still.shadow.needsUpdate = this.coarse.shadow.needsUpdate = true;
  }

  /** What the shadows are to cover, in metres; a place needs finer ones than a building. */
  fit(centre: THREE.Vector3, radius: number, place: boolean): void {
    this.centre = centre;
    this.radius = radius * 1.08;
    const size = this.cheap && !place ? 1024 : 2048;
    if (this.still.shadow.mapSize.x !== size) {
      this.still.shadow.mapSize.set(size, size);
      this.still.shadow.map?.dispose();
      this.still.shadow.map = null;
    }
    for (const sun of [this.still, this.coarse]) this.place(sun, this.direction());
  }

  turn(elevation: number, azimuth: number): void {
    this.day = daylight(elevation);
    this.angles = this.day.moon
      ? { elevation: MOON, azimuth: azimuth + 180 }
      : { elevation: Math.max(1, elevation), azimuth };
    this.shine(this.still);
    for (const sun of [this.still, this.coarse]) this.place(sun, this.direction());
  }

  /** Towards what shines, moved by so many degrees. */
  direction(higher = 0, aside = 0): THREE.Vector3 {
    const e = ((this.angles.elevation + higher) * Math.PI) / 180;
    const a = ((this.angles.azimuth + aside) * Math.PI) / 180;
    return new THREE.Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
  }

  /** The light of the first picture; `soon`: coarse shadows do where the fine ones are stale. */
  first(soon: boolean): void {
    this.shine(soon && this.cheap && this.still.shadow.needsUpdate ? this.coarse : this.still);
  }

  /** Whether the edges of shadows are soft, where a processor pays for that. */
  soften(on: boolean): void {
    if (this.cheap) this.still.shadow.radius = on ? 1 : 0;
  }

  private shine(which: THREE.DirectionalLight): void {
    for (const sun of [this.still, this.coarse, this.moving]) sun.visible = sun === which;
    for (const sun of [this.still, this.coarse]) {
      sun.color.copy(this.day.light);
      sun.intensity = this.day.strength;
    }
    this.sky.color.copy(this.day.sky);
    this.sky.intensity = this.day.skyStrength;
    this.scatter.value = 0;
  }

  /**
   * The light of the i-th pass of a still picture, from 1. Three passes in ten look from the sun,
   * spread over its disc, the others from a place in the sky. What no shadow falls on is as bright
   * on their average as in the first picture.
   */
  pass(i: number): void {
    const fromSun = SUN_PASSES.has((i - 1) % GROUP);
    const to = fromSun
      ? this.direction((spread(i, 5) - 0.5) * 2.4, (spread(i, 7) - 0.5) * 2.4)
      : inSky(i - 1);
    this.place(this.moving, to);
    this.shine(this.moving);
    const { light, strength, sky, skyStrength } = this.day;
    this.moving.color.copy(fromSun ? light : sky);
    this.moving.intensity = fromSun
      ? strength / SUN_SHARE
      : (skyStrength * FROM_PLACES * 2) / (1 - SUN_SHARE);
    this.sky.color.copy(sky).multiplyScalar(1 - FROM_PLACES);
    this.scatter.value = fromSun ? 0 : SCATTER;
  }

  private place(sun: THREE.DirectionalLight, to: THREE.Vector3): void {
    const r = this.radius;
    sun.position.copy(this.centre).addScaledVector(to, r * 3);
    sun.target.position.copy(this.centre);
    const camera = sun.shadow.camera;
    camera.left = camera.bottom = -r;
    camera.right = camera.top = r;
    camera.near = r;
    camera.far = r * 5;
    camera.updateProjectionMatrix();
    sun.shadow.normalBias = r / 700;
    sun.shadow.needsUpdate = true;
  }
}

/**
 * A place in the sky, all of which is equally bright. The heights of each group are spread evenly,
 * so that every group gives a level surface what the sky as a whole gives it; the first group is
 * shown by itself.
 */
function inSky(i: number): THREE.Vector3 {
  const group = Math.floor(i / GROUP);
  const inGroup = i % GROUP;
  const before = [...SUN_PASSES].filter((s) => s < inGroup).length;
  const each = GROUP - SUN_PASSES.size;
  const moved = group ? spread(group, 2) : 0.5;
  const y = (inGroup - before + moved) / each;
  const a = Math.PI * (3 - Math.sqrt(5)) * (group * each + inGroup - before);
  const r = Math.sqrt(1 - y * y);
  return new THREE.Vector3(Math.sin(a) * r, y, Math.cos(a) * r);
}
