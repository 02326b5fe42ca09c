// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Navigation: how a person moves through a place. Orbit turns round the model, fly goes where one
// looks, walk stays at eye height over whatever is below: ground, streets, stairs.

import * as THREE from 'three';
import type { OrbitControls } from 'three/addons/controls/OrbitControls.js';

export type Mode = 'orbit' | 'fly' | 'walk';

export interface NavigationHost {
  readonly camera: THREE.PerspectiveCamera;
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  readonly centre: THREE.Vector3;
  readonly radius: number;
  /** The height of the first surface below a point; null where there is none. */
  heightBelow(at: THREE.Vector3): number;
  cameraMoved(): void;
}

/** Degrees from below to above: a person among houses sees more than one who looks at a model. */
const FIELD_OF_VIEW = { orbit: 28, fly: 48, walk: 62 } as const;

export const EYE_HEIGHT = 1.7;
/** What a step climbs. */
const KNEE = 0.6;
const WALK_SPEED = 4;
const LOOK_PER_PIXEL = 0.0035;
const TURN_SPEED = 1.4;
const STEEPEST = 1.5;

const FORWARD = ['KeyW', 'ArrowUp'];
const BACK = ['KeyS', 'ArrowDown'];
const LEFT = ['KeyA'];
const RIGHT = ['KeyD'];
const MOVES = new Set([
  ...FORWARD,
  ...BACK,
  ...LEFT,
  ...RIGHT,
  'KeyQ',
  'KeyE',
  'ArrowLeft',
  'ArrowRight',
  'PageUp',
  'PageDown',
]);

export class Navigation {
  mode: Mode = 'orbit';
  private yaw = 0;
  private pitch = 0;
  private readonly held = new Set<string>();
  private frame = 0;
  private last = 0;
  private drag: { x: number; y: number } | null = null;
  private standsOn = 0;
  private measured = new THREE.Vector3(Infinity, 0, 0);

  constructor(private readonly host: NavigationHost) {
    const { canvas } = host;
    canvas.addEventListener('pointerdown', this.onDown);
    canvas.addEventListener('pointermove', this.onMove);
    canvas.addEventListener('pointerup', this.onUp);
    canvas.addEventListener('wheel', this.onWheel, { passive: false });
    canvas.addEventListener('keydown', this.onKey);
    canvas.addEventListener('keyup', this.onKeyUp);
    canvas.addEventListener('blur', this.onBlur);
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    const { canvas } = this.host;
    canvas.removeEventListener('pointerdown', this.onDown);
    canvas.removeEventListener('pointermove', this.onMove);
    canvas.removeEventListener('pointerup', this.onUp);
    canvas.removeEventListener('wheel', this.onWheel);
    canvas.removeEventListener('keydown', this.onKey);
    canvas.removeEventListener('keyup', this.onKeyUp);
    canvas.removeEventListener('blur', this.onBlur);
  }

  setMode(mode: Mode): void {
    if (mode === this.mode) return;
    const { camera, controls, centre, radius } = this.host;
    const from = this.mode;
    this.mode = mode;
    controls.enabled = mode === 'orbit';
    camera.fov = FIELD_OF_VIEW[mode];
    this.held.clear();
    if (mode === 'orbit') {
      const ahead = camera.getWorldDirection(new THREE.Vector3());
      controls.target
        .copy(camera.position)
        .addScaledVector(ahead, Math.max(1, camera.position.distanceTo(centre)));
      controls.update();
      return;
    }
    const ahead = camera.getWorldDirection(new THREE.Vector3());
    this.yaw = Math.atan2(-ahead.x, -ahead.z);
    this.pitch = Math.asin(THREE.MathUtils.clamp(ahead.y, -1, 1));
    if (mode === 'walk') this.land(from === 'orbit', radius);
    this.apply();
  }

  /** Puts the feet on the ground, at the edge of the model where the camera was further out. */
  private land(fromOrbit: boolean, radius: number): void {
    const { camera, centre } = this.host;
    const out = new THREE.Vector3(camera.position.x - centre.x, 0, camera.position.z - centre.z);
    const far = radius * 1.6 + 10;
    if (out.length() > far || fromOrbit)
      camera.position.copy(centre).add(out.setLength(Math.min(out.length(), far)));
    camera.position.y = centre.y + radius + KNEE;
    this.pitch = 0.02;
    this.measured.x = Infinity;
    this.stand();
  }

  private stand(): void {
    const { camera } = this.host;
    const moved = Math.hypot(
      camera.position.x - this.measured.x,
      camera.position.z - this.measured.z,
    );
    if (moved > 0.35) {
      this.standsOn = this.host.heightBelow(
        camera.position.clone().setY(camera.position.y - EYE_HEIGHT + KNEE),
      );
      this.measured.copy(camera.position);
    }
    camera.position.y = this.standsOn + EYE_HEIGHT;
  }

  private apply(): void {
    const { camera } = this.host;
    camera.rotation.set(this.pitch, this.yaw, 0, 'YXZ');
    camera.updateMatrixWorld();
    this.host.cameraMoved();
  }

  private readonly onDown = (event: PointerEvent) => {
    if (this.mode === 'orbit') return;
    this.drag = { x: event.clientX, y: event.clientY };
    this.host.canvas.setPointerCapture(event.pointerId);
  };

  private readonly onMove = (event: PointerEvent) => {
    if (!this.drag) return;
    this.yaw += (event.clientX - this.drag.x) * LOOK_PER_PIXEL;
    this.pitch = THREE.MathUtils.clamp(
      this.pitch + (event.clientY - this.drag.y) * LOOK_PER_PIXEL,
      -STEEPEST,
      STEEPEST,
    );
    this.drag = { x: event.clientX, y: event.clientY };
    this.apply();
  };

  private readonly onUp = () => {
    this.drag = null;
  };

  private readonly onWheel = (event: WheelEvent) => {
    if (this.mode === 'orbit') return;
    event.preventDefault();
    this.go(
      new THREE.Vector3(0, 0, event.deltaY > 0 ? 1 : -1),
      this.mode === 'walk' ? 0.6 : this.host.radius / 40,
    );
  };

  private readonly onKey = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (this.mode === 'orbit' ? !this.orbitKey(event) : !MOVES.has(event.code)) return;
    event.preventDefault();
    event.stopPropagation();
    if (this.mode === 'orbit') return;
    this.held.add(event.code);
    if (event.shiftKey) this.held.add('Shift');
    else this.held.delete('Shift');
    if (this.frame) return;
    this.last = performance.now();
    this.frame = requestAnimationFrame(this.tick);
  };

  private readonly onKeyUp = (event: KeyboardEvent) => {
    this.held.delete(event.code);
    if (event.key === 'Shift') this.held.delete('Shift');
  };

  private readonly onBlur = () => this.held.clear();

  /** Arrows turn, with Shift they shift, plus and minus go nearer and away. */
  private orbitKey(event: KeyboardEvent): boolean {
    const { camera, controls } = this.host;
    const turn: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const by = turn[event.key];
    const offset = camera.position.clone().sub(controls.target);
    if (by && event.shiftKey) {
      const side = new THREE.Vector3().setFromMatrixColumn(camera.matrix, 0).multiplyScalar(by[0]);
      const shift = side
        .addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrix, 1), by[1])
        .multiplyScalar(offset.length() / 20);
      controls.target.add(shift);
      camera.position.add(shift);
    } else if (by) {
      const at = new THREE.Spherical().setFromVector3(offset);
      at.theta += (by[0] * Math.PI) / 24;
      at.phi = THREE.MathUtils.clamp(at.phi - (by[1] * Math.PI) / 36, 0.02, controls.maxPolarAngle);
      camera.position.copy(controls.target).add(offset.setFromSpherical(at));
    } else if (event.key === '+' || event.key === '=' || event.key === '-') {
      camera.position
        .copy(controls.target)
        .addScaledVector(offset, event.key === '-' ? 1.15 : 1 / 1.15);
    } else return false;
    controls.update();
    return true;
  }

  private readonly tick = (now: number) => {
    this.frame = 0;
    const seconds = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    const on = (keys: string[]) => (keys.some((k) => this.held.has(k)) ? 1 : 0);
    const fast = this.held.has('Shift') ? 3 : 1;
    const turn = on(['ArrowLeft']) - on(['ArrowRight']);
    const along = new THREE.Vector3(
      on(RIGHT) - on(LEFT),
      on(['KeyE', 'PageUp']) - on(['KeyQ', 'PageDown']),
      on(BACK) - on(FORWARD),
    );
    if (turn) this.yaw += turn * TURN_SPEED * seconds;
    const speed = this.mode === 'walk' ? WALK_SPEED : Math.max(4, this.host.radius / 3);
    if (turn || along.lengthSq() > 0) this.go(along, speed * fast * seconds);
    if ([...this.held].some((k) => MOVES.has(k))) this.frame = requestAnimationFrame(this.tick);
  };

  private go(along: THREE.Vector3, far: number): void {
    const { camera } = this.host;
    const walk = this.mode === 'walk';
    if (walk) along.y = 0;
    const turned = along.applyEuler(new THREE.Euler(walk ? 0 : this.pitch, this.yaw, 0, 'YXZ'));
    camera.position.addScaledVector(turned, far);
    if (walk) this.stand();
    this.apply();
  }
}
