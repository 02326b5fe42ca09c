// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the page can be told to do, in one table: keys, the palette and the list under `?` are made
// of it. Keys that the editor or the view take themselves stand in keys.ts.

import type { Layout } from './layout.svelte';
import type { Studio } from './studio.svelte';
import { ui } from './ui.svelte';

export interface Command {
  title: string;
  /** "Ctrl Shift Z"; empty for none. */
  keys: string;
  icon: string;
  run: () => void;
  /** Also where a text field has the focus. */
  anywhere?: boolean;
  /** Not offered while it would do nothing. */
  when?: () => boolean;
}

/** Files, and what has been done to them. */
function ofFiles(studio: Studio): Command[] {
  const hasRules = () => !!studio.main;
  const modeled = () => !!studio.model.derivation;
  return [
    {
      title: 'Search or run',
      keys: 'Ctrl K',
      icon: 'search',
      anywhere: true,
      run: () => void (ui.palette = ''),
    },
    {
      title: 'Save the file',
      keys: 'Ctrl S',
      icon: 'file',
      anywhere: true,
      run: () => void studio.documents.save(),
      when: () => studio.client.kept,
    },
    {
      title: 'Save all files',
      keys: 'Ctrl Shift S',
      icon: 'file',
      anywhere: true,
      run: () => void studio.documents.saveAll(),
      when: () => studio.client.kept,
    },
    {
      title: 'Undo',
      keys: 'Ctrl Z',
      icon: 'undo',
      run: () => studio.undo(),
      when: () => !!studio.undoLabel,
    },
    {
      title: 'Redo',
      keys: 'Ctrl Shift Z',
      icon: 'redo',
      run: () => studio.redo(),
      when: () => !!studio.redoLabel,
    },
    {
      title: 'Export',
      keys: 'Ctrl E',
      icon: 'export',
      anywhere: true,
      run: () => void (ui.exporting = true),
      when: modeled,
    },
    {
      title: 'Share as a link or a file',
      keys: '',
      icon: 'share',
      run: () => void (ui.share = true),
      when: hasRules,
    },
  ];
}

/** Panels beside the view, and the rules in them. */
function ofPanels(studio: Studio, layout: Layout): Command[] {
  const hasRules = () => !!studio.main;
  return [
    {
      title: 'Editor',
      keys: 'Ctrl B',
      icon: 'file',
      anywhere: true,
      run: () => layout.toggle('editor'),
    },
    {
      title: 'Shapes and inspector',
      keys: 'Ctrl I',
      icon: 'form',
      anywhere: true,
      run: () => layout.toggle('dock'),
    },
    {
      title: 'Problems',
      keys: 'Ctrl J',
      icon: 'wrn',
      anywhere: true,
      run: () => layout.toggle('problems'),
    },
    {
      title: 'View alone',
      keys: 'Ctrl \\',
      icon: 'fit',
      anywhere: true,
      run: () => layout.alone(),
    },
    {
      title: 'Rules as a form or as text',
      keys: 'Alt F',
      icon: 'form',
      anywhere: true,
      run: () => void (ui.form = !ui.form),
      when: hasRules,
    },
    {
      title: 'Format the rules',
      keys: 'Shift Alt F',
      icon: 'file',
      anywhere: true,
      run: () => void studio.format(),
      when: hasRules,
    },
  ];
}

/** The place that is derived. */
function ofPlace(studio: Studio): Command[] {
  const hasRules = () => !!studio.main;
  const modeled = () => !!studio.model.derivation;
  return [
    { title: 'New seed', keys: 'R', icon: 'dice', run: () => studio.reroll(), when: hasRules },
    {
      title: 'New seed for all lots',
      keys: 'Shift R',
      icon: 'dice',
      run: () => studio.reroll(true),
      when: hasRules,
    },
    {
      title: 'Draw a lot',
      keys: 'L',
      icon: 'lot',
      run: () => void (ui.tool = ui.tool === 'lot' ? 'select' : 'lot'),
      when: hasRules,
    },
    {
      title: 'Measure',
      keys: 'M',
      icon: 'ruler',
      run: () => void (ui.tool = ui.tool === 'measure' ? 'select' : 'measure'),
      when: modeled,
    },
    {
      title: 'Select shapes',
      keys: 'V',
      icon: 'cursor',
      run: () => void (ui.tool = 'select'),
      when: hasRules,
    },
  ];
}

/** Pages, and the page as a whole. */
function ofPages(studio: Studio, showKeys: () => void): Command[] {
  const hasRules = () => !!studio.main;
  const go = (page: Studio['page']) => () => void (studio.page = page);
  return [
    {
      title: 'Rules',
      keys: 'Alt 1',
      icon: 'file',
      anywhere: true,
      run: go('rules'),
      when: hasRules,
    },
    {
      title: 'Variations',
      keys: 'Alt 2',
      icon: 'grid',
      anywhere: true,
      run: go('variations'),
      when: hasRules,
    },
    { title: 'Assets', keys: 'Alt 3', icon: 'cube', anywhere: true, run: go('assets') },
    { title: 'Gallery', keys: 'Alt 4', icon: 'star', anywhere: true, run: go('gallery') },
    {
      title: 'New rules',
      keys: 'Alt N',
      icon: 'plus',
      anywhere: true,
      run: () => void studio.newRules(),
    },
    {
      title: 'Light or dark',
      keys: '',
      icon: 'sun',
      run: () => studio.setTheme(studio.theme === 'dark' ? 'light' : 'dark'),
    },
    { title: 'List of keys', keys: '?', icon: 'help', run: showKeys },
  ];
}

export function commands(studio: Studio, layout: Layout, showKeys: () => void): Command[] {
  return [
    ...ofFiles(studio),
    ...ofPanels(studio, layout),
    ...ofPlace(studio),
    ...ofPages(studio, showKeys),
  ];
}

/** "Ctrl Shift Z" of an event; letters and digits by what they are on the keyboard with Alt. */
export function chordOf(event: KeyboardEvent): string {
  const parts: string[] = [];
  if (event.ctrlKey || event.metaKey) parts.push('Ctrl');
  const letter = event.key.length === 1;
  const upper = letter && /[a-z]/i.test(event.key);
  if (event.shiftKey && (upper || !letter)) parts.push('Shift');
  if (event.altKey) parts.push('Alt');
  const physical =
    event.altKey && /^(Key|Digit)/.test(event.code) ? event.code.replace(/^(Key|Digit)/, '') : '';
  const names: Record<string, string> = { ' ': 'Space', Escape: 'Esc' };
  parts.push(physical || names[event.key] || (upper ? event.key.toUpperCase() : event.key));
  return parts.join(' ');
}

/** Runs the command of an event's keys; false where there is none to be run. */
export function runKeys(list: Command[], event: KeyboardEvent, typing: boolean): boolean {
  const chord = chordOf(event);
  const found = list.find((c) => c.keys === chord && (c.anywhere || !typing));
  if (!found) return false;
  if (!found.when || found.when()) found.run();
  return true;
}
