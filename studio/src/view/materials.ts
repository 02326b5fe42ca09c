// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Materials: those of the looks of a model. They stay from one model to the next: a material that
// nothing uses any more takes its program along, and to build that again costs more than all else
// of a keystroke.

import * as THREE from 'three';
import type { Look } from '../lib/protocol';
import { Pictures } from './pictures';
import { lookMaterial, type Marks } from './shading';

const MOST = 400;

export class Materials {
  readonly pictures = new Pictures();
  private readonly known = new Map<string, THREE.MeshLambertMaterial>();

  /** `arrived` is called when a picture comes in after the material was asked for. */
  constructor(
    private readonly marks: Marks,
    private readonly arrived: () => void,
  ) {}

  of(look: Look, stepped: boolean): THREE.MeshLambertMaterial {
    const key = JSON.stringify([look, stepped]);
    const known = this.known.get(key);
    if (known) return known;
    if (this.known.size >= MOST) this.known.clear();
    const material = lookMaterial(look, this.marks, stepped);
    this.known.set(key, material);
    if (look.map) void this.applyTexture(material, look);
    return material;
  }

  /** Files have changed: pictures are loaded again. */
  clear(): void {
    this.pictures.clear();
    this.known.clear();
  }

  private async applyTexture(material: THREE.MeshLambertMaterial, look: Look): Promise<void> {
    const placed = this.pictures.placed(look.map ?? '', look.uv);
    const texture = placed instanceof THREE.Texture ? placed : await placed;
    if (!texture) return;
    material.map = texture;
    material.needsUpdate = true;
    if (!(placed instanceof THREE.Texture)) this.arrived();
  }
}
