// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { expect, it } from 'vitest';
import { referredBy } from './references';

const known = new Set([
  'house.cga',
  'rules/walls.cga',
  'assets/tree.glb',
  'assets/tiles/a.png',
  'assets/tiles/b.png',
  'models/window.obj',
  'models/window.mtl',
  'models/oak wood.png',
  'models/bump.png',
  'models/hall.gltf',
  'models/hall.bin',
  'models/hall wall.png',
]);

it('finds what rules name, whole or in parts', () => {
  const rules = `import w : "rules/walls.cga"
Lot --> i("models/window.obj") texture("assets/tiles/" + name + ".png") insert("tree")`;
  expect(referredBy('house.cga', rules, known).sort()).toEqual([
    'assets/tiles/a.png',
    'assets/tiles/b.png',
    'assets/tree.glb',
    'models/window.obj',
    'rules/walls.cga',
  ]);
});

it('finds the materials of a model and their pictures', () => {
  expect(referredBy('models/window.obj', 'mtllib window.mtl\nv 0 0 0', known)).toEqual([
    'models/window.mtl',
  ]);
  const material = 'newmtl a\nmap_Kd -s 2 2 1 oak wood.png\r\nmap_Bump -bm 0.2 ./bump.png\n';
  expect(referredBy('models/window.mtl', material, known).sort()).toEqual([
    'models/bump.png',
    'models/oak wood.png',
  ]);
});

it('finds buffers and pictures of glTF files, as text and as bytes', () => {
  const json = JSON.stringify({
    buffers: [{ uri: 'hall.bin' }, { uri: 'data:abc' }, {}],
    images: [{ uri: 'hall%20wall.png' }],
  });
  const found = ['models/hall.bin', 'models/hall wall.png'];
  expect(referredBy('models/hall.gltf', json, known)).toEqual(found);
  const text = new TextEncoder().encode(json);
  const glb = new Uint8Array(20 + text.length);
  const view = new DataView(glb.buffer);
  view.setUint32(12, text.length, true);
  view.setUint32(16, 0x4e4f534a, true);
  glb.set(text, 20);
  expect(referredBy('models/hall.glb', glb, known)).toEqual(found);
});

it('takes no harm from files that are broken', () => {
  expect(referredBy('models/hall.gltf', '{', known)).toEqual([]);
  expect(referredBy('models/hall.glb', new Uint8Array(7), known)).toEqual([]);
  expect(referredBy('models/window.obj', 'mtllib ../../../etc/passwd', known)).toEqual([]);
});
