// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

import type { ViewColors } from './scene_view';

/** The colours of the theme that the page shows. */
export function themeColors(): ViewColors {
  const style = getComputedStyle(document.documentElement);
  const token = (name: string) => style.getPropertyValue(name).trim();
  return {
    ground: token('--view-ground'),
    line: token('--view-line'),
    accent: token('--accent'),
    text: token('--text'),
    ghost: token('--ghost'),
    zenith: token('--view-zenith'),
    horizon: token('--view-horizon'),
  };
}
