// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import {
  BufferAttribute,
  Group,
  InstancedMesh,
  type Intersection,
  type Mesh,
  Vector3,
} from 'three';
import { expect, test } from 'vitest';
import { featureAt, rowsOf, titleOf } from './features';

const villa = {
  id: 'Building/way/1',
  shape: 'Building',
  name: 'Villa',
  type: 'yes',
  levels: -1,
  height: 12.3456,
  attributes: '{"building":"yes","has_parts":false,"note":""}',
};

test('what a thing is called comes first, else what it is', () => {
  expect(titleOf(villa)).toBe('Villa');
  expect(titleOf({ ...villa, name: '' })).toBe('Building');
});

test('what is not known is not shown', () => {
  expect(rowsOf(villa)).toEqual([
    ['shape', 'Building'],
    ['type', 'yes'],
    ['height', '12.35'],
    ['id', 'Building/way/1'],
    ['building', 'yes'],
    ['has_parts', 'false'],
  ]);
});

test('attributes that cannot be read are none', () => {
  expect(rowsOf({ shape: 'Lot', attributes: '{' })).toEqual([['shape', 'Lot']]);
});

test('each place of a part that is there once has its own feature', () => {
  const tile = new Group();
  tile.userData.structuralMetadata = {
    getPropertyTableData: (tables: number[], ids: number[]) =>
      tables.map((table, i) => ({ id: `table ${table}, row ${ids[i]}` })),
  };
  const trees = new InstancedMesh(undefined, undefined, 3);
  trees.geometry.setAttribute('_FEATURE_ID_0', new BufferAttribute(new Float32Array([4, 9, 2]), 1));
  tile.add(trees);
  const hit = (instanceId: number): Intersection<Mesh> => ({
    distance: 1,
    point: new Vector3(),
    object: trees,
    instanceId,
  });
  expect(featureAt(hit(1))).toEqual({ id: 'table 0, row 9' });
  trees.geometry.deleteAttribute('_FEATURE_ID_0');
  expect(featureAt(hit(1))).toBeUndefined();
});
