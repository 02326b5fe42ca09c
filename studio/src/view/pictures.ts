// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures: textures by their paths, each loaded once. Few are asked for at a time, so that a
// derivation never waits behind them.

import * as THREE from 'three';

const AT_ONCE = 2;

export class Pictures {
  load: ((path: string) => Promise<Blob>) | null = null;
  private known = new Map<string, Promise<THREE.Texture | null>>();
  private readonly laid = new Map<string, THREE.Texture>();
  private running = 0;
  private readonly waiting: (() => void)[] = [];

  /** A picture laid out by su, sv, tu, tv, rw; at once where it was laid out so before. */
  placed(
    path: string,
    uv: readonly number[] = [1, 1, 0, 0, 0],
  ): THREE.Texture | Promise<THREE.Texture | null> {
    const key = `${path} ${uv.join(' ')}`;
    return this.laid.get(key) ?? this.lay(path, uv, key);
  }

  private async lay(
    path: string,
    uv: readonly number[],
    key: string,
  ): Promise<THREE.Texture | null> {
    const picture = await this.get(path);
    if (!picture) return null;
    const texture = this.laid.get(key) ?? picture.clone();
    texture.repeat.set(uv[0] ?? 1, uv[1] ?? 1);
    texture.offset.set(uv[2] ?? 0, uv[3] ?? 0);
    texture.rotation = ((uv[4] ?? 0) * Math.PI) / 180;
    texture.needsUpdate = true;
    this.laid.set(key, texture);
    return texture;
  }

  /** Null where there is no such picture: without it a face keeps its colour. */
  private get(path: string): Promise<THREE.Texture | null> {
    let found = this.known.get(path);
    if (!found) {
      found = this.fetch(path);
      this.known.set(path, found);
    }
    return found;
  }

  clear(): void {
    this.known = new Map();
    this.laid.clear();
  }

  private async fetch(path: string): Promise<THREE.Texture | null> {
    if (this.running >= AT_ONCE) await new Promise<void>((go) => this.waiting.push(go));
    ++this.running;
    try {
      if (!this.load) return null;
      const picture = await createImageBitmap(await this.load(path), { imageOrientation: 'flipY' });
      const texture = new THREE.Texture(picture);
      texture.flipY = false;
      texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
      texture.colorSpace = THREE.SRGBColorSpace;
      texture.generateMipmaps = true;
      texture.anisotropy = 4;
      return texture;
    } catch {
      this.known.delete(path);
      return null;
    } finally {
      --this.running;
      this.waiting.shift()?.();
    }
  }
}
