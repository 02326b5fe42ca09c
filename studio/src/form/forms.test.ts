// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { describe, expect, it } from 'vitest';
import villa from '../../../examples/gbbg/gbbg.gbbg?raw';
import rowhouse from '../../../examples/rowhouse/rowhouse.cga?raw';
import tower from '../../../examples/tower/tower.cga?raw';
import { applyChanges, definitions } from '../text/rules';
import {
  addChance,
  addSlot,
  insertAfter,
  makeChoice,
  parseBody,
  removeItem,
  removeSlot,
  type Body,
  type Call,
} from './cga_rule';
import {
  assetTable,
  declaration,
  newRule,
  OPERATORS,
  parseRule,
  printRule,
  slotNames,
  symbolsOf,
  withOperator,
  type GbbgRule,
} from './gbbg_rule';

const rule = (text: string): GbbgRule => {
  const out = parseRule(text);
  if (typeof out === 'string') throw new Error(out);
  return out;
};

describe('GBBG rules', () => {
  it('readsAndPrintsAllRulesOfTheVillaWithoutAChange', () => {
    const text = villa;
    const all = definitions(text, 'GBBG');
    expect(all.length).toBeGreaterThan(35);
    for (const each of all) {
      const written = text.slice(each.from, each.to);
      expect(printRule(rule(written)).replace(/\s+/g, ' ')).toBe(written.replace(/\s+/g, ' '));
    }
  });

  it('knowsDefaultsAndOddForms', () => {
    expect(rule('A -> Margin(Y) {B | C | D}')).toMatchObject({
      margin: 0,
      relative: false,
      orientation: 'Default',
      center: true,
    });
    expect(
      rule('"front" "odd symbol" -> scope(t(-1, 0, +2.5, set, WORLD, off)) {B 3, C} weight 2'),
    ).toMatchObject({
      title: 'front',
      predecessor: 'odd symbol',
      weight: 2,
      translate: { value: [-1, 0, 2.5], set: true, other: true, on: false },
      slots: [
        [
          { symbol: 'B', chance: 3 },
          { symbol: 'C', chance: null },
        ],
      ],
    });
    expect(printRule(rule('"odd symbol" -> Repeat(X) {B}'))).toBe('"odd symbol" -> Repeat(X) {B}');
    for (const bad of [
      'A -> Turn(Y) {B}',
      'A -> Split(Y) {B}',
      'A -> Repeat(X) {',
      'A',
      '',
      'A -> Repeat(X) {B} more',
    ]) {
      expect(typeof parseRule(bad), bad).toBe('string');
    }
  });

  it('keepsSuccessorsWhenTheTypeChanges', () => {
    const split = rule('A -> Split(Y, {1, 2}, ToRoot) {P | Q | R}');
    expect(slotNames(split)).toEqual(['1 m', '2 m', 'the rest']);
    expect(printRule(withOperator(split, 'Repeat'))).toBe('A -> Repeat(Y) {P}');
    expect(printRule(withOperator(split, 'Component'))).toBe('A -> Component(Y, Sides) {P}');
    expect(printRule(withOperator(newRule('A', 'Repeat'), 'Margin'))).toBe(
      'A -> Margin(X, Absolute, 1, Default, Center) {EMPTY | EMPTY | EMPTY}',
    );
    for (const each of OPERATORS)
      expect(typeof parseRule(printRule(newRule('A', each)))).toBe('object');
  });

  it('readsTheTableOfAssetsAndDeclaresSymbols', () => {
    const text =
      'axiom START size (1, 1, 1)\nterminal Wall [1, 2, 3],\n   Door 2D\nSTART -> Repeat(X) {Wall 2, Bay}\npostprocess {\n  Wall : "a/wall.glb" // here\n  Door : "door.glb" fit bounds\n}\n';
    const table = assetTable(text)!;
    expect(table.assets.map((a) => [a.symbol, a.path, text.slice(a.from, a.to)])).toEqual([
      ['Wall', 'a/wall.glb', 'a/wall.glb'],
      ['Door', 'door.glb', 'door.glb'],
    ]);
    expect(text[table.end]).toBe('}');
    expect(symbolsOf(text)).toEqual(['START', 'EMPTY', 'Wall', 'Door', 'Bay']);
    const { at, insert } = declaration(text, 'Sill', '2D');
    expect(text.slice(0, at) + insert).toMatch(/Door 2D\nshape Sill 2D\n$/);
    expect(declaration('', 'Sill', 'Empty', true)).toEqual({
      at: 0,
      insert: 'terminal Sill Empty\n',
    });
  });
});

const CGA = `Facade(h) -->
    color("#fff") // paint
    split(y) { groundHeight : Shops | { ~h : Floor(split.index) | 0.2 : Band }* | 0.9 : 50% : Cornice else : NIL }
`;
const bodyOf = (text: string): Body => parseBody(text, definitions(text, 'CGA').at(-1)!.body);

describe('CGA rules', () => {
  it('findsOperationsArgumentsAndSlots', () => {
    const body = bodyOf(CGA);
    expect(body.branches.length).toBe(1);
    const [color, split] = body.branches[0]!.items as [Call, Call];
    expect(color.args.map((a) => a.text)).toEqual(['"#fff"']);
    const block = split.blocks[0]!;
    expect(block.slots.map((s) => s.head?.text ?? 'group')).toEqual([
      'groundHeight',
      'group',
      '0.9',
    ]);
    expect(block.slots[1]!.group).toMatchObject({ repeated: true });
    expect(
      (block.slots[1]!.group!.slots[0]!.body!.branches[0]!.items[0] as Call).args[0]!.text,
    ).toBe('split.index');
    expect(block.slots[2]!.body!.branches.map((b) => b.kind)).toEqual(['chance', 'else']);
    expect(block.slots[2]!.body!.branches[0]!.head!.text).toBe('50');
  });

  it('findsConditionsAndChances', () => {
    const text =
      'A -->\n    case x > 1 && y(2, 3) == 4 :\n        B\n    case x > 0 : [ t(1, 2, 3) C ] D\n    else : NIL\n';
    const body = bodyOf(text);
    expect(body.branches.map((b) => `${b.kind} ${b.head?.text ?? ''}`)).toEqual([
      'case x > 1 && y(2, 3) == 4',
      'case x > 0',
      'else ',
    ]);
    expect(body.branches[1]!.items.map((i) => (i.kind === 'call' ? i.name.text : i.text))).toEqual([
      '[',
      't',
      'C',
      ']',
      'D',
    ]);
    const drawn = bodyOf('A --> 30% : case x : B else : C 60.5% : D else : E\n');
    expect(drawn.branches.map((b) => `${b.kind} ${b.head?.text ?? ''}`)).toEqual([
      'chance 30',
      'chance 60.5',
      'else ',
    ]);
    expect(drawn.branches[0]!.nested!.branches.map((b) => b.kind)).toEqual(['case', 'else']);
  });

  it('changesOnlyWhatIsEdited', () => {
    const body = bodyOf(CGA);
    const [color, split] = body.branches[0]!.items as [Call, Call];
    const block = split.blocks[0]!;
    expect(applyChanges(CGA, [removeSlot(block, 1)])).toContain('{ groundHeight : Shops | 0.9 :');
    expect(applyChanges(CGA, [removeSlot(block, 0)])).toContain('split(y) { { ~h');
    expect(applyChanges(CGA, [addSlot(block, '~1 : Attic')])).toContain(
      'else : NIL | ~1 : Attic }',
    );
    expect(applyChanges(CGA, [insertAfter(CGA, color, body, 'Frame')])).toContain(
      'color("#fff")\n    Frame // paint',
    );
    expect(applyChanges('A --> B C\n', [removeItem('A --> B C\n', { from: 8, to: 9 })])).toBe(
      'A --> B\n',
    );
    const plain = 'A --> B\n';
    const choice = applyChanges(plain, [makeChoice(plain, bodyOf(plain))]);
    expect(choice).toBe('A --> 50% : B else : NIL\n');
    expect(applyChanges(choice, [addChance(bodyOf(choice))])).toBe(
      'A --> 50% : B 10% : NIL else : NIL\n',
    );
  });

  it('takesEveryExampleAndTextThatIsCutOff', () => {
    for (const text of [tower, rowhouse]) {
      for (const each of definitions(text, 'CGA')) {
        if (each.kind !== 'rule') continue;
        const body = parseBody(text, each.body);
        expect(body.branches.length).toBeGreaterThan(0);
        const written = text.slice(each.from, each.to);
        for (let end = 0; end < written.length; end += 61) {
          const cut = definitions(written.slice(0, end), 'CGA')[0];
          if (cut) parseBody(written.slice(0, end), cut.body);
        }
      }
    }
  });
});
