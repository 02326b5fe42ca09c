// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Surroundings: what a model stands in. The ground, the sky over it, the haze between, and the
// lights, all of them as large as the model needs them.

import * as THREE from 'three';
import { WIDE } from './framing';
import { Ground } from './ground';
import { skyMaterial } from './shading';
import { Lights } from './sun';

export interface ViewColors {
  ground: string;
  line: string;
  accent: string;
  text: string;
  ghost: string;
  /** The sky over the place, where it is shown. */
  zenith: string;
  horizon: string;
}

/** The horizon where the sun goes down. */
const DUSK = new THREE.Color(0xf0a062);
/** Metres, until a model is there. */
const FOG = { near: 100, far: 1000 };

export class Surroundings {
  readonly lights: Lights;
  readonly ground: Ground;
  /** What is seen behind a model, and is the same in each part of a picture. */
  readonly backdrop: THREE.Object3D[];

  private readonly dome = new THREE.Mesh(new THREE.SphereGeometry(1, 32, 16), skyMaterial());
  private readonly groundColor = new THREE.Color();
  private readonly horizonColor = new THREE.Color();
  private readonly zenithColor = new THREE.Color();
  /** Of the theme; what is shown of it depends on the time of day. */
  private colors: ViewColors | null = null;
  private sky = false;

  /** `cheap`: shadows for a machine without a graphics card. */
  constructor(
    private readonly scene: THREE.Scene,
    cheap: boolean,
  ) {
    this.lights = new Lights(cheap);
    this.ground = new Ground(this.lights.scatter);
    this.dome.frustumCulled = false;
    this.dome.renderOrder = -10;
    this.dome.visible = false;
    this.backdrop = [this.dome, this.ground.group];
    scene.add(this.dome, this.lights.group, this.ground.group);
  }

  setColors(colors: ViewColors): void {
    this.colors = colors;
    this.dome.material.uniforms.horizon!.value = this.horizonColor;
    this.dome.material.uniforms.zenith!.value = this.zenithColor;
    this.showAir();
  }

  /** What lies behind the model, at this time of day. */
  private showAir(): void {
    if (!this.colors) return;
    const { air, glow } = this.lights.day;
    const { uniforms } = this.dome.material;
    this.ground.setColors(this.groundColor.set(this.colors.ground), this.colors.line, air);
    this.groundColor.multiplyScalar(air);
    this.zenithColor.set(this.colors.zenith).multiplyScalar(air);
    this.horizonColor
      .set(this.colors.horizon)
      .multiplyScalar(air)
      .lerp(DUSK, 0.6 * glow * air);
    uniforms.disc!.value = this.lights.day.moon ? 0 : Math.min(1, air);
    this.setSky(this.sky);
  }

  /** With the sky the ground fades into the horizon; without, into a ground without end. */
  setSky(on: boolean): void {
    this.sky = on;
    this.dome.visible = on;
    const far = on ? this.horizonColor : this.groundColor;
    this.scene.background = far;
    const { near, far: reach } = this.scene.fog instanceof THREE.Fog ? this.scene.fog : FOG;
    this.scene.fog = new THREE.Fog(far, near, reach);
  }

  /** `within`: the camera stands in the place. */
  fitGround(centre: THREE.Vector3, radius: number, lowest: number, within: boolean): void {
    this.ground.fit(centre, radius, lowest);
    if (!(this.scene.fog instanceof THREE.Fog)) return;
    // Who stands in a place looks into the haze; who turns it does not have it between.
    this.scene.fog.near = radius * (this.sky && within ? 2.5 : this.sky ? 4 : 5);
    this.scene.fog.far = radius * (this.sky ? 12 : 22);
  }

  fitSun(centre: THREE.Vector3, radius: number): void {
    this.lights.fit(centre, radius, radius > WIDE);
    this.showSun();
  }

  /** In degrees, as a compass has them. */
  setSun(elevation: number, azimuth: number): void {
    this.lights.turn(elevation, azimuth);
    this.showAir();
    this.showSun();
  }

  private showSun(): void {
    (this.dome.material.uniforms.sun!.value as THREE.Vector3).copy(this.lights.direction());
  }
}
