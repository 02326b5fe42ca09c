// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { describe, expect, it } from 'vitest';
import {
  applyChanges,
  definitions,
  duplicate,
  freeName,
  nameTrouble,
  removal,
  rename,
  targetAt,
  uses,
  type RuleFile,
} from './rules';

const CGA = `import w : "window.cga"
@Range(min=3, max=30)
attr height = 9   // metres
const half = height / 2
area(x) = x * half

// Where it begins.
@StartRule
Lot -->
    extrude(height)
    comp(f) { side : Wall(height) | top : Roof }

Wall(height) -->
    split(y) { ~height : w.Frame | { ~1 : Wall(1) }* }
Roof --> color("#Wall") Slab.
`;
const WINDOW = 'Frame -->\n    Wall\nWall --> NIL\n';
const files: RuleFile[] = [
  { path: 'house.cga', text: CGA },
  { path: 'window.cga', text: WINDOW },
];
const at = (text: string, what: string, nth = 0): number => {
  let from = -1;
  for (let i = 0; i <= nth; ++i) from = text.indexOf(what, from + 1);
  return from;
};

describe('definitions', () => {
  it('findsRulesAttributesConstantsAndFunctions', () => {
    const found = definitions(CGA, 'CGA');
    expect(found.map((d) => `${d.kind} ${d.name}`)).toEqual([
      'attribute height',
      'constant half',
      'function area',
      'rule Lot',
      'rule Wall',
      'rule Roof',
    ]);
    expect(found[4]!.parameters).toEqual(['height']);
    expect(CGA.slice(found[3]!.from, found[3]!.to)).toMatch(/^Lot -->[\s\S]*Roof }$/);
    expect(CGA.slice(found[3]!.lead).startsWith('// Where it begins.')).toBe(true);
    expect(CGA.slice(found[5]!.body.from, found[5]!.body.to)).toBe('color("#Wall") Slab.');
  });

  it('findsRulesOfOtherNotations', () => {
    const gbbg =
      'axiom START size (1, 2, 3)\nterminal Wall 2D [3, 3, 0]\nSTART -> Split(Y, {1}) {A | B}\n"front" A -> Repeat(X)\n   {Wall 1}\n';
    expect(definitions(gbbg, 'GBBG').map((d) => gbbg.slice(d.from, d.to))).toEqual([
      'START -> Split(Y, {1}) {A | B}',
      '"front" A -> Repeat(X)\n   {Wall 1}',
    ]);
    const progen =
      'X -> R* n ( 2 4 )\n   Row\nFront ; 0.4 -> Shop -> Home\nRow n -> House # here\n';
    expect(definitions(progen, 'ProGen3d').map((d) => [d.name, d.parameters.join()])).toEqual([
      ['X', ''],
      ['Front', ''],
      ['Row', 'n'],
    ]);
    const park =
      'size = 3\nRegion -> Grid(5 {3, 15}, 3) { CellRegion }\nCellRegion ->\n  case (w == 3): A\n  else: B\n';
    expect(definitions(park, 'Park').map((d) => d.name)).toEqual(['size', 'Region', 'CellRegion']);
  });

  it('takesTextThatIsBeingWritten', () => {
    for (let end = 0; end <= CGA.length; end += 7) definitions(CGA.slice(0, end), 'CGA');
    expect(definitions('', 'CGA')).toEqual([]);
    expect(definitions('A -->', 'CGA')[0]!.body).toEqual({ from: 5, to: 5 });
  });
});

describe('uses and rename', () => {
  it('leavesCommentsStringsParametersAndOtherFilesAlone', () => {
    const target = targetAt(files, 'house.cga', at(CGA, 'Wall(height)'))!;
    expect(target).toEqual({ path: 'house.cga', name: 'Wall', within: null });
    expect(uses(files, target).map((u) => u.path)).toEqual(['house.cga', 'house.cga', 'house.cga']);
    const changed = applyChanges(CGA, rename(files, target, 'Facade').get('house.cga')!);
    expect(changed).toContain('side : Facade(height)');
    expect(changed).toContain('"#Wall"');
    expect(changed).toContain('w.Frame');
  });

  it('keepsAnAttributeApartFromAParameterOfItsName', () => {
    const attribute = targetAt(files, 'house.cga', at(CGA, 'height'))!;
    expect(uses(files, attribute).length).toBe(4);
    const parameter = targetAt(files, 'house.cga', at(CGA, '~height') + 1)!;
    expect(parameter.within).not.toBeNull();
    expect(uses(files, parameter).length).toBe(2);
  });

  it('renamesAcrossImports', () => {
    const target = targetAt(files, 'house.cga', at(CGA, 'w.Frame') + 3)!;
    expect(target).toEqual({ path: 'window.cga', name: 'Frame', within: null });
    const changes = rename(files, target, 'Casement');
    expect(applyChanges(CGA, changes.get('house.cga')!)).toContain('w.Casement');
    expect(applyChanges(WINDOW, changes.get('window.cga')!)).toContain('Casement -->');
  });

  it('says what is wrong with a name', () => {
    expect(nameTrouble('2x', [])).toMatch(/letters/);
    expect(nameTrouble('Wall', ['Wall'])).toMatch(/already/);
    expect(nameTrouble('Wall_2', ['Wall'])).toBeNull();
  });
});

describe('duplicate and remove', () => {
  const found = definitions(CGA, 'CGA');
  it('copiesUnderAFreeName', () => {
    expect(freeName('Wall', ['Wall', 'Wall_2'])).toBe('Wall_3');
    const text = applyChanges(CGA, [duplicate(CGA, found[4]!, 'Wall_2')]);
    expect(definitions(text, 'CGA').map((d) => d.name)).toEqual([
      'height',
      'half',
      'area',
      'Lot',
      'Wall',
      'Wall_2',
      'Roof',
    ]);
  });
  it('removesWithItsAnnotations', () => {
    const text = applyChanges(CGA, [removal(CGA, found[3]!)]);
    expect(text).not.toContain('@StartRule');
    expect(text).not.toContain('Where it begins');
    expect(definitions(text, 'CGA').length).toBe(5);
    const one = definitions('A -> B\nB -> C\n', 'Park');
    expect(applyChanges('A -> B\nB -> C\n', [removal('A -> B\nB -> C\n', one[0]!)])).toBe(
      'B -> C\n',
    );
  });
});
