// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Pace } from './pace';
import { Schedule, type Work } from './schedule';

const STEPS = 3;

/** A card that has drawn at once, and what a schedule asks of a view, written down. */
function desk(posed = false) {
  const told: string[] = [];
  let left = 0;
  const work: Work = {
    draw: (share) => {
      left = STEPS;
      told.push(`draw ${share}`);
    },
    unfinished: () => left > 0,
    refine: () => {
      left -= 1;
      told.push('refine');
    },
    hurry: () => told.push('hurry'),
    drawn: () => told.push('drawn'),
    timed: () => told.push('timed'),
    refined: () => told.push('refined'),
  };
  const gl = {
    fenceSync: () => ({}),
    deleteSync: () => undefined,
    flush: () => undefined,
    clientWaitSync: () => 1,
    SYNC_GPU_COMMANDS_COMPLETE: 0,
    TIMEOUT_EXPIRED: 2,
  } as unknown as WebGL2RenderingContext;
  const pace = { share: 0.5, took: () => told.push('took') } as unknown as Pace;
  return { told, schedule: new Schedule(gl, pace, posed, work) };
}

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal('window', globalThis);
  vi.stubGlobal('requestAnimationFrame', (f: () => void) => setTimeout(f, 16));
  vi.stubGlobal('cancelAnimationFrame', (id: number) => clearTimeout(id));
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

test('many changes of a frame are one picture, which is refined when nothing changes', () => {
  const { told, schedule } = desk();
  for (let i = 0; i < 5; ++i) schedule.redraw();
  expect(schedule.dirty).toBe(true);
  vi.advanceTimersByTime(20);
  expect(told).toEqual(['draw 0.5', 'drawn', 'took']);
  vi.advanceTimersByTime(300);
  expect(told).not.toContain('refine');
  vi.advanceTimersByTime(1000);
  expect(told.slice(3)).toEqual(['refine', 'refine', 'refine', 'refined']);
});

test('a change ends the refinement of the picture before', () => {
  const { told, schedule } = desk();
  schedule.redraw();
  vi.advanceTimersByTime(430);
  expect(told.at(-1)).toBe('refine');
  schedule.cameraMoved();
  schedule.redraw();
  vi.advanceTimersByTime(20);
  expect(told.slice(-4)).toEqual(['draw 0.5', 'drawn', 'took', 'timed']);
});

test('what does not move is drawn in full, unless something moves as well', () => {
  const { told, schedule } = desk();
  schedule.redraw(true);
  vi.advanceTimersByTime(20);
  expect(told[0]).toBe('draw 1');
  schedule.redraw(true);
  schedule.redraw();
  vi.advanceTimersByTime(20);
  expect(told).toContain('draw 0.5');
  expect(desk(true).told).toEqual([]);
});

test('pictures that are taken are in full, and nothing is drawn after the end', () => {
  const { told, schedule } = desk(true);
  schedule.redraw();
  vi.advanceTimersByTime(20);
  expect(told[0]).toBe('draw 1');
  schedule.redraw();
  schedule.dispose();
  const before = told.length;
  vi.advanceTimersByTime(2000);
  expect(told.length).toBe(before);
});
