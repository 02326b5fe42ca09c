// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Schedule: when pictures are drawn. While something changes they are as fine as they can be in
// time (Pace). Once nothing does for a while they are refined, a step at a time, with room between
// the steps for whatever else the page has to do.

import type { Pace } from './pace';

/** What is drawn, and who hears of it. */
export interface Work {
  /** A new picture with this share of the pixels each way. */
  draw(share: number): void;
  /** The picture can become better. */
  unfinished(): boolean;
  /** One step towards the best picture. */
  refine(): void;
  /** Where steps are slow, fewer have to do. */
  hurry(): void;
  /** After each first picture of a change. */
  drawn(): void;
  /** After a picture of a camera that moves, with the seconds from the drawing of it to its end. */
  timed(seconds: number): void;
  /** The picture is as good as it gets. */
  refined(): void;
}

/**
 * So long nothing changes before a picture is drawn in full: longer than it takes from key to key.
 */
const QUIET_MS = 400;
const SLOW_STEP_MS = 400;

export class Schedule {
  /** A picture is about to be drawn. */
  dirty = false;
  /** The next picture is drawn in full at once. */
  private fine = false;
  /** The camera has moved since the latest picture. */
  private panned = false;
  private frame = 0;
  private quiet = 0;
  private waiting: WebGLSync | null = null;

  /** `posed`: all pictures are in full. */
  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly pace: Pace,
    private readonly posed: boolean,
    private readonly work: Work,
  ) {}

  cameraMoved(): void {
    this.panned = true;
  }

  /**
   * Draws anew; `fine`: what changes does not move, so that the picture may take a little longer.
   */
  redraw(fine = false): void {
    this.fine = this.dirty ? this.fine && fine : fine;
    this.dirty = true;
    if (!this.frame) this.frame = requestAnimationFrame(() => this.tick());
  }

  /** Draws at once, and refines later. */
  drawNow(): void {
    this.draw();
    this.refineAfter(QUIET_MS);
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    clearTimeout(this.quiet);
  }

  private tick(): void {
    this.frame = 0;
    if (!this.dirty) return;
    const began = performance.now();
    const moving = !this.fine;
    this.draw();
    this.work.drawn();
    clearTimeout(this.quiet);
    this.whenDone(() => {
      const seconds = (performance.now() - began) / 1000;
      if (moving) this.pace.took(seconds);
      if (this.panned) this.work.timed(seconds);
      this.panned = false;
      this.refineAfter(QUIET_MS);
    });
  }

  private draw(): void {
    const share = this.fine || this.posed ? 1 : this.pace.share;
    this.dirty = this.fine = false;
    this.work.draw(share);
  }

  private refineAfter(milliseconds: number): void {
    clearTimeout(this.quiet);
    this.quiet = window.setTimeout(() => this.refine(), milliseconds);
  }

  private refine(): void {
    if (this.dirty || !this.work.unfinished()) return;
    const began = performance.now();
    this.work.refine();
    this.whenDone(() => {
      const took = performance.now() - began;
      if (took > SLOW_STEP_MS) this.work.hurry();
      if (this.work.unfinished()) this.refineAfter(Math.max(8, took));
      else this.work.refined();
    });
  }

  /** Calls back when the graphics card has drawn what was queued, without waiting for it. */
  private whenDone(then: () => void): void {
    const { gl } = this;
    if (this.waiting) gl.deleteSync(this.waiting);
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.waiting = fence;
    if (!fence) return then();
    gl.flush();
    const look = () => {
      if (this.waiting !== fence || this.dirty) return;
      const state = gl.clientWaitSync(fence, 0, 0);
      if (state === gl.TIMEOUT_EXPIRED) this.quiet = window.setTimeout(look, 4);
      else then();
    };
    this.quiet = window.setTimeout(look, 2);
  }
}
