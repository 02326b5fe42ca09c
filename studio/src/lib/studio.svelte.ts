// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Studio: what the parts of the page have in common. Documents, the model and the selection are
// objects of their own; here are the place, the one history over all of them, and the connection.

import {
  EngineClient,
  Refusal,
  type DeriveRequest,
  type Example,
  type PictureView,
  type ProjectFile,
} from './client';
import { Documents } from './documents.svelte';
import { valueOfText, valueText } from './fields';
import { gesture } from './gesture';
import { applied, difference, History, type Step } from './history';
import { Model } from './model.svelte';
import { newPlace, placeBeside, placeOf, standpointOf, type Place } from './place';
import type { DrawList, Stats, Tree, Value } from './protocol';
import { readRegistry, type Entry } from './registry';
import { Selection, type Reveal } from './selection.svelte';
import type { Transport } from './transport';
import type { Shapes } from './tree';
import { ui } from './ui.svelte';
import { Unsent } from './unsent';
import { Guide } from '../guide/guide.svelte';
import type { Wire } from '../language/connection';
import { Language } from '../language/language.svelte';
import { edited, type TextEdit } from '../language/protocol';

export type Page = 'rules' | 'variations' | 'assets' | 'gallery';
export type Theme = 'dark' | 'light';

interface Remembered {
  main: string;
  places: Record<string, Place>;
}

export interface Toast {
  text: string;
  action?: { label: string; run: () => void };
}

const RULES = /\.(cga|gbbg|grammar|pg3d|park)$/;
const SHAPES = /\.(geojson|osm|pbf|gpkg|fgb|shp|kml|dxf|obj|glb|gltf)$/;
const MEMORY = 'studio.json';
const HISTORY = 'history.json';
const LOOK_MS = 2000;
const MOST_LOOK_MS = 10_000;

export class Studio {
  readonly client: EngineClient;
  page = $state<Page>('rules');
  theme = $state<Theme>('dark');
  name = $state('');
  files = $state.raw<ProjectFile[]>([]);
  main = $state('');
  place = $state<Place>(newPlace());
  examples = $state.raw<Example[]>([]);
  registry = $state.raw<Entry[]>([]);
  ready = $state(false);
  connected = $state(true);
  /** What could not be done, in a sentence. It stays until somebody has read it. */
  trouble = $state('');
  toast = $state.raw<Toast | null>(null);
  /** Pictures a second while the view moves. */
  fps = $state(0);
  /** What undo and redo would take back or do again; empty for nothing. */
  undoLabel = $state('');
  redoLabel = $state('');

  /** Other shapes stand elsewhere: the next model is framed. */
  reframe = false;

  /** Set by the view and the editor. */
  show: ((draw: DrawList, stats: Stats, lives?: Float32Array | null) => void) | null = null;
  showNothing: (() => void) | null = null;
  pictureView: (() => PictureView) | null = null;
  reveal: Reveal | null = null;

  readonly documents: Documents;
  readonly model: Model;
  readonly selection: Selection;
  readonly guide: Guide;
  readonly language: Language;

  readonly ruleFiles = $derived(this.files.filter((f) => RULES.test(f.path)));
  readonly shapeFiles = $derived(this.files.filter((f) => SHAPES.test(f.path)));

  root = '';
  /** The example that is open, and the folder of its copy. */
  example: { name: string; folder: string } | null = null;
  /** The address holds the work as it is. */
  inAddress = false;
  private latest: { draw: DrawList; stats: Stats } | null = null;
  private places: Record<string, Place> = {};
  private keepTimer = 0;
  private toastTimer = 0;
  private pollTimer = 0;
  private pollDelay = LOOK_MS;
  private readonly history = new History();

  constructor(transport: Transport) {
    this.client = new EngineClient(transport);
    const unsent = new Unsent(localStorage, this.client.tab, () => this.root);
    this.documents = new Documents(this, unsent);
    this.model = new Model(this);
    this.selection = new Selection(this);
    this.guide = new Guide(this);
    this.language = new Language(this);
  }

  async open(): Promise<void> {
    gesture.takeBack = (number) => this.giveUp(number);
    this.theme = localStorage.getItem('gable.theme') === 'light' ? 'light' : 'dark';
    try {
      const [project, ops] = await Promise.all([this.client.project(), this.client.ops()]);
      this.name = project.name;
      this.root = project.root;
      this.files = project.files;
      this.registry = readRegistry(ops);
      this.language.connect();
      await this.recall();
      await this.openFirst();
      this.ready = true;
      void this.client.examples().then((examples) => (this.examples = examples));
      await this.openAddress();
      this.client.transport.handedOver = () => void this.lookNow();
      if (this.client.kept) this.poll();
    } catch (error) {
      this.trouble =
        error instanceof Refusal && error.status === 401
          ? 'This page needs the address that gable studio printed, with its token.'
          : `The studio could not be reached: ${String(error)}`;
    }
  }

  private async openFirst(): Promise<void> {
    const all = this.ruleFiles;
    const first =
      all.find((f) => f.path === this.main) ??
      all.find((f) => !/^(.*\/)?rules\//.test(f.path)) ??
      all[0];
    if (first) await this.openRules(first.path);
    else this.page = 'gallery';
  }

  /** The address of the page may be a link to a shared place, or name an example or a file. */
  async openAddress(): Promise<void> {
    const link = location.hash;
    const name = /^#example=([\w-]+)$/.exec(link)?.[1];
    const file = /^#file=(.+)$/.exec(link)?.[1];
    if (!name && !file && !link.startsWith('#share=')) return;
    // Where files are kept the work goes on in them. Elsewhere the address stays what opens it.
    if (this.client.kept) history.replaceState(null, '', location.pathname);
    if (name) return this.openNamed(name);
    if (file) return this.openFile(file);
    const { openShared } = await import('./sharing');
    const said = await openShared(this, link);
    if (said) this.fail(said);
  }

  /** `written`: as addresses have it. */
  private async openFile(written: string): Promise<void> {
    let path = written;
    try {
      path = decodeURIComponent(written);
    } catch {
      // What is no escape is meant as it stands.
    }
    if (this.ruleFiles.some((f) => f.path === path)) await this.openRules(path);
    else this.fail(`There is no rule file '${path}' in this project.`);
  }

  private async openNamed(name: string): Promise<void> {
    const example = (await this.client.examples()).find((e) => e.name === name);
    if (example) await this.openExample(example);
    else this.fail(`There is no example '${name}'. The gallery has all of them.`);
  }

  /** Without a disk the work is kept in the address of the page, as a link to share. */
  private async keepInAddress(): Promise<void> {
    if (!this.main || (!this.undoLabel && !this.inAddress)) return;
    const { addressOf } = await import('./sharing');
    const address = await addressOf(this);
    this.inAddress = address !== '';
    if (address) history.replaceState(null, '', address);
  }

  private async recall(): Promise<void> {
    const [text, steps] = await Promise.all([
      this.client.recovery(MEMORY),
      this.client.recovery(HISTORY),
    ]);
    if (steps) this.history.recall(steps);
    this.countSteps();
    if (!text) return;
    try {
      const memory = JSON.parse(text) as Remembered;
      this.main = memory.main;
      this.places = memory.places;
    } catch {
      // A memory that cannot be read is none.
    }
  }

  /** Opens a rule file as the one that is derived. */
  async openRules(path: string, place?: Place): Promise<void> {
    await this.documents.show(path);
    this.main = path;
    this.place = place ?? this.places[path] ?? (await this.placeBeside(path));
    this.selection.clear();
    this.page = 'rules';
    this.reframe = true;
    // What other rules have made, or are about to, is not shown for these.
    this.latest = null;
    this.model.begin();
    this.changed();
  }

  private placeBeside(path: string): Promise<Place> {
    return placeBeside(path, this.files, async (f) => (await this.client.read(f)).text);
  }

  /** The text of a file has changed in the editor. A label makes it a step of its own. */
  edit(path: string, text: string, label = ''): void {
    this.editAll([[path, text]], label);
  }

  /** The same for several files, as one step. */
  editAll(texts: [string, string][], label = '', group = ''): void {
    const step: Step = { label: label || 'Typing', texts: [], place: null };
    for (const [path, text] of texts) {
      const doc = this.documents.doc(path);
      const change = doc && difference(path, doc.text, text);
      if (!doc || !change) continue;
      doc.text = text;
      step.texts.push(change);
    }
    if (!step.texts.length) return;
    const line = !label && step.texts.some((t) => t.inserted.includes('\n'));
    let usual = label || line ? '' : `text ${step.texts[0]!.path}`;
    if (gesture.active) usual = 'gesture';
    this.history.record(step, group || usual, gesture.active);
    this.countSteps();
    this.changed();
  }

  /** What an attribute is: what was set, at once, else what the model was made with. */
  valueOf(name: string): Value {
    const { attributes, values, defaults } = this.model;
    const set = this.place.attributes[name];
    if (set === undefined) return defaults[name] ?? values[name] ?? null;
    const type = attributes.find((a) => a.name === name)?.type ?? 'string';
    return valueOfText(set, type) ?? values[name] ?? null;
  }

  setAttribute(name: string, value: Value | undefined): void {
    const attributes = { ...this.place.attributes };
    if (value === undefined) delete attributes[name];
    else attributes[name] = valueText(value);
    // Going back to the default is a step of its own.
    this.change({ attributes }, name, `${value === undefined ? 'reset' : 'place'} ${name}`);
  }

  /** A step of the history; steps of one name within half a second are one. */
  change(
    part: Partial<Place>,
    label = Object.keys(part).join(' and '),
    group = `place ${label}`,
  ): void {
    const before = JSON.stringify(this.place);
    this.place = { ...this.place, ...part };
    const after = JSON.stringify(this.place);
    if (before === after) return;
    if (part.shapes && 'file' in part.shapes) this.reframe = true;
    const place = { main: this.main, before, after };
    this.history.record({ label, texts: [], place }, group, gesture.active);
    this.countSteps();
    this.changed();
  }

  private countSteps(): void {
    this.undoLabel = this.history.undoLabel;
    this.redoLabel = this.history.redoLabel;
  }

  undo(): void {
    void this.restore(this.history.undo(), 'Undid');
  }

  redo(): void {
    void this.restore(this.history.redo(), 'Did again');
  }

  /** Takes back what a gesture has changed that was given up; false where that is nothing. */
  private giveUp(number: number): boolean {
    const step = this.history.takeBack(number);
    if (step) void this.restore(step, '');
    return !!step;
  }

  private async restore(step: Step | null, verb: string): Promise<void> {
    if (!step) return;
    for (const path of new Set(step.texts.map((t) => t.path)))
      await this.documents.load(path).catch(() => undefined);
    let lost = false;
    for (const change of step.texts) {
      const doc = this.documents.doc(change.path);
      const text = doc && applied(doc.text, change);
      if (doc && typeof text === 'string') doc.text = text;
      else lost = true;
    }
    const place = step.place;
    if (place && place.main === this.main) this.place = JSON.parse(place.after) as Place;
    else if (place)
      this.places = { ...this.places, [place.main]: JSON.parse(place.after) as Place };
    this.countSteps();
    if (lost) this.say('That text was changed elsewhere; the rest was undone.');
    else if (verb && step.label !== 'Typing') this.say(`${verb}: ${step.label}`);
    this.changed();
  }

  texts(): { path: string; text: string }[] {
    return this.documents.open;
  }

  wire(): Wire {
    return this.client.transport.languageWire();
  }

  /** Something that the model depends on is another by now. */
  changed(): void {
    this.language.touched();
    clearTimeout(this.keepTimer);
    this.keepTimer = window.setTimeout(() => void this.keep(), 250);
    this.model.derive();
  }

  /** What would be lost with this page goes to the server, or stays in the browser without one. */
  private async keep(): Promise<void> {
    this.places = { ...this.places, [this.main]: $state.snapshot(this.place) };
    if (!this.client.kept) return this.keepInAddress();
    const memory: Remembered = { main: this.main, places: this.places };
    try {
      await this.client.keepRecovery(MEMORY, JSON.stringify(memory));
      await this.client.keepRecovery(HISTORY, this.history.keep());
      await this.documents.keep();
      this.found();
    } catch (error) {
      if (error instanceof Refusal && error.status !== 401) return;
      this.lost();
    }
  }

  /** A server has answered: whether it is this page's, a look tells, which takes up the work. */
  found(): void {
    if (!this.connected) void this.lookNow();
  }

  lost(): void {
    this.connected = false;
    this.documents.keepHere();
  }

  /** What would be derived with other parts of the place. */
  requestFor(part: Partial<Place>): DeriveRequest | null {
    const request = this.request();
    return request && { ...request, ...part };
  }

  request(): DeriveRequest | null {
    if (!this.main) return null;
    return {
      page: this.client.page,
      file: this.main,
      text: this.documents.doc(this.main)?.text ?? '',
      overlay: this.documents.overlay(this.main),
      ...$state.snapshot(this.place),
    };
  }

  get steps(): boolean {
    return this.guide.open;
  }

  derived(draw: DrawList, stats: Stats): void {
    this.selection.far = null;
    this.latest = { draw, stats };
    if (!this.guide.open) this.show?.(draw, stats);
  }

  none(): void {
    if (this.guide.open) this.guide.close();
    this.latest = null;
    this.showNothing?.();
  }

  grown(shapes: Shapes, draw: DrawList | null, end: Tree['end']): void {
    this.selection.findAgain(shapes);
    if (!this.guide.open || !draw) return;
    this.guide.take(shapes, draw, end === 'limit');
    this.showAgain();
  }

  treeless(): void {
    this.selection.node = -1;
  }

  /** A shape was chosen: the guide goes to it. */
  chosen(node: number): void {
    this.guide.follow(node);
  }

  /** Gives the view what it is to show, once more. */
  showAgain(): void {
    if (!this.latest) return;
    const { draw, steps } = this.guide;
    if (this.guide.open && draw && steps)
      this.show?.(draw, this.latest.stats, steps.lives(draw.leaves));
    else this.show?.(this.latest.draw, this.latest.stats);
  }

  /** Opens the guide at its last step, or goes back to the model. */
  toggleGuide(): void {
    const { model } = this;
    if (!this.latest || (!model.shapes && !model.huge)) return;
    if (this.guide.open) {
      this.guide.close();
      this.showAgain();
      // The shapes of the first steps are not those of the model.
      if (model.huge) {
        model.shapes = null;
        this.selection.node = -1;
        return;
      }
    } else this.guide.open = true;
    this.selection.far = null;
    void model.fetchTree();
  }

  seedOf(lot: number): number {
    return this.place.seeds?.[lot] ?? this.place.seed;
  }

  pinned(lot: number): boolean {
    return this.place.seeds?.[lot] !== undefined;
  }

  /** Holds the seed of a lot, or lets it go with the others again. */
  pin(lot: number): void {
    const { [lot]: held, ...rest } = this.place.seeds ?? {};
    this.change(
      { seeds: held === undefined ? { ...rest, [lot]: this.place.seed } : rest },
      held === undefined ? 'Pin' : 'Unpin',
    );
  }

  setSeed(seed: number, lot = -1): void {
    const whole = Math.max(-0x80000000, Math.min(0x7fffffff, Math.round(seed)));
    if (lot >= 0) this.change({ seeds: { ...this.place.seeds, [lot]: whole } }, 'Seed of the lot');
    else this.change({ seed: whole }, 'Seed');
  }

  /** A new seed for the selected lot among several, else for all that are not pinned. */
  reroll(all = false): void {
    const seed = crypto.getRandomValues(new Int32Array(1))[0]! & 0x7fffffff;
    const several = (this.model.shapes?.roots.length ?? 0) > 1;
    this.setSeed(seed, !all && several ? this.selection.lot : -1);
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    localStorage.setItem('gable.theme', theme);
  }

  async format(): Promise<void> {
    const doc = this.documents.doc(this.documents.active);
    if (!doc) return;
    if (this.language.mistakes.get(doc.path)?.some((m) => m.severity === 1))
      return this.say('Text with errors is not formatted.');
    const { text } = doc;
    const edits = await this.language.tell<TextEdit[]>('textDocument/formatting', doc.path);
    if (edits && doc.text === text) this.edit(doc.path, edited(text, edits), 'Format');
  }

  async refreshFiles(): Promise<void> {
    this.files = (await this.client.project()).files;
  }

  async newRules(): Promise<void> {
    let path = 'rules.cga';
    for (let i = 2; this.files.some((f) => f.path === path); ++i) path = `rules-${i}.cga`;
    await this.attempt('New rules could not be made', async () => {
      await this.client.write(path, EMPTY_RULES, 'none');
      await this.refreshFiles();
      await this.openRules(path);
    });
  }

  async openExample(example: Example): Promise<void> {
    await this.attempt(`${example.title} could not be opened`, async () => {
      const folder = await this.client.copyExample(example.name);
      await this.refreshFiles();
      const rules = `${folder}/${example.name}.${example.notation}`;
      const from = standpointOf(example);
      this.example = { name: example.name, folder };
      this.inAddress = false;
      if (!this.client.kept) history.replaceState(null, '', `#example=${example.name}`);
      // As its card shows it.
      if (from) [ui.look.camera, ui.look.sky] = [{ of: rules, ...from }, true];
      await this.openRules(rules, placeOf(example, folder));
      if (from) this.reframe = false;
      this.say(`Opened a copy in ${folder}`);
    });
  }

  /** Does something that may fail, and tells if it does. */
  async attempt(failure: string, act: () => Promise<void>): Promise<void> {
    try {
      await act();
    } catch (error) {
      this.fail(`${failure}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }

  fail(text: string): void {
    this.trouble = text;
  }

  say(text: string, action?: Toast['action']): void {
    this.toast = action ? { text, action } : { text };
    clearTimeout(this.toastTimer);
    this.toastTimer = window.setTimeout(() => (this.toast = null), 5000);
  }

  /** Sees files that others change, and whether the server is there. */
  private poll(): void {
    clearTimeout(this.pollTimer);
    this.pollTimer = window.setTimeout(() => void this.lookNow(), this.pollDelay);
  }

  private async lookNow(): Promise<void> {
    clearTimeout(this.pollTimer);
    await this.look();
    this.poll();
  }

  private async look(): Promise<void> {
    // Without a server a page looks on, so that it is found at work when somebody comes back.
    if (document.hidden && this.connected) return;
    try {
      const before = new Map(this.files.map((f) => [f.path, f.stamp]));
      const { files, root } = await this.client.project();
      // The same address may be another project's by now.
      if (root !== this.root) throw new Error('another project');
      this.files = files;
      if (!this.connected) {
        this.connected = true;
        this.documents.forgetKept();
        void this.keep();
        this.model.derive();
      }
      this.language.connect();
      this.pollDelay = LOOK_MS;
      for (const f of files) {
        const known = before.get(f.path);
        if (known !== undefined && known !== f.stamp) await this.documents.changedElsewhere(f.path);
      }
    } catch (error) {
      if (error instanceof Refusal && error.status !== 401) return;
      this.lost();
      this.pollDelay = Math.min(MOST_LOOK_MS, this.pollDelay * 1.5);
    }
  }
}

const EMPTY_RULES = `// A lot becomes a block of this height.
// Point at a word: what does it do?
// Ctrl Space: what can stand here?
// Ctrl K: operations by everyday words.
attr height = 12

@StartRule
Lot -->
  extrude(height)
  color("#e6dac5")
  Building.
`;
