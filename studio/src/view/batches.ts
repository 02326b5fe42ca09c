// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Batches of a draw list as meshes, and the materials that write data instead of colours.

import * as THREE from 'three';
import type { Piece } from '../lib/chunks';
import type { Batch } from '../lib/protocol';
import { heightMaterial, leafMaterial, steppedShadow, type Marks } from './shading';

export interface Batched {
  mesh: THREE.Mesh;
  plain: THREE.Material;
  /** Writes the number of the leaf. */
  leaf: THREE.Material;
  pieces?: Piece[] | undefined;
}

export class BatchMaker {
  private readonly leafMerged: THREE.ShaderMaterial;
  private readonly leafInstanced: THREE.ShaderMaterial;
  private readonly steppedMerged: THREE.ShaderMaterial;
  private readonly steppedInstanced: THREE.ShaderMaterial;
  private readonly steppedShadow: THREE.MeshDepthMaterial;
  private readonly heightMerged = heightMaterial(false);
  private readonly heightInstanced = heightMaterial(true);

  constructor(marks: Marks) {
    this.leafMerged = leafMaterial(false, marks);
    this.leafInstanced = leafMaterial(true, marks);
    this.steppedMerged = leafMaterial(false, marks, true);
    this.steppedInstanced = leafMaterial(true, marks, true);
    this.steppedShadow = steppedShadow(marks);
  }

  /** `lives`: see SceneView.setModel. */
  make(batch: Batch, plain: THREE.Material, lives: Float32Array | null): Batched {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(batch.position, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(batch.normal, 3));
    if (batch.uv) geometry.setAttribute('uv', new THREE.BufferAttribute(batch.uv, 2));
    geometry.setIndex(new THREE.BufferAttribute(batch.index, 1));
    let mesh: THREE.Mesh;
    if (batch.matrix) {
      geometry.setAttribute('tint', new THREE.InstancedBufferAttribute(batch.color, 4, true));
      geometry.setAttribute('leaf', new THREE.InstancedBufferAttribute(batch.leaf, 1));
      const many = new THREE.InstancedMesh(geometry, plain, batch.leaf.length);
      many.instanceMatrix = new THREE.InstancedBufferAttribute(batch.matrix, 16);
      mesh = many;
    } else {
      geometry.setAttribute('tint', new THREE.BufferAttribute(batch.color, 4, true));
      geometry.setAttribute('leaf', new THREE.BufferAttribute(batch.leaf, 1));
      mesh = new THREE.Mesh(geometry, plain);
    }
    mesh.frustumCulled = false;
    if (lives) this.addLives(mesh, batch, lives);
    mesh.castShadow = !plain.transparent;
    mesh.receiveShadow = true;
    return { mesh, plain, leaf: this.leafOf(!!batch.matrix, !!lives), pieces: batch.pieces };
  }

  /** Writes how high a surface is above `base`, of `range` metres. */
  heights(base: number, range: number): (b: Batched) => THREE.Material {
    for (const m of [this.heightMerged, this.heightInstanced]) {
      m.uniforms.base!.value = base;
      m.uniforms.range!.value = range;
    }
    return (b) =>
      b.mesh instanceof THREE.InstancedMesh ? this.heightInstanced : this.heightMerged;
  }

  private addLives(mesh: THREE.Mesh, batch: Batch, lives: Float32Array): void {
    const life = new Float32Array(batch.leaf.length * 2);
    for (let i = 0; i < batch.leaf.length; ++i) {
      life[i * 2] = lives[batch.leaf[i]! * 2] ?? 0;
      life[i * 2 + 1] = lives[batch.leaf[i]! * 2 + 1] ?? 1e9;
    }
    const attribute = batch.matrix
      ? new THREE.InstancedBufferAttribute(life, 2)
      : new THREE.BufferAttribute(life, 2);
    mesh.geometry.setAttribute('life', attribute);
    mesh.customDepthMaterial = this.steppedShadow;
  }

  private leafOf(instanced: boolean, stepped: boolean): THREE.Material {
    if (stepped) return instanced ? this.steppedInstanced : this.steppedMerged;
    return instanced ? this.leafInstanced : this.leafMerged;
  }
}
