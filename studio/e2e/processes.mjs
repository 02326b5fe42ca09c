// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Processor time of a studio and of the browser on it, by what they do. It says what something
// costs even where other programs have most of the machine and the clock says nothing.

import { readFileSync, readdirSync } from 'node:fs';

const read = (path) => {
  try {
    return readFileSync(path, 'latin1');
  } catch {
    return '';
  }
};

/** The processes below this one. */
function below() {
  const parents = new Map();
  for (const pid of readdirSync('/proc').filter((n) => /^\d+$/.test(n))) {
    const stat = read(`/proc/${pid}/stat`);
    const parent = Number(stat.slice(stat.lastIndexOf(')') + 2).split(' ')[1]);
    if (parent) parents.set(Number(pid), parent);
  }
  const isBelow = (pid) => {
    for (let p = parents.get(pid); p; p = parents.get(p)) if (p === process.pid) return true;
    return false;
  };
  return [...parents.keys()].filter(isBelow);
}

function kindOf(pid, server) {
  if (pid === server) return 'server';
  const type = /--type=([\w-]+)/.exec(read(`/proc/${pid}/cmdline`).replace(/\0/g, ' '))?.[1];
  return { renderer: 'page', 'gpu-process': 'graphics' }[type] ?? 'browser';
}

/** Milliseconds of all threads of a process so far. */
function spent(pid) {
  let out = 0;
  try {
    for (const task of readdirSync(`/proc/${pid}/task`))
      out += Number(read(`/proc/${pid}/task/${task}/schedstat`).split(' ')[0] ?? 0);
  } catch {
    // It has ended.
  }
  return out / 1e6;
}

/**
 * Gives a function that tells { server, page, graphics, browser, all } in milliseconds since it was
 * last called.
 */
export function meter(server) {
  const known = below().map((pid) => ({ pid, kind: kindOf(pid, server), before: spent(pid) }));
  return () => {
    const out = { server: 0, page: 0, graphics: 0, browser: 0, all: 0 };
    for (const p of known) {
      const now = spent(p.pid);
      out[p.kind] += now - p.before;
      out.all += now - p.before;
      p.before = now;
    }
    return out;
  };
}

export const told = (cost) =>
  ['all', 'server', 'page', 'graphics', 'browser']
    .map((k) => `${k} ${cost[k].toFixed(0)}`)
    .join(', ');
