// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Words and numbers of the time by which the sun stands. The view counts its azimuth from the south
// to the east, a compass from the north over the east.

/** "2024-06-21" as [2024, 6, 21]; null for no day. */
export function dayOf(text: string): [number, number, number] | null {
  const found = /^(\d{4})-(\d{1,2})-(\d{1,2})$/.exec(text.trim());
  return found ? [Number(found[1]), Number(found[2]), Number(found[3])] : null;
}

/** "43.73, 7.42" as [43.73, 7.42]; null where nothing is written, undefined for anything else. */
export function placeOf(text: string): [number, number] | null | undefined {
  if (!text.trim()) return null;
  const parts = text.split(/[,;\s]+/).filter((part) => part !== '');
  const [latitude, longitude] = parts.map(Number);
  const two = parts.length === 2 && Number.isFinite(latitude) && Number.isFinite(longitude);
  return two ? [latitude!, longitude!] : undefined;
}

/** 14.25 as "14:15". */
export function clock(hour: number): string {
  const minutes = Math.round(hour * 60);
  return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, '0')}`;
}

/** From a compass to the view, and back: degrees from -180 to 180. */
export function viewAzimuth(compass: number): number {
  return ((((180 - compass + 180) % 360) + 360) % 360) - 180;
}

export function compassAzimuth(view: number): number {
  return (((180 - view) % 360) + 360) % 360;
}
