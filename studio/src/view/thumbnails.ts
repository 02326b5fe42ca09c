// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Small pictures of derivations, one after the other on one hidden canvas, all with the first one's
// camera, so that they can be compared.

import type { DeriveRequest, EngineClient } from '../lib/client';
import type { DrawList, ModelPreview, Stats } from '../lib/protocol';
import type { Reach } from '../lib/variations';
import { SceneView } from './scene_view';
import { themeColors } from './theme';

export interface Thumbnail {
  picture: ImageBitmap;
  stats: Stats;
}

const LONGEST_WAIT_MS = 4000;
const TEXTURES_MS = 1500;

export class Thumbnails {
  private readonly view: SceneView;
  private pending = 0;
  private derivation = 0;
  private queue: Promise<unknown> = Promise.resolve();
  private readonly abort = new AbortController();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly client: EngineClient,
  ) {
    this.view = new SceneView(canvas, true);
    this.view.setColors(themeColors());
    this.view.pictures.load = async (path) => {
      ++this.pending;
      try {
        return await client.texture(this.derivation, path);
      } finally {
        --this.pending;
      }
    };
  }

  /** The box of what a request derives to; null where there is nothing. */
  async measure(request: DeriveRequest): Promise<Reach | null> {
    const next = this.queue.then(() => this.client.derive(request, this.abort.signal));
    this.queue = next.catch(() => undefined);
    const { derived } = await next;
    return derived.stats && derived.stats.leaves > 0 ? derived.stats.bbox : null;
  }

  /**
   * A picture of what a request derives to, seen so that `reach` fits in; null where there is
   * nothing. One at a time.
   */
  draw(request: DeriveRequest, reach: Reach | null): Promise<Thumbnail | null> {
    const next = this.queue.then(() => this.drawNow(request, reach));
    this.queue = next.catch(() => undefined);
    return next;
  }

  /** A picture of a model as it is in its file. */
  drawModel(model: ModelPreview): Promise<ImageBitmap> {
    const next = this.queue.then(() =>
      this.picture(model.draw, model.stats, model.derivation, model.stats.bbox),
    );
    this.queue = next.catch(() => undefined);
    return next;
  }

  private async drawNow(request: DeriveRequest, reach: Reach | null): Promise<Thumbnail | null> {
    const { derived, draw } = await this.client.derive(request, this.abort.signal);
    if (!draw || !derived.stats) return null;
    const { stats } = derived;
    return { picture: await this.picture(draw, stats, derived.derivation ?? 0, reach), stats };
  }

  private async picture(
    draw: DrawList,
    stats: Stats,
    derivation: number,
    reach: Reach | null,
  ): Promise<ImageBitmap> {
    this.derivation = derivation;
    const first = this.untilDrawn();
    await this.view.setModel(draw, stats.bbox);
    if (reach) this.view.frameBox(reach, true);
    await first;
    const deadline = performance.now() + TEXTURES_MS;
    while (this.pending > 0 && performance.now() < deadline) await this.untilDrawn(200);
    return createImageBitmap(this.canvas);
  }

  private untilDrawn(most = LONGEST_WAIT_MS): Promise<void> {
    return new Promise((resolve) => {
      const timer = window.setTimeout(resolve, most);
      this.view.drawn = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }

  dispose(): void {
    this.abort.abort();
    this.view.dispose();
  }
}
