// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Guide: the derivation one step at a time. While it is open the view draws the shapes of all steps
// and shows those that exist after the present one; the selection is the shape that the step
// replaces.

import type { DrawList } from '../lib/protocol';
import { Steps } from '../lib/steps';
import type { Shapes } from '../lib/tree';

export const SPEEDS = [1, 2, 5, 20, 100] as const;

/** What the guide needs of the page around it. */
export interface GuideHost {
  readonly selection: { select(node: number, reveal?: boolean): void };
  readonly model: { readonly shapes: Shapes | null };
}

export class Guide {
  open = $state(false);
  steps = $state.raw<Steps | null>(null);
  draw = $state.raw<DrawList | null>(null);
  step = $state(0);
  playing = $state(false);
  ghosts = $state(true);
  speed = $state<number>(2);
  stops = $state.raw<ReadonlySet<string>>(new Set());
  /** More steps than can be shown one by one. */
  truncated = $state(false);
  private timer = 0;

  constructor(private readonly host: GuideHost) {}

  get count(): number {
    return this.steps?.count ?? 0;
  }

  /** The shape that the present step replaces; -1 before the first. */
  get node(): number {
    return this.steps?.nodes[this.step - 1] ?? -1;
  }

  /** A new derivation: the guide stays at the shape where it was, by its path. */
  take(shapes: Shapes, draw: DrawList, truncated: boolean): void {
    const before = this.steps;
    const at = before && this.step > 0 ? before.shapes.address(this.node) : null;
    const wasLast = !before || this.step >= before.count;
    this.steps = new Steps(shapes);
    this.draw = draw;
    this.truncated = truncated;
    const found = at ? shapes.find(at) : -1;
    this.go(wasLast || found < 0 ? this.count : this.steps.replacedIn[found] || this.count, false);
  }

  close(): void {
    this.pause();
    this.open = false;
    this.steps = null;
    this.draw = null;
    this.step = 0;
  }

  /** The step that replaces a shape that was selected elsewhere, or the one that made it. */
  follow(node: number): void {
    if (!this.open || !this.steps || node < 0 || node === this.node) return;
    this.pause();
    this.step = this.steps.replacedIn[node] || this.steps.born(node);
  }

  go(step: number, reveal = true): void {
    this.step = Math.max(0, Math.min(this.count, Math.round(step)));
    if (this.node >= 0) this.host.selection.select(this.node, reveal);
  }

  /** One step on or back. */
  move(by: number): void {
    this.pause();
    this.go(this.step + by);
  }

  toStop(forwards: boolean): void {
    this.pause();
    const found = this.steps?.nextStop(this.step, forwards, this.stops) ?? 0;
    this.go(found || (forwards ? this.count : 0));
  }

  toggleStop(rule: string): void {
    const next = new Set(this.stops);
    if (!next.delete(rule)) next.add(rule);
    this.stops = next;
  }

  play(): void {
    if (this.playing) return this.pause();
    if (this.step >= this.count) this.go(0);
    this.playing = true;
    this.tick();
  }

  pause(): void {
    this.playing = false;
    clearTimeout(this.timer);
  }

  private tick(): void {
    this.timer = window.setTimeout(() => {
      if (!this.playing) return;
      this.go(this.step + 1);
      const stopped = this.steps && this.stops.has(this.steps.shapes.nameOf(this.node));
      if (this.step >= this.count || stopped) this.playing = false;
      else this.tick();
    }, 1000 / this.speed);
  }
}
