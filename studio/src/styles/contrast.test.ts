// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Every pair of text and ground that the page uses reaches WCAG AA: 4.5 for text, 3 for edges.
import { describe, expect, it } from 'vitest';
import css from './tokens.css?raw';

function tokens(selector: string): Record<string, string> {
  const block = css.split(selector)[1]?.split('}')[0] ?? '';
  return Object.fromEntries(
    [...block.matchAll(/--([\w-]+): (#[0-9a-f]{6})\b/g)].map((m) => [m[1]!, m[2]!]),
  );
}

function luminance(hex: string): number {
  const [r = 0, g = 0, b = 0] = [1, 3, 5].map((i) => {
    const v = parseInt(hex.slice(i, i + 2), 16) / 255;
    return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [x, y] = [luminance(a), luminance(b)];
  return (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05);
}

describe.each([
  ['dark', '[data-theme=dark] {'],
  ['light', '[data-theme=light] {'],
])('%s', (_, selector) => {
  const t = tokens(selector);
  const pairs: [string, string, number][] = [];
  for (const ground of ['panel', 'raised', 'field', 'select'])
    for (const text of ['text', 'text-2', 'text-3']) pairs.push([text, ground, 4.5]);
  for (const mark of ['error', 'warn', 'info', 'ok', 'ghost', 'x', 'y', 'z'])
    for (const ground of ['panel', 'field']) pairs.push([mark, ground, 4.5]);
  for (const name of Object.keys(t).filter((n) => n.startsWith('c-')))
    for (const ground of ['panel', 'select']) pairs.push([name, ground, 4.5]);
  for (const name of Object.keys(t).filter((n) => /^k\d/.test(n))) pairs.push([name, 'panel', 3]);
  pairs.push(
    ['text', 'accent-fill', 4.5],
    ['text', 'accent-soft', 4.5],
    ['text-2', 'accent-soft', 4.5],
    ['accent-text', 'panel', 4.5],
    ['on-accent', 'accent', 4.5],
    ['edge', 'panel', 3],
    ['accent', 'panel', 3],
  );
  it.each(pairs)('%s on %s', (a, b, least) => {
    expect(contrast(t[a]!, t[b]!)).toBeGreaterThanOrEqual(least);
  });
});
