// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lights: the sun and the sky of the view, as three suns of which one shines. The first is where a
// person put it; its shadows are drawn when the model or the sun has changed, not when the camera
// moves. The second is the same with coarse shadows, for a model that changes just now. The third
// goes about while a still picture is refined.

import * as THREE from 'three';

const SUNLIGHT = 0xfff1dc;
/** Texels of coarse shadows each way. */
const COARSE = 512;
const SKYLIGHT = 0xe6eef4;

/** The i-th number of the radical inverse sequence: evenly spread however many are taken. */
export function spread(i: number, base: number): number {
  let out = 0;
  for (let f = 1 / base, n = i; n > 0; n = Math.floor(n / base), f /= base) out += f * (n % base);
  return out;
}

export class Lights {
  readonly group = new THREE.Group();
  private readonly still = new THREE.DirectionalLight(SUNLIGHT, 2.9);
  private readonly coarse = new THREE.DirectionalLight(SUNLIGHT, 2.9);
  private readonly moving = new THREE.DirectionalLight(SUNLIGHT, 2.9);
  private readonly sky = new THREE.HemisphereLight(0xe4edf4, 0x9a948a, 1.7);
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
    this.shine(this.still, 1.7);
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
    this.angles = { elevation, azimuth };
    for (const sun of [this.still, this.coarse]) this.place(sun, this.direction());
  }

  /** Towards the sun, moved by so many degrees. */
  direction(higher = 0, aside = 0): THREE.Vector3 {
    const e = ((this.angles.elevation + higher) * Math.PI) / 180;
    const a = ((this.angles.azimuth + aside) * Math.PI) / 180;
    return new THREE.Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
  }

  /** The light of the first picture; `soon`: coarse shadows do where the fine ones are stale. */
  first(soon: boolean): void {
    this.shine(soon && this.cheap && this.still.shadow.needsUpdate ? this.coarse : this.still, 1.7);
  }

  /** Whether the edges of shadows are soft, where a processor pays for that. */
  soften(on: boolean): void {
    if (this.cheap) this.still.shadow.radius = on ? 1 : 0;
  }

  private shine(which: THREE.DirectionalLight, sky: number): void {
    for (const sun of [this.still, this.coarse, this.moving]) sun.visible = sun === which;
    this.sky.intensity = sky;
  }

  /**
   * The light of the i-th pass of a still picture. Four passes in ten look from the sun, spread
   * over its disc; the others are light of the sky.
   */
  pass(i: number): void {
    const fromSun = i % 5 < 2;
    this.place(
      this.moving,
      fromSun ? this.direction((spread(i, 5) - 0.5) * 2.4, (spread(i, 7) - 0.5) * 2.4) : inSky(i),
    );
    this.shine(this.moving, 0.5);
    this.moving.color.set(fromSun ? SUNLIGHT : SKYLIGHT);
    this.moving.intensity = fromSun ? 2.9 * 2.1 : 2.9;
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

function inSky(i: number): THREE.Vector3 {
  const y = Math.sqrt(0.03 + 0.95 * spread(i, 2));
  const a = 2 * Math.PI * spread(i, 3);
  const r = Math.sqrt(1 - y * y);
  return new THREE.Vector3(Math.sin(a) * r, y, Math.cos(a) * r);
}
