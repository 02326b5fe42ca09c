// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Studio: all that the page knows. Panels read it and call its methods; none has a state of its own
// that another panel would have to know.

import {
  EngineClient,
  Refusal,
  type DeriveRequest,
  type Example,
  type ProjectFile,
  type ShapesSpec,
} from './client';
import { applied, difference, History, type Step } from './history';
import { groupFields, valueText, type Group } from './fields';
import type { AttributeInfo, Derived, DrawList, Message, RuleInfo, Stats, Value } from './protocol';
import { Far } from './far';
import { Guide } from '../guide/guide.svelte';
import { merge } from './merge';
import { Recovery } from './recovery';
import { readRegistry, type Entry } from './registry';
import { Shapes } from './tree';

export type Page = 'rules' | 'variations' | 'assets' | 'gallery';
export type Theme = 'dark' | 'light';

export interface Doc {
  path: string;
  text: string;
  /** What the file says, and which version that is; "none" for a file that is not there yet. */
  saved: string;
  version: string;
}

/** What makes a place besides the rules. Values are texts as the engine takes them. */
export interface Place {
  start: string;
  seed: number;
  attributes: Record<string, string>;
  shapes: ShapesSpec;
  /** Where the usual ones are not enough. */
  limits?: { seconds?: number; shapes?: number };
  /** Seeds of single shapes, which a new seed leaves alone; by index. */
  seeds?: Record<string, number>;
}

interface Remembered {
  main: string;
  places: Record<string, Place>;
}

export interface Toast {
  text: string;
  action?: { label: string; run: () => void };
}

const RULES = /\.(cga|gbbg|grammar|pg3d|park)$/;
const SHAPES = /\.(geojson|obj|glb|gltf)$/;
const MEMORY = 'studio.json';
const HISTORY = 'history.json';
/** A derivation younger than this is waited for: pictures come in while a slider is dragged. */
const PATIENCE_MS = 350;
const TREE_AFTER_MS = 250;
const WORTH_TELLING_MS = 100;
const MOST_TREE_SHAPES = 300_000;

/** What was there where nothing of it has changed, so that no panel is drawn anew. */
function sameOr<T>(before: T, now: T): T {
  return JSON.stringify(before) === JSON.stringify(now) ? before : now;
}

/**
 * A file that is imported with values of its own is listed once more: the first of a name counts.
 */
function once<T>(all: T[], key: (one: T) => string): T[] {
  const seen = new Set<string>();
  return all.filter((one) => seen.size !== seen.add(key(one)).size);
}

export function newPlace(): Place {
  return { start: '', seed: 0, attributes: {}, shapes: { lot: [20, 30] } };
}

export class Studio {
  readonly client = new EngineClient();
  private readonly recovery = new Recovery(this.client, this.client.tab);
  page = $state<Page>('rules');
  theme = $state<Theme>('dark');
  name = $state('');
  files = $state.raw<ProjectFile[]>([]);
  docs = $state<Doc[]>([]);
  main = $state('');
  active = $state('');
  place = $state<Place>(newPlace());
  examples = $state.raw<Example[]>([]);
  registry = $state.raw<Entry[]>([]);
  ready = $state(false);
  connected = $state(true);
  /** What could not be done at all, in a sentence. */
  trouble = $state('');
  toast = $state.raw<Toast | null>(null);

  rules = $state.raw<RuleInfo[]>([]);
  startRule = $state('');
  attributes = $state.raw<AttributeInfo[]>([]);
  values = $state.raw<Record<string, Value>>({});
  messages = $state.raw<Message[]>([]);
  stats = $state.raw<Stats | null>(null);
  derivation = $state(0);
  /** The derivation that the shapes belong to: they come a little later. */
  shapesOf = $state(0);
  end = $state<Derived['end'] | ''>('');
  /** When the model that is shown was made, where later rules had errors. */
  lastGood = $state('');
  /** When the derivation under way began; 0 for none, or for one that has only just begun. */
  deriving = $state(0);
  progress = $state.raw<{ done: number; total: number } | null>(null);
  shapes = $state.raw<Shapes | null>(null);
  selected = $state(-1);
  /** What is selected where there are too many shapes for a tree. */
  far = $state.raw<Far | null>(null);
  hovered = $state(-1);
  /** Pictures a second while the view moves. */
  fps = $state(0);
  /** What undo and redo would take back or do again; empty for nothing. */
  undoLabel = $state('');
  redoLabel = $state('');

  /** Other shapes stand elsewhere: the next model is framed. */
  reframe = false;

  /** Set by the view and the editor. */
  show: ((draw: DrawList, stats: Stats, lives?: Float32Array | null) => void) | null = null;
  reveal: ((file: string, line: number, column?: number, focus?: boolean) => void) | null = null;

  readonly guide = new Guide(this);

  readonly groups = $derived<Group[]>(groupFields(this.attributes));
  readonly errors = $derived(this.messages.filter((m) => m.severity === 'error').length);
  readonly warnings = $derived(this.messages.filter((m) => m.severity === 'warning').length);
  readonly ruleFiles = $derived(this.files.filter((f) => RULES.test(f.path)));
  readonly shapeFiles = $derived(this.files.filter((f) => SHAPES.test(f.path)));

  private latest: { draw: DrawList; stats: Stats } | null = null;
  private places: Record<string, Place> = {};
  private address: string[] = [];
  private running: { abort: AbortController; began: number } | null = null;
  private again = false;
  private treeAbort: AbortController | null = null;
  private treeTimer = 0;
  private keepTimer = 0;
  private toastTimer = 0;
  private pollDelay = 2000;
  private readonly history = new History();

  async open(): Promise<void> {
    this.theme = localStorage.getItem('gable.theme') === 'light' ? 'light' : 'dark';
    try {
      const [project, ops] = await Promise.all([this.client.project(), this.client.ops()]);
      this.name = project.name;
      this.files = project.files;
      this.registry = readRegistry(ops);
      await this.recall();
      const first =
        this.ruleFiles.find((f) => f.path === this.main) ??
        this.ruleFiles.find((f) => !/^(.*\/)?rules\//.test(f.path)) ??
        this.ruleFiles[0];
      if (first) await this.openRules(first.path);
      else this.page = 'gallery';
      this.ready = true;
      if (location.hash.startsWith('#share=')) await this.openLink();
      void this.client.examples().then((examples) => (this.examples = examples));
      this.poll();
    } catch (error) {
      this.trouble =
        error instanceof Refusal && error.status === 401
          ? 'This page needs the address that gable studio printed, with its token.'
          : `The studio could not be reached: ${String(error)}`;
    }
  }

  /** The address of the page is a link to a shared place. */
  private async openLink(): Promise<void> {
    const link = location.hash;
    history.replaceState(null, '', location.pathname);
    const { openShared } = await import('./sharing');
    const said = await openShared(this, link);
    if (said) this.say(said);
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

  doc(path: string): Doc | undefined {
    return this.docs.find((d) => d.path === path);
  }

  dirty(path: string): boolean {
    const doc = this.doc(path);
    return !!doc && doc.text !== doc.saved;
  }

  /** Opens a rule file as the one that is derived. */
  async openRules(path: string, place?: Place): Promise<void> {
    await this.openFile(path);
    this.main = path;
    this.place = place ?? this.places[path] ?? newPlace();
    this.shapes = this.far = null;
    this.selected = -1;
    this.address = [];
    this.page = 'rules';
    this.reframe = true;
    // What other rules have made, or are about to, is not shown for these.
    this.latest = null;
    this.running?.abort.abort();
    this.changed();
  }

  async openFile(path: string): Promise<void> {
    await this.loadFile(path);
    this.active = path;
  }

  /** Opens a file without going there. */
  async loadFile(path: string): Promise<void> {
    if (this.doc(path)) return;
    const file = await this.client.read(path);
    const { text, aside } = await this.recovery.recall(path, file.text);
    if (this.doc(path)) return;
    this.docs.push({ path, text, saved: file.text, version: file.version });
    const other = aside[0];
    if (other === undefined) return;
    this.say(`Another page had other edits of ${path}`, {
      label: 'Take those',
      run: () => this.edit(path, other, 'Take the other edits'),
    });
  }

  closeFile(path: string): void {
    if (path === this.main) return;
    this.docs = this.docs.filter((d) => d.path !== path);
    if (this.active === path) this.active = this.main;
  }

  /** The text of a file has changed in the editor. A label makes it a step of its own. */
  edit(path: string, text: string, label = ''): void {
    this.editAll([[path, text]], label);
  }

  /** The same for several files, as one step. */
  editAll(texts: [string, string][], label = '', group = ''): void {
    const step: Step = { label: label || 'Typing', texts: [], place: null };
    for (const [path, text] of texts) {
      const doc = this.doc(path);
      const change = doc && difference(path, doc.text, text);
      if (!doc || !change) continue;
      doc.text = text;
      step.texts.push(change);
    }
    if (!step.texts.length) return;
    const line = !label && step.texts.some((t) => t.inserted.includes('\n'));
    this.history.record(step, group || (label || line ? '' : `text ${step.texts[0]!.path}`));
    this.countSteps();
    this.changed();
  }

  async save(path = this.active): Promise<void> {
    const doc = this.doc(path);
    if (!doc) return;
    const text = doc.text;
    try {
      doc.version = await this.client.write(path, text, doc.version);
      doc.saved = text;
      await this.recovery.drop(path);
      this.say(`Saved ${path}`);
    } catch (error) {
      if (error instanceof Refusal && error.code === 'version-differs') await this.conflict(doc);
      else this.trouble = `${path} could not be saved: ${(error as Error).message}`;
    }
  }

  async saveAll(): Promise<void> {
    for (const doc of this.docs) if (doc.text !== doc.saved) await this.save(doc.path);
  }

  conflictOf = $state<{ path: string; theirs: string; version: string } | null>(null);

  private async conflict(doc: Doc): Promise<void> {
    const { text, version } = await this.client.read(doc.path);
    if (this.join(doc, text, version)) await this.save(doc.path);
  }

  /** Takes what others wrote into what is edited here; asks where both changed the same lines. */
  private join(doc: Doc, theirs: string, version: string): boolean {
    const merged = merge(doc.saved, doc.text, theirs);
    if (merged.conflicts) {
      this.conflictOf = { path: doc.path, theirs, version };
      return false;
    }
    const edited = doc.text !== doc.saved;
    doc.text = merged.text;
    doc.saved = theirs;
    doc.version = version;
    this.say(
      edited
        ? `${doc.path} was changed elsewhere; both edits are in it now`
        : `${doc.path} was changed elsewhere and read again`,
    );
    this.changed();
    return true;
  }

  /**
   * Ends a conflict: with what the editor says or with a text of both, or with what the file says.
   */
  async resolve(mine: boolean, text?: string): Promise<void> {
    const conflict = this.conflictOf;
    const doc = conflict && this.doc(conflict.path);
    this.conflictOf = null;
    if (!conflict || !doc) return;
    doc.version = conflict.version;
    doc.saved = conflict.theirs;
    if (text !== undefined) this.edit(doc.path, text, 'Join both edits');
    if (mine) return this.save(doc.path);
    doc.text = conflict.theirs;
    await this.recovery.drop(doc.path);
    this.changed();
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
    this.history.record({ label, texts: [], place: { main: this.main, before, after } }, group);
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

  private async restore(step: Step | null, verb: string): Promise<void> {
    if (!step) return;
    for (const path of new Set(step.texts.map((t) => t.path)))
      await this.loadFile(path).catch(() => undefined);
    let lost = false;
    for (const change of step.texts) {
      const doc = this.doc(change.path);
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
    else if (step.label !== 'Typing') this.say(`${verb}: ${step.label}`);
    this.changed();
  }

  private changed(): void {
    clearTimeout(this.keepTimer);
    this.keepTimer = window.setTimeout(() => void this.keep(), 250);
    this.derive();
  }

  /** What would be lost with this page goes to the server. */
  private async keep(): Promise<void> {
    this.places = { ...this.places, [this.main]: $state.snapshot(this.place) };
    const memory: Remembered = { main: this.main, places: this.places };
    try {
      await this.client.keepRecovery(MEMORY, JSON.stringify(memory));
      await this.client.keepRecovery(HISTORY, this.history.keep());
      for (const doc of this.docs) {
        await this.recovery.keep(doc.path, doc.text, doc.saved);
      }
      this.connected = true;
    } catch (error) {
      if (!(error instanceof Refusal)) this.connected = false;
    }
  }

  /** What would be derived with other parts of the place. */
  requestFor(part: Partial<Place>): DeriveRequest {
    return { ...this.request(), ...part };
  }

  private request(): DeriveRequest {
    const overlay: Record<string, string> = {};
    for (const doc of this.docs)
      if (doc.path !== this.main && doc.text !== doc.saved) overlay[doc.path] = doc.text;
    const place = $state.snapshot(this.place);
    return {
      page: this.client.page,
      file: this.main,
      text: this.doc(this.main)?.text ?? '',
      overlay,
      ...place,
    };
  }

  /**
   * Asks for a new model; a younger one that is under way comes first, an older one is given up.
   */
  derive(): void {
    if (!this.main) return;
    clearTimeout(this.treeTimer);
    this.treeAbort?.abort();
    if (this.running) {
      this.again = true;
      if (performance.now() - this.running.began > PATIENCE_MS) this.running.abort.abort();
      return;
    }
    void this.deriveNow();
  }

  private async deriveNow(): Promise<void> {
    this.again = false;
    const run = { abort: new AbortController(), began: performance.now() };
    this.running = run;
    const late = window.setTimeout(() => (this.deriving = run.began), WORTH_TELLING_MS);
    const watch = window.setInterval(() => void this.watchProgress(run.began), 500);
    const impatient = window.setInterval(() => {
      if (this.again && performance.now() - run.began > PATIENCE_MS) run.abort.abort();
    }, 50);
    try {
      const { derived, draw } = await this.client.derive(this.request(), run.abort.signal);
      this.connected = true;
      this.take(derived, draw);
    } catch (error) {
      if (error instanceof Refusal) {
        this.messages = [{ severity: 'error', code: error.code, message: error.message }];
        this.end = 'wrong';
      } else if (!run.abort.signal.aborted) this.connected = false;
    } finally {
      clearTimeout(late);
      clearInterval(watch);
      clearInterval(impatient);
      this.running = null;
      this.deriving = 0;
      this.progress = null;
    }
    if (this.again) void this.deriveNow();
  }

  private async watchProgress(began: number): Promise<void> {
    if (performance.now() - began < 900) return;
    try {
      this.progress = await this.client.progress();
    } catch {
      this.progress = null;
    }
  }

  /** Gives up the derivation under way; the picture stays. */
  cancel(): boolean {
    if (!this.running) return false;
    this.again = false;
    this.running.abort.abort();
    return true;
  }

  private take(derived: Derived, draw: DrawList | null): void {
    if (derived.end === 'cancelled') return;
    if (derived.messages.length || this.messages.length) this.messages = derived.messages;
    const wasGood = this.end !== 'wrong';
    this.end = derived.end;
    if (derived.end === 'wrong' || !draw || !derived.stats) {
      if (wasGood && this.stats) this.lastGood = new Date().toLocaleTimeString('en-GB');
      return;
    }
    this.far = null;
    this.rules = sameOr(
      this.rules,
      once(derived.rules, (r) => `${r.name} ${r.parameters}`),
    );
    this.startRule = derived.startRule;
    this.attributes = sameOr(
      this.attributes,
      once(derived.attributes, (a) => a.name),
    );
    this.values = sameOr(this.values, derived.values ?? {});
    this.stats = derived.stats;
    this.derivation = derived.derivation ?? 0;
    this.lastGood = '';
    this.latest = { draw, stats: derived.stats };
    if (!this.guide.open) this.show?.(draw, derived.stats);
    if (derived.stats.shapes <= MOST_TREE_SHAPES) {
      this.treeTimer = window.setTimeout(
        () => void this.fetchTree(),
        this.guide.open ? 0 : TREE_AFTER_MS,
      );
    } else if (this.guide.open) this.treeTimer = window.setTimeout(() => void this.fetchTree(), 0);
    else {
      this.shapes = null;
      this.selected = -1;
    }
  }

  private async fetchTree(): Promise<void> {
    this.treeAbort?.abort();
    const abort = new AbortController();
    this.treeAbort = abort;
    const steps = this.guide.open;
    const { derivation } = this;
    try {
      const { tree, draw } = await this.client.tree(this.request(), abort.signal, steps);
      if (abort.signal.aborted || steps !== this.guide.open || tree.end === 'wrong') return;
      const shapes = new Shapes(tree);
      this.shapes = shapes;
      this.far = null;
      this.shapesOf = derivation;
      this.selected = this.address.length ? shapes.find(this.address) : -1;
      this.hovered = -1;
      if (steps && draw) {
        this.guide.take(shapes, draw, tree.end === 'limit');
        this.showAgain();
      }
    } catch {
      // The next derivation asks again.
    }
  }

  /** Too many shapes for a tree: the guide has the first steps. */
  get huge(): boolean {
    return (this.stats?.shapes ?? 0) > MOST_TREE_SHAPES;
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
    if (!this.latest || (!this.shapes && !this.huge)) return;
    if (this.guide.open) {
      this.guide.close();
      this.showAgain();
      // The shapes of the first steps are not those of the model.
      if (this.huge) {
        this.shapes = null;
        this.selected = -1;
        return;
      }
    } else this.guide.open = true;
    this.far = null;
    void this.fetchTree();
  }

  select(node: number, reveal = true): void {
    this.selected = node;
    this.guide.follow(node);
    this.address = node >= 0 && this.shapes ? this.shapes.address(node) : [];
    if (reveal && node >= 0) this.revealShape(node);
  }

  revealShape(node: number): void {
    const shapes = this.shapes;
    if (!shapes) return;
    const file = shapes.tree.files[shapes.tree.file[node]!] ?? '';
    const place = this.ruleOf(node);
    this.reveal?.(place?.file ?? file, place?.line ?? shapes.tree.line[node]!);
  }

  /** The rule that a shape is to be rewritten by: the one of its name. */
  ruleOf(node: number): RuleInfo | undefined {
    const name = this.shapes?.nameOf(node);
    return (
      this.rules.find((r) => r.name === name) ?? this.rules.find((r) => r.name.endsWith(`.${name}`))
    );
  }

  /** Selects a leaf of a model with too many shapes for a tree; -1 for none. */
  async selectFar(leaf: number): Promise<void> {
    const { derivation } = this;
    const info = leaf < 0 ? null : await this.client.leaf(derivation, leaf).catch(() => null);
    if (derivation !== this.derivation) return;
    this.goFar(info ? new Far(leaf, info) : null);
  }

  goFar(far: Far | null): void {
    this.far = far;
    if (!far) return;
    const rule = far.isLeaf
      ? undefined
      : (this.rules.find((r) => r.name === far.name) ??
        this.rules.find((r) => r.name.endsWith(`.${far.name}`)));
    this.reveal?.(rule?.file ?? far.info.file ?? '', rule?.line ?? far.info.line ?? 1);
  }

  selectAbove(): void {
    if (this.far) return this.goFar(this.far.up);
    if (!this.shapes || this.selected < 0) return;
    const path = this.shapes.pathTo(this.selected);
    this.select(path.length > 1 ? path[path.length - 2]! : -1);
  }

  /** The initial shape of the selection; -1 without one. */
  get selectedLot(): number {
    return this.selected >= 0 && this.shapes ? this.shapes.tree.shape[this.selected]! : -1;
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
    const several = (this.shapes?.roots.length ?? 0) > 1;
    this.setSeed(seed, !all && several ? this.selectedLot : -1);
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    localStorage.setItem('gable.theme', theme);
  }

  async format(): Promise<void> {
    const doc = this.doc(this.active);
    if (!doc) return;
    const { text, messages } = await this.client.format(doc.path, doc.text);
    if (messages.some((m) => m.severity === 'error'))
      this.say('Text with errors is not formatted.');
    else this.edit(doc.path, text, 'Format');
  }

  async refreshFiles(): Promise<void> {
    this.files = (await this.client.project()).files;
  }

  async newRules(): Promise<void> {
    let path = 'rules.cga';
    for (let i = 2; this.files.some((f) => f.path === path); ++i) path = `rules-${i}.cga`;
    const text =
      'attr height = 12\n\n@StartRule\nLot -->\n    extrude(height)\n    color("#e6dac5")\n    Building\n';
    await this.client.write(path, text, 'none');
    this.files = (await this.client.project()).files;
    await this.openRules(path);
  }

  async openExample(example: Example): Promise<void> {
    const folder = await this.client.copyExample(example.name);
    this.files = (await this.client.project()).files;
    const place = newPlace();
    const words = example.arguments.split(/\s+/);
    const lot = /^(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)$/.exec(words[words.indexOf('--lot') + 1] ?? '');
    if (lot && words.includes('--lot')) place.shapes = { lot: [Number(lot[1]), Number(lot[2])] };
    if (words.includes('--seed')) place.seed = Number(words[words.indexOf('--seed') + 1]) || 0;
    if (example.shapes) place.shapes = { file: `${folder}/buildings.geojson` };
    await this.openRules(`${folder}/${example.name}.${example.notation}`, place);
    this.say(`Opened a copy in ${folder}`);
  }

  say(text: string, action?: Toast['action']): void {
    this.toast = action ? { text, action } : { text };
    clearTimeout(this.toastTimer);
    this.toastTimer = window.setTimeout(() => (this.toast = null), 5000);
  }

  /** Sees files that others change, and whether the server is there. */
  private poll(): void {
    window.setTimeout(() => void this.look().then(() => this.poll()), this.pollDelay);
  }

  private async look(): Promise<void> {
    if (document.hidden) return;
    try {
      const before = new Map(this.files.map((f) => [f.path, f.stamp]));
      const { files } = await this.client.project();
      this.files = files;
      if (!this.connected) {
        this.connected = true;
        void this.keep();
        this.derive();
      }
      this.pollDelay = 2000;
      for (const f of files) {
        const known = before.get(f.path);
        if (known !== undefined && known !== f.stamp) await this.changedElsewhere(f.path);
      }
    } catch (error) {
      if (error instanceof Refusal) return;
      this.connected = false;
      this.pollDelay = Math.min(10_000, this.pollDelay * 2);
    }
  }

  private async changedElsewhere(path: string): Promise<void> {
    const doc = this.doc(path);
    if (!doc) return;
    const { text, version } = await this.client.read(path);
    if (version === doc.version) return;
    this.join(doc, text, version);
  }
}
