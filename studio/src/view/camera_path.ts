// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A camera's way through a model, as `gable render --walk` takes it: from stop to stop on cubic
// Hermite curves whose tangents are those of Catmull and Rom with uneven times.

export type Point = [number, number, number];

export interface Stop {
  eye: Point;
  target: Point;
  /** The horizontal angle of view, in degrees. */
  fov: number;
}

export interface CameraPath {
  stops: Stop[];
  /** Metres a second. */
  speed: number;
  /** It ends where it began. */
  closed: boolean;
}

/** Who only turns the head takes a moment as well. */
const SHORTEST = 0.5;

/** When each stop is passed, in seconds, and when it ends. */
export function timesOf(path: CameraPath): number[] {
  const { stops, speed, closed } = path;
  const times = [0];
  const count = closed ? stops.length : stops.length - 1;
  for (let i = 0; i < count; ++i) {
    const [a, b] = [stops[i]!.eye, stops[(i + 1) % stops.length]!.eye];
    const way = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    times.push(times[i]! + Math.max(way / speed, SHORTEST));
  }
  return times;
}

/** Where the camera is after so many seconds, and what it looks at. */
export function standAt(path: CameraPath, seconds: number): { eye: Point; target: Point } {
  const { stops, closed } = path;
  const times = timesOf(path);
  const last = times.length - 1;
  const end = times[last]!;
  if (stops.length < 2 || last < 1) return stops[0]!;
  const now = closed ? ((seconds % end) + end) % end : Math.min(Math.max(seconds, 0), end);
  let at = 0;
  while (at < last - 1 && times[at + 1]! <= now) ++at;
  /** The stop and its time; beyond the ends of an open way there is none. */
  const known = (i: number): { stop: Stop; time: number } | null => {
    if (closed) {
      const around = Math.floor(i / last);
      const place = i - around * last;
      return { stop: stops[place]!, time: times[place]! + around * end };
    }
    return i >= 0 && i <= last ? { stop: stops[i]!, time: times[i]! } : null;
  };
  const from = known(at)!;
  const to = known(at + 1)!;
  const span = to.time - from.time;
  const s = (now - from.time) / span;
  const along = (of: 'eye' | 'target'): Point => {
    const slope = (i: number, k: number): number => {
      const [before, after] = [known(i - 1) ?? known(i)!, known(i + 1) ?? known(i)!];
      const change = after.stop[of][k]! - before.stop[of][k]!;
      return (change / (after.time - before.time)) * span;
    };
    return [0, 1, 2].map((k) => {
      const [p, q] = [from.stop[of][k]!, to.stop[of][k]!];
      const [m, n] = [slope(at, k), slope(at + 1, k)];
      const [s2, s3] = [s * s, s * s * s];
      return (
        (2 * s3 - 3 * s2 + 1) * p + (s3 - 2 * s2 + s) * m + (3 * s2 - 2 * s3) * q + (s3 - s2) * n
      );
    }) as Point;
  };
  return { eye: along('eye'), target: along('target') };
}

/** The file for `gable render --walk`. */
export function pathText({ stops, speed, closed }: CameraPath): string {
  const rounded = (point: Point) => `[${point.map((v) => Number(v.toFixed(3))).join(', ')}]`;
  const lines = stops.map(({ eye, target, fov }) => {
    const angle = Number(fov.toFixed(1));
    return `    {"eye": ${rounded(eye)}, "target": ${rounded(target)}, "fov": ${angle}}`;
  });
  const ends = closed ? '  "closed": true,\n' : '';
  return `{\n  "speed": ${speed},\n${ends}  "stops": [\n${lines.join(',\n')}\n  ]\n}\n`;
}
