// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pace: how fine a picture is that is drawn while something changes, so that it comes at once. It
// is a share of the canvas's pixels each way; where pictures are late it goes down, where they are
// early it goes up. What stands still is drawn in full, later.

/** Shares, from coarse to fine. */
export const SHARES = [0.4, 0.5, 0.7, 1] as const;
/** A picture that takes longer is late; one that takes less leaves room for a finer one. */
const LATE = 0.07;
const EARLY = 0.016;
/** So many early ones in a row before a finer one is tried. */
const ROW = 12;
const SOFTWARE = /llvmpipe|softpipe|swiftshader|software|basic render/i;

/** Whether a context is drawn by the processor. */
export function isSoftware(gl: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  return SOFTWARE.test(String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER)));
}

export class Pace {
  private at: number;
  private early = 0;

  constructor(software: boolean) {
    this.at = software ? 1 : SHARES.length - 1;
  }

  get share(): number {
    return SHARES[this.at]!;
  }

  /** Hears how long a picture took. */
  took(seconds: number): void {
    this.early = seconds < EARLY ? this.early + 1 : 0;
    if (seconds > LATE) this.at = Math.max(0, this.at - 1);
    if (this.early < ROW) return;
    this.at = Math.min(SHARES.length - 1, this.at + 1);
    this.early = 0;
  }
}
