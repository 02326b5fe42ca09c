// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Ground: the plain that a model stands on, with a grid that fades out.

import * as THREE from 'three';
import { groundMaterial, softened } from './shading';

/** Looks for a shadow a little aside, elsewhere at each pixel: passes have no edges in common. */
function scattered(fragmentShader: string): string {
  const lights = THREE.ShaderChunk.lights_fragment_begin.replaceAll(
    'vDirectionalShadowCoord[ i ]',
    'scattered( vDirectionalShadowCoord[ i ] )',
  );
  return (
    `
uniform float scatter;
vec4 scattered(vec4 at) {
  if (scatter == 0.0) return at;
  vec2 seed = gl_FragCoord.xy + 971.0 * at.z;
  vec2 by = vec2(dot(seed, vec2(12.9898, 78.233)), dot(seed, vec2(39.346, 11.135)));
  return at + vec4((fract(sin(by) * 43758.5453) - 0.5) * scatter, 0.0, 0.0);
}
` + fragmentShader.replace('#include <lights_fragment_begin>', lights)
  );
}

export class Ground {
  readonly group = new THREE.Group();
  private readonly plain = new THREE.Mesh(
    new THREE.PlaneGeometry(1, 1),
    new THREE.MeshLambertMaterial(),
  );
  private readonly grid = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), groundMaterial());

  /** `scatter`: see Lights. */
  constructor(scatter: { value: number }) {
    const { plain, grid } = this;
    plain.material.onBeforeCompile = (shader) => {
      shader.uniforms.scatter = scatter;
      shader.fragmentShader = scattered(softened(shader.fragmentShader));
    };
    plain.receiveShadow = true;
    // All of the model is above it, so that it need not hide anything; and nothing flickers.
    plain.material.depthWrite = false;
    plain.renderOrder = -5;
    for (const plane of [plain, grid]) plane.rotation.x = -Math.PI / 2;
    this.group.add(plain, grid);
  }

  get height(): number {
    return this.plain.position.y;
  }

  /** `air`: how bright the grid is, which no light falls on. */
  setColors(ground: THREE.Color, line: string, air: number): void {
    this.plain.material.color.copy(ground).multiplyScalar(1.05);
    (this.grid.material.uniforms.line!.value as THREE.Color).set(line).multiplyScalar(air);
  }

  /** Below a model of a radius, whose lowest point is at `lowest`. */
  fit(centre: THREE.Vector3, radius: number, lowest: number): void {
    const y = Math.min(0, lowest) - Math.max(0.02, radius * 4e-4);
    for (const plane of [this.plain, this.grid]) {
      plane.position.set(centre.x, y, centre.z);
      plane.scale.set(radius * 60, radius * 60, 1);
    }
    this.grid.position.y = y + radius * 1e-4;
    const { uniforms } = this.grid.material;
    (uniforms.centre!.value as THREE.Vector2).set(centre.x, centre.z);
    uniforms.reach!.value = Math.max(30, radius * 2.6);
    uniforms.cell!.value = radius < 12 ? 1 : radius < 250 ? 10 : 100;
  }
}
