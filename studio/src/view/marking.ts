// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Marking: what is drawn over a model to point at its parts. Outlines around the leaves that are
// selected or under the pointer, boxes of scopes, and ghosts of what a step has replaced. Setters
// say whether anything has changed.

import * as THREE from 'three';
import { emptyGroup, ghostBox, manyScopes, scopeLines, type ScopeBox } from './boxes';
import type { LeafPicture } from './leaf_picture';
import { outlineMaterial, type Marks } from './shading';
import type { ViewColors } from './surroundings';

/** Leaves by their numbers; without the last. */
export interface Range {
  from: number;
  to: number;
}

const NOTHING: Range = { from: 0, to: 0 };

function same(a: Range, b: Range): boolean {
  return a.from === b.from && a.to === b.to;
}

export class Marking {
  /** What the materials of a model know of it. */
  readonly marks: Marks = {
    selected: { value: new THREE.Vector2() },
    accent: { value: new THREE.Color() },
    lit: { value: 0 },
    guideStep: { value: 1e9 },
  };
  /** The groups of boxes, for the scene. */
  readonly boxes: THREE.Group[];

  private readonly overlay = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), outlineMaterial());
  private readonly scope = new THREE.Group();
  private readonly scopes = new THREE.Group();
  private readonly ghosts = new THREE.Group();
  private readonly ghostColor = new THREE.Color();
  private selected = NOTHING;
  private hovered = NOTHING;

  constructor() {
    this.overlay.frustumCulled = false;
    this.boxes = [this.scope, this.scopes, this.ghosts];
  }

  /** Whether there is an outline to draw. */
  get outlines(): boolean {
    return this.selected.to > this.selected.from || this.hovered.to > this.hovered.from;
  }

  setColors(colors: ViewColors): void {
    this.ghostColor.set(colors.ghost);
    this.marks.accent.value.set(colors.accent);
    const uniforms = this.overlay.material.uniforms;
    (uniforms.accent!.value as THREE.Color).set(colors.accent);
    (uniforms.text!.value as THREE.Color).set(colors.text);
  }

  /** Pixels of the pictures that outlines are drawn over. */
  setSize(width: number, height: number): void {
    (this.overlay.material.uniforms.texel!.value as THREE.Vector2).set(1 / width, 1 / height);
  }

  select(range: Range | null): boolean {
    const next = range ?? NOTHING;
    if (same(next, this.selected)) return false;
    this.selected = next;
    this.marks.selected.value.set(next.from, next.to);
    return true;
  }

  hover(range: Range | null): boolean {
    const next = range ?? NOTHING;
    if (same(next, this.hovered)) return false;
    this.hovered = next;
    return true;
  }

  /** A box in the accent colour with its axes; null hides it. */
  setScope(box: ScopeBox | null): boolean {
    if (!box && !this.scope.children.length) return false;
    emptyGroup(this.scope);
    if (box) this.scope.add(...scopeLines(box, this.marks.accent.value));
    return true;
  }

  /** The scopes of many shapes, thinly. */
  setScopes(boxes: ScopeBox[]): boolean {
    if (!boxes.length && !this.scopes.children.length) return false;
    emptyGroup(this.scopes);
    if (boxes.length) this.scopes.add(manyScopes(boxes, this.marks.accent.value));
    return true;
  }

  /** A derivation as it is after a step, and what the step has replaced. */
  setStep(step: number, ghost: ScopeBox | null): boolean {
    const stays = step === this.marks.guideStep.value;
    if (stays && !ghost && !this.ghosts.children.length) return false;
    this.marks.guideStep.value = step;
    emptyGroup(this.ghosts);
    if (ghost) this.ghosts.add(...ghostBox(ghost, this.ghostColor));
    return true;
  }

  /** Outlines over what the canvas shows; `edges`: how dark leaves' edges are, 0 for none. */
  draw(
    renderer: THREE.WebGLRenderer,
    leaves: LeafPicture,
    camera: THREE.Camera,
    flat: THREE.Camera,
    edges: number,
  ): void {
    if (!(edges > 0) && !this.outlines) return;
    leaves.update(camera);
    const uniforms = this.overlay.material.uniforms;
    uniforms.leaves!.value = leaves.target.texture;
    (uniforms.selected!.value as THREE.Vector2).set(this.selected.from, this.selected.to);
    (uniforms.hovered!.value as THREE.Vector2).set(this.hovered.from, this.hovered.to);
    uniforms.edges!.value = edges;
    renderer.render(this.overlay, flat);
  }
}
