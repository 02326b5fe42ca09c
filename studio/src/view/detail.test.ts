// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import * as THREE from 'three';
import { expect, it } from 'vitest';
import { Detail } from './detail';

const COUNT = 60_000;

/** Boxes of 0.1 to 10 m over a square kilometre. */
function boxes(): THREE.InstancedMesh {
  const geometry = new THREE.BoxGeometry(1, 1, 1);
  geometry.setAttribute(
    'tint',
    new THREE.InstancedBufferAttribute(new Uint8Array(COUNT * 4), 4, true),
  );
  const leaf = Float32Array.from({ length: COUNT }, (_, i) => i);
  geometry.setAttribute('leaf', new THREE.InstancedBufferAttribute(leaf, 1));
  const mesh = new THREE.InstancedMesh(geometry, new THREE.MeshBasicMaterial(), COUNT);
  for (let i = 0; i < COUNT; ++i) {
    const size = 0.1 * 10 ** ((i * 0.61803) % 2);
    const m = new THREE.Matrix4().makeScale(size, size, size);
    m.setPosition((i * 7919) % 1000, size / 2, (i * 104729) % 997);
    mesh.setMatrixAt(i, m);
  }
  return mesh;
}

function camera(height: number): THREE.PerspectiveCamera {
  const out = new THREE.PerspectiveCamera(40, 16 / 9, 0.1, 5000);
  out.position.set(500, height, 500);
  out.up.set(0, 0, -1);
  out.lookAt(500, 0, 500);
  out.updateMatrixWorld();
  return out;
}

const leaves = (mesh: THREE.InstancedMesh) => {
  const all = (mesh.geometry.getAttribute('leaf') as THREE.InstancedBufferAttribute)
    .array as Float32Array;
  return [...all.subarray(0, mesh.count)];
};

it('leaves small models alone', async () => {
  expect(
    await Detail.of([{ mesh: new THREE.Mesh(new THREE.BoxGeometry()) }], () => false),
  ).toBeNull();
});

it('takes what is in sight and large enough, each once', async () => {
  const mesh = boxes();
  const detail = (await Detail.of([{ mesh }], () => false))!;
  detail.select(camera(1200), 720, 1e9);
  const far = leaves(mesh);
  expect(new Set(far).size).toBe(far.length);
  expect(far.length).toBeGreaterThan(1000);
  expect(far.length).toBeLessThan(COUNT * 0.6);
  detail.select(camera(20), 720, 1e9);
  const near = leaves(mesh);
  // From 20 m a strip of some 15 by 26 m is in sight, and cells are larger.
  expect(near.length).toBeLessThan(COUNT * 0.1);
  const small = Math.min(...near.map((i) => 0.1 * 10 ** ((i * 0.61803) % 2)));
  expect(small).toBeLessThan(0.3);
});

it('keeps within its budget', async () => {
  const mesh = boxes();
  const detail = (await Detail.of([{ mesh }], () => false))!;
  detail.select(camera(1200), 720, 50_000);
  expect(mesh.count * 12).toBeLessThanOrEqual(50_000);
  expect(mesh.count).toBeGreaterThan(100);
});

it('moves each instance with its number', async () => {
  const mesh = boxes();
  const detail = (await Detail.of([{ mesh }], () => false))!;
  detail.select(camera(900), 720, 1e9);
  const m = new THREE.Matrix4();
  leaves(mesh)
    .slice(0, 200)
    .forEach((leaf, k) => {
      mesh.getMatrixAt(k, m);
      expect(m.elements[12]).toBeCloseTo((leaf * 7919) % 1000, 3);
    });
});

/** One mesh of 20000 leaves, each a quad of 0.2 to 6 m, over a square kilometre. */
function quads(): THREE.Mesh {
  const n = 20_000;
  const [position, leaf, index] = [
    new Float32Array(n * 12),
    new Float32Array(n * 4),
    new Uint32Array(n * 6),
  ];
  for (let i = 0; i < n; ++i) {
    const side = 0.2 * 30 ** ((i * 0.61803) % 1);
    const [x, z] = [(i * 7919) % 1000, (i * 104729) % 997];
    [
      [0, 0],
      [side, 0],
      [side, side],
      [0, side],
    ].forEach(([u, v], k) => {
      position.set([x + u!, 1, z + v!], (i * 4 + k) * 3);
      leaf[i * 4 + k] = i;
    });
    index.set(
      [0, 1, 2, 0, 2, 3].map((k) => i * 4 + k),
      i * 6,
    );
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(position, 3));
  geometry.setAttribute('leaf', new THREE.BufferAttribute(leaf, 1));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return new THREE.Mesh(geometry, new THREE.MeshBasicMaterial());
}

it('takes whole leaves of merged meshes', async () => {
  const mesh = quads();
  const detail = (await Detail.of([{ mesh: boxes() }, { mesh }], () => false))!;
  const drawnLeaves = () => {
    const { geometry } = mesh;
    const corners = (geometry.index!.array as Uint32Array).subarray(0, geometry.drawRange.count);
    const leaf = geometry.getAttribute('leaf').array as Float32Array;
    const counts = new Map<number, number>();
    for (const c of corners) counts.set(leaf[c]!, (counts.get(leaf[c]!) ?? 0) + 1);
    return counts;
  };
  detail.select(camera(1200), 720, 1e9);
  const far = drawnLeaves();
  expect([...far.values()].every((corners) => corners === 6)).toBe(true);
  expect(far.size).toBeGreaterThan(500);
  expect(far.size).toBeLessThan(16_000);
  detail.select(camera(1200), 720, 2000);
  expect(drawnLeaves().size * 2).toBeLessThan(2000);
  detail.select(camera(20), 720, 1e9);
  const near = drawnLeaves();
  expect(near.size).toBeGreaterThan(10);
  expect(near.size).toBeLessThan(3000);
});
