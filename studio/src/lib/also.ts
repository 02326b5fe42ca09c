// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Other words for what operations do, as people ask for them.

const ALSO: [string, string][] = [
  [
    'cut slice divide divided subdivide floor floors storey storeys row rows column columns',
    'split',
  ],
  ['window windows door doors opening openings wall walls face faces side sides', 'comp'],
  ['random chance probability luck dice draw percent', 'rand'],
  ['raise lift volume mass height', 'extrude'],
  ['mansard hipped', 'roofHip'],
  ['mansard shed lean', 'roofShed'],
  ['gabled pitched saddle', 'roofGable'],
  ['boolean subtract difference intersect clip', 'trim'],
  ['hole holes opening', 'cutHoles'],
  ['boolean union join unite together', 'joined'],
  ['delete remove nothing hide', 'NIL'],
  ['delete remove hole', 'deleteHoles'],
  ['insert model mesh import asset obj glb load', 'i'],
  ['stairs steps array every times loop', 'repeat'],
  ['stairs lamp lamps trees row spacing', 'along'],
  ['arch round curve vault bow', 'curve'],
  ['paint colour tint', 'color'],
  ['material glass metal shiny', 'setMaterial'],
  ['picture image bitmap', 'texture'],
  ['move shift', 't'],
  ['turn spin angle', 'r'],
  ['scale size bigger smaller', 's'],
  ['inset border margin pavement', 'setback'],
  ['grow shrink inset outset', 'offset'],
  ['road roads block blocks city', 'streets'],
  ['plot plots lots land', 'parcels'],
  ['battlement merlon castle', 'crenellate'],
  ['measure count area statistics', 'report'],
  ['point points trees spread', 'scatter'],
];

/** Names that are meant by words; each with how many of the words mean it. */
export function meant(query: string): Map<string, number> {
  const out = new Map<string, number>();
  for (const word of query.toLowerCase().split(/\s+/)) {
    if (word.length < 3) continue;
    for (const [words, name] of ALSO) {
      const hit = words
        .split(' ')
        .some((w) => w === word || (word.length > 3 && w.startsWith(word)));
      if (hit) out.set(name, (out.get(name) ?? 0) + 1);
    }
  }
  return out;
}

/** The names above, for a test. */
export const namesMeant = (): string[] => [...new Set(ALSO.map(([, name]) => name))];
