// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Reports of a derivation as rows of a table and as charts.

import type { ReportTotal } from './protocol';

export interface ReportRow {
  name: string;
  n: number;
  sum: number | null;
  avg: number | null;
  min: number | null;
  max: number | null;
}

export interface Share {
  name: string;
  value: number;
  /** Of the whole, 0 to 1. */
  share: number;
}

export interface Chart {
  title: string;
  kind: 'parts' | 'values';
  shares: Share[];
}

export function reportRows(reports: Record<string, ReportTotal>): ReportRow[] {
  return Object.entries(reports).map(([name, r]) => ({
    name,
    n: r.n,
    sum: r.sum ?? null,
    avg: r.avg ?? null,
    min: r.min ?? null,
    max: r.max ?? null,
  }));
}

export type Column = keyof ReportRow;

/** Sorted by a column; names upward, numbers downward, unless reversed. */
export function sortRows(rows: ReportRow[], by: Column, reversed: boolean): ReportRow[] {
  const sign = reversed ? -1 : 1;
  return [...rows].sort((a, b) => {
    if (by === 'name') return sign * a.name.localeCompare(b.name);
    return sign * ((b[by] ?? -Infinity) - (a[by] ?? -Infinity));
  });
}

const shares = (parts: [string, number][]): Share[] => {
  const whole = parts.reduce((sum, [, v]) => sum + v, 0);
  return parts
    .sort((a, b) => b[1] - a[1])
    .map(([name, value]) => ({ name, value, share: whole > 0 ? value / whole : 0 }));
};

/**
 * "floor.area.shop" and "floor.area.flat" are parts of "floor.area"; texts have their own counts.
 */
export function charts(reports: Record<string, ReportTotal>): Chart[] {
  const groups = new Map<string, [string, number][]>();
  const out: Chart[] = [];
  for (const [name, r] of Object.entries(reports)) {
    if (r.values) {
      out.push({ title: name, kind: 'values', shares: shares(Object.entries(r.values)) });
      continue;
    }
    const dot = name.lastIndexOf('.');
    if (dot < 0 || r.sum === undefined || r.sum < 0) continue;
    const group = groups.get(name.slice(0, dot)) ?? [];
    group.push([name.slice(dot + 1), r.sum]);
    groups.set(name.slice(0, dot), group);
  }
  for (const [title, parts] of groups)
    if (parts.length > 1) out.push({ title, kind: 'parts', shares: shares(parts) });
  return out;
}

/** As a table for spreadsheets. */
export function csv(rows: ReportRow[]): string {
  const cell = (v: string | number | null) =>
    v === null ? '' : /[",\n]/.test(String(v)) ? `"${String(v).replaceAll('"', '""')}"` : String(v);
  const lines = rows.map((r) => [r.name, r.n, r.sum, r.avg, r.min, r.max].map(cell).join(','));
  return ['report,n,sum,avg,min,max', ...lines].join('\n') + '\n';
}
