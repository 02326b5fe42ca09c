// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is built in, as `gable ops --json` lists it, for completion, hover and highlighting.

export interface Param {
  name: string;
  type: string;
  doc: string;
  default?: string;
  words?: string;
}

export interface Entry {
  name: string;
  kind: 'operation' | 'function' | 'attribute' | 'selector';
  summary: string;
  signatures: { params: Param[]; variadic: boolean }[];
  block: string;
  bare: boolean;
}

interface Call {
  name: string;
  summary: string;
  block?: string;
  bare?: boolean;
  overloads: { params: Param[]; variadic?: boolean }[];
}

interface Listing {
  operations: Call[];
  functions: Call[];
  attributes: { name: string; type: string; doc: string }[];
  selectors: { name: string; doc: string }[];
}

const call =
  (kind: Entry['kind']) =>
  (c: Call): Entry => ({
    name: c.name,
    kind,
    summary: c.summary,
    signatures: c.overloads.map((o) => ({ params: o.params, variadic: o.variadic ?? false })),
    block: c.block ?? '',
    bare: c.bare ?? false,
  });

const plain =
  (kind: Entry['kind']) =>
  (a: { name: string; doc: string }): Entry => ({
    name: a.name,
    kind,
    summary: a.doc,
    signatures: [],
    block: '',
    bare: true,
  });

export function readRegistry(json: unknown): Entry[] {
  const listing = json as Listing;
  return [
    ...listing.operations.map(call('operation')),
    ...listing.functions.map(call('function')),
    ...listing.attributes.map(plain('attribute')),
    ...listing.selectors.map(plain('selector')),
  ];
}

/** "extrude(direction, distance)", optional ones in brackets. */
export function signatureText(entry: Entry, index: number): string {
  const signature = entry.signatures[index];
  if (!signature || entry.bare) return entry.name;
  const params = signature.params.map((p) => (p.default === undefined ? p.name : `[${p.name}]`));
  return `${entry.name}(${params.join(', ')}${signature.variadic ? ', …' : ''})`;
}
