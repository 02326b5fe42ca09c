// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a tile knows of the thing at a point: a row of its table.

import { type Intersection, type Mesh, type Object3D, Triangle, Vector3 } from 'three';

export type Feature = Record<string, unknown>;

/** What the reader of EXT_mesh_features and EXT_structural_metadata leaves with a mesh. */
interface Known {
  meshFeatures?: {
    getFeatures(triangle: number, corner: Vector3): (number | null)[];
    getFeatureInfo(): { propertyTable?: number }[];
  };
  structuralMetadata?: {
    getPropertyTableData(tables: (number | undefined)[], ids: (number | null)[]): Feature[];
  };
}

/** Of a part that stands there several times (EXT_instance_features), which no library reads. */
function featureOfInstance(hit: Intersection<Mesh>): Feature | undefined {
  const ids = hit.object.geometry.getAttribute('_FEATURE_ID_0');
  if (hit.instanceId === undefined || !ids) return undefined;
  for (let at: Object3D | null = hit.object; at; at = at.parent) {
    const { structuralMetadata } = at.userData as Known;
    if (structuralMetadata) {
      return structuralMetadata.getPropertyTableData([0], [ids.getX(hit.instanceId)])[0];
    }
  }
  return undefined;
}

export function featureAt(hit: Intersection<Mesh>): Feature | undefined {
  if (hit.instanceId !== undefined) return featureOfInstance(hit);
  const { meshFeatures, structuralMetadata } = hit.object.userData as Known;
  if (!meshFeatures || !structuralMetadata || hit.faceIndex == null || !hit.face) return undefined;
  const place = hit.object.geometry.getAttribute('position');
  const corner = (i: number) =>
    hit.object.localToWorld(new Vector3().fromBufferAttribute(place, i));
  const weights = new Vector3();
  const { a, b, c } = hit.face;
  new Triangle(corner(a), corner(b), corner(c)).getBarycoord(hit.point, weights);
  const ids = meshFeatures.getFeatures(hit.faceIndex, weights);
  const tables = meshFeatures.getFeatureInfo().map((info) => info.propertyTable);
  return structuralMetadata.getPropertyTableData(tables, ids)[0];
}

const text = (v: unknown) => (typeof v === 'string' ? v : '');

export function titleOf(feature: Feature): string {
  return text(feature.name) || text(feature.shape) || text(feature.id);
}

/** Names and values to show: what the table has, then the attributes, without what is empty. */
export function rowsOf(feature: Feature): [string, string][] {
  const rows: [string, string][] = [];
  const add = (name: string, value: unknown) => {
    if (value === null || value === undefined || value === '') return;
    rows.push([
      name,
      typeof value === 'number' ? String(Math.round(value * 100) / 100) : String(value),
    ]);
  };
  for (const name of ['shape', 'type', 'levels', 'height', 'id']) {
    if (feature[name] !== -1) add(name, feature[name]);
  }
  try {
    const more = JSON.parse(text(feature.attributes) || '{}') as Record<string, unknown>;
    for (const [name, value] of Object.entries(more)) add(name, value);
  } catch {
    // Then there are none to show.
  }
  return rows;
}
