// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Model: what the engine last made of the rules, and the derivations on the way to it. A broken
// rule leaves the model before as it is; other rules begin without one.

import { Refusal, type DeriveRequest, type EngineClient } from './client';
import { groupFields, type Group } from './fields';
import type {
  AttributeInfo,
  Derived,
  DrawList,
  Diagnostic,
  RuleInfo,
  Stats,
  Tree,
  Value,
} from './protocol';
import { Parts } from './parts.svelte';
import { Shapes } from './tree';

/** A derivation younger than this is waited for: pictures come in while a slider is dragged. */
const PATIENCE_MS = 350;
const TREE_AFTER_MS = 250;
const WORTH_TELLING_MS = 100;
const MOST_TREE_SHAPES = 300_000;

/** What was there where nothing of it has changed, so that no panel is drawn anew. */
function sameOr<T>(before: T, now: T): T {
  return JSON.stringify(before) === JSON.stringify(now) ? before : now;
}

/** A file that is imported with values of its own is listed once more: the first counts. */
function once<T>(all: T[], key: (one: T) => string): T[] {
  const seen = new Set<string>();
  return all.filter((one) => seen.size !== seen.add(key(one)).size);
}

/** What a model needs of the page around it. */
export interface ModelHost {
  readonly client: EngineClient;
  /** Null where there are no rules. */
  request(): DeriveRequest | null;
  /** The tree is to have the shapes of all steps. */
  readonly steps: boolean;
  /** The server has answered, or has not. */
  found(): void;
  lost(): void;
  /** There is another model. */
  derived(draw: DrawList, stats: Stats): void;
  /** There is no model of these rules. */
  none(): void;
  /** The tree of the model, with a draw list of its steps where they were asked for. */
  grown(shapes: Shapes, draw: DrawList | null, end: Tree['end']): void;
  /** There are too many shapes for a tree at once. */
  treeless(): void;
}

interface Run {
  abort: AbortController;
  began: number;
}

export class Model {
  rules = $state.raw<RuleInfo[]>([]);
  startRule = $state('');
  styles = $state.raw<string[]>([]);
  attributes = $state.raw<AttributeInfo[]>([]);
  values = $state.raw<Record<string, Value>>({});
  /** What attributes were when nobody had set them. */
  defaults = $state.raw<Record<string, Value>>({});
  diagnostics = $state.raw<Diagnostic[]>([]);
  stats = $state.raw<Stats | null>(null);
  derivation = $state(0);
  end = $state<Derived['end'] | ''>('');
  /** When the model that is shown was made, where later rules had errors. */
  lastGood = $state('');
  /** When the derivation under way began; 0 for none, or for one that has only just begun. */
  deriving = $state(0);
  progress = $state.raw<{ done: number; total: number } | null>(null);
  shapes = $state.raw<Shapes | null>(null);
  /** The tree where there are too many shapes for all at once. */
  parts = $state.raw<Parts | null>(null);
  /** The derivation that the shapes belong to: they come a little later. */
  shapesOf = $state(0);
  /** What attributes were when the shapes were made. */
  shapesValues = $state.raw<Record<string, Value>>({});

  readonly groups = $derived<Group[]>(groupFields(this.attributes, this.values));
  readonly errors = $derived(this.diagnostics.filter((m) => m.severity === 'error').length);
  readonly warnings = $derived(this.diagnostics.filter((m) => m.severity === 'warning').length);
  /** Too many shapes for a tree at once: the guide has the first steps. */
  readonly huge = $derived((this.stats?.shapes ?? 0) > MOST_TREE_SHAPES);

  private running: Run | null = null;
  private again = false;
  /** The rules are others than those of the model that is shown. */
  private fresh = true;
  private treeAbort: AbortController | null = null;
  private treeTimer = 0;

  constructor(private readonly host: ModelHost) {}

  /** Other rules are derived from now on; their first answer decides what is shown. */
  begin(): void {
    this.fresh = true;
    this.shapes = null;
    this.parts = null;
    this.running?.abort.abort();
  }

  /**
   * Asks for a new model; a younger one that is under way comes first, an older one is given up.
   */
  derive(): void {
    if (!this.host.request()) return;
    clearTimeout(this.treeTimer);
    this.treeAbort?.abort();
    if (this.running) {
      this.again = true;
      if (performance.now() - this.running.began > PATIENCE_MS) this.running.abort.abort();
      return;
    }
    void this.deriveNow();
  }

  /** Gives up the derivation under way; the picture stays. */
  cancel(): boolean {
    if (!this.running) return false;
    this.again = false;
    this.running.abort.abort();
    return true;
  }

  /** Asks for the tree of the model. */
  async fetchTree(): Promise<void> {
    const request = this.host.request();
    if (!request) return;
    this.treeAbort?.abort();
    const abort = new AbortController();
    this.treeAbort = abort;
    const { steps } = this.host;
    const { derivation, values } = this;
    try {
      const { tree, draw } = await this.host.client.tree(request, abort.signal, steps);
      if (abort.signal.aborted || steps !== this.host.steps || tree.end === 'wrong') return;
      this.shapes = new Shapes(tree);
      this.shapesOf = derivation;
      this.shapesValues = values;
      this.host.grown(this.shapes, draw, tree.end);
    } catch {
      // The next derivation asks again.
    }
  }

  /** The rule of a name, its own or an imported one. */
  ruleNamed(name: string | undefined): RuleInfo | undefined {
    if (!name) return undefined;
    return (
      this.rules.find((r) => r.name === name) ?? this.rules.find((r) => r.name.endsWith(`.${name}`))
    );
  }

  /** The rule that a shape is to be rewritten by: the one of its name. */
  ruleOf(node: number): RuleInfo | undefined {
    return this.ruleNamed(this.shapes?.nameOf(node));
  }

  private async deriveNow(): Promise<void> {
    const request = this.host.request();
    if (!request) return;
    this.again = false;
    const run: Run = { abort: new AbortController(), began: performance.now() };
    this.running = run;
    const late = window.setTimeout(() => (this.deriving = run.began), WORTH_TELLING_MS);
    const watch = window.setInterval(() => void this.watchProgress(run.began), 500);
    const impatient = window.setInterval(() => {
      if (this.again && performance.now() - run.began > PATIENCE_MS) run.abort.abort();
    }, 50);
    try {
      const { derived, draw } = await this.host.client.derive(request, run.abort.signal);
      this.host.found();
      if (!run.abort.signal.aborted) this.take(request, derived, draw);
    } catch (error) {
      if (error instanceof Refusal && error.status !== 401) this.refused(error);
      else if (!run.abort.signal.aborted) this.host.lost();
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

  private refused(error: Refusal): void {
    this.diagnostics = [{ severity: 'error', code: error.code, message: error.message }];
    this.failed();
  }

  private async watchProgress(began: number): Promise<void> {
    if (performance.now() - began < 900) return;
    try {
      this.progress = await this.host.client.progress();
    } catch {
      this.progress = null;
    }
  }

  /** The rules have no model now: the one before stays, if it is one of these rules. */
  private failed(): void {
    const wasGood = this.end !== 'wrong';
    this.end = 'wrong';
    if (this.fresh) this.clear();
    else if (wasGood && this.stats) this.lastGood = new Date().toLocaleTimeString('en-GB');
  }

  private clear(): void {
    this.fresh = false;
    this.rules = [];
    this.styles = [];
    this.attributes = [];
    this.values = {};
    this.defaults = {};
    this.stats = null;
    this.derivation = 0;
    this.parts = null;
    this.lastGood = this.startRule = '';
    this.host.none();
  }

  private take(request: DeriveRequest, derived: Derived, draw: DrawList | null): void {
    if (derived.end === 'cancelled') return;
    if (derived.diagnostics.length || this.diagnostics.length)
      this.diagnostics = derived.diagnostics;
    if (derived.end === 'wrong' || !draw || !derived.stats) return this.failed();
    // Rules that reach a limit before they have made anything are no reason to empty the view.
    if (derived.end === 'limit' && draw.leaves === 0) {
      this.failed();
      this.end = 'limit';
      return;
    }
    this.fresh = false;
    this.end = derived.end;
    const rules = once(derived.rules, (r) => `${r.name} ${r.parameters}`);
    this.rules = sameOr(this.rules, rules);
    this.startRule = derived.startRule;
    this.styles = sameOr(this.styles, derived.styles);
    const attributes = once(derived.attributes, (a) => a.name);
    this.attributes = sameOr(this.attributes, attributes);
    this.values = sameOr(this.values, derived.values ?? {});
    const unset = Object.entries(this.values).filter(([name]) => !(name in request.attributes));
    this.defaults = { ...this.defaults, ...Object.fromEntries(unset) };
    this.stats = derived.stats;
    this.derivation = derived.derivation ?? 0;
    this.lastGood = '';
    this.host.derived(draw, derived.stats);
    const now = this.host.steps;
    if (!this.huge || now) {
      this.treeTimer = window.setTimeout(() => void this.fetchTree(), now ? 0 : TREE_AFTER_MS);
    } else {
      this.shapes = null;
      this.host.treeless();
    }
    const { derivation } = this;
    this.parts = this.huge
      ? new Parts((leaf, level) => this.host.client.parts(derivation, leaf, level))
      : null;
  }
}
