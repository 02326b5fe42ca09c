// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The lane of the guide: a bar a step, its height the shapes that the step makes, its colour the
// rule's. Where steps are more than pixels a bar stands for several and shows the most of them.

import { ruleColor } from '../lib/colors';
import type { Steps } from '../lib/steps';

const RULER = 14;

export function drawLane(
  canvas: HTMLCanvasElement,
  steps: Steps,
  step: number,
  stops: ReadonlySet<string>,
  width: number,
): void {
  const scale = window.devicePixelRatio || 1;
  const height = canvas.clientHeight || 58;
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  const g = canvas.getContext('2d');
  if (!g || steps.count === 0) return;
  g.scale(scale, scale);
  const style = getComputedStyle(canvas);
  const token = (name: string) => style.getPropertyValue(name).trim();
  const most = Math.max(1, ...sampled(steps, width).map((bar) => bar.made));
  const top = 8;
  const room = height - RULER - top;
  for (const bar of sampled(steps, width)) {
    const name = steps.shapes.nameOf(steps.nodes[bar.step - 1]!);
    const tall = Math.max(3, room * Math.sqrt(bar.made / most));
    g.globalAlpha = bar.step <= step ? 1 : 0.28;
    g.fillStyle = token(`--k${ruleColor(name)}`);
    g.fillRect(bar.x, top + room - tall, Math.max(1, bar.width - (bar.width > 3 ? 1 : 0)), tall);
    g.globalAlpha = 1;
    if (!stops.has(name)) continue;
    g.fillStyle = token('--error');
    g.beginPath();
    g.arc(bar.x + bar.width / 2, top - 4, 2.5, 0, 7);
    g.fill();
  }
  g.fillStyle = token('--text-3');
  g.font = `10.5px ${token('--font-ui')}`;
  const every = rulerStep(steps.count, width);
  for (let n = every; n < steps.count; n += every)
    g.fillText(String(n), (n / steps.count) * width - 8, height - 2);
}

interface Bar {
  step: number;
  x: number;
  width: number;
  made: number;
}

function sampled(steps: Steps, width: number): Bar[] {
  const bars = Math.max(1, Math.min(steps.count, Math.floor(width / 2)));
  const out: Bar[] = [];
  for (let i = 0; i < bars; ++i) {
    const from = Math.floor((i * steps.count) / bars) + 1;
    const to = Math.max(from, Math.floor(((i + 1) * steps.count) / bars));
    let step = from;
    for (let s = from; s <= to; ++s)
      if (steps.children(s).length > steps.children(step).length) step = s;
    out.push({
      step,
      x: (i * width) / bars,
      width: width / bars,
      made: steps.children(step).length,
    });
  }
  return out;
}

/** Numbers at 1, 2 or 5 times a power of ten, some 90 pixels apart. */
function rulerStep(count: number, width: number): number {
  const wished = (count * 90) / Math.max(90, width);
  const power = 10 ** Math.floor(Math.log10(Math.max(1, wished)));
  for (const m of [1, 2, 5, 10]) if (m * power >= wished) return m * power;
  return 10 * power;
}
