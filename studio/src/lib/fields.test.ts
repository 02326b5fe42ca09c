// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { describe, expect, it } from 'vitest';
import { controlOf, evaluate, groupFields, offered, shown, valueOfText, valueText } from './fields';
import type { AttributeInfo } from './protocol';

function attribute(
  name: string,
  type: string,
  annotations: [string, ...[string, string][]][] = [],
  hidden = false,
): AttributeInfo {
  return {
    name,
    type,
    hidden,
    annotations: annotations.map(([n, ...args]) => ({ name: n, arguments: args })),
  };
}

describe('controls', () => {
  it('follow the annotations', () => {
    expect(
      controlOf(
        attribute('h', 'float', [['Range', ['min', '3'], ['max', '9'], ['stepsize', '0.5']]]),
      ),
    ).toEqual({ kind: 'number', unit: '', min: 3, max: 9, step: 0.5 });
    expect(controlOf(attribute('h', 'float', [['Range', ['', '1'], ['', '2']]]))).toEqual({
      kind: 'number',
      unit: '',
      min: 1,
      max: 2,
    });
    expect(controlOf(attribute('a', 'float', [['Angle']]))).toMatchObject({ unit: '°' });
    expect(controlOf(attribute('e', 'string', [['Enum', ['', 'a'], ['', 'b']]]))).toEqual({
      kind: 'choice',
      choices: ['a', 'b'],
      free: false,
    });
    expect(controlOf(attribute('c', 'string', [['Color']]))).toEqual({ kind: 'color' });
    expect(controlOf(attribute('f', 'string', [['File', ['', 'glb']]]))).toEqual({
      kind: 'file',
      extensions: ['glb'],
    });
    expect(controlOf(attribute('b', 'bool'))).toEqual({ kind: 'bool' });
    expect(controlOf(attribute('s', 'string'))).toEqual({ kind: 'text' });
  });
  it('offer files and folders of the project', () => {
    const paths = [
      'assets/doors/oak.OBJ',
      'assets/doors/old/elm.glb',
      'rules/town.cga',
      'assets/wall.png',
      'stone.mtl',
    ];
    const of = (note: string, ...extensions: string[]) =>
      offered(
        controlOf(
          attribute('f', 'string', [[note, ...extensions.map((e): [string, string] => ['', e])]]),
        ),
        paths,
      );
    expect(of('File', 'obj', '.glb')).toEqual(['doors/oak.OBJ', 'doors/old/elm.glb']);
    expect(of('File')).toHaveLength(5);
    expect(of('MaterialFile')).toEqual(['stone.mtl']);
    expect(of('Directory')).toEqual(['assets', 'doors', 'doors/old', 'rules']);
    expect(of('Color')).toEqual([]);
  });
  it('have the unit that their description names', () => {
    const unit = (text: string) =>
      controlOf(attribute('a', 'float', [['Description', ['', text]]]));
    expect(unit('Lot aimed at, in square metres')).toMatchObject({ unit: 'm²' });
    expect(unit('Water in cubic metres')).toMatchObject({ unit: 'm³' });
    expect(unit('Height of a floor in metres')).toMatchObject({ unit: 'm' });
    expect(unit('Parameters')).toMatchObject({ unit: '' });
  });
  it('have ranges that may be left', () => {
    const range = (...args: [string, string][]) =>
      controlOf(attribute('h', 'float', [['Range', ...args]]));
    expect(range(['min', '1'], ['max', '2'], ['restricted', 'false'])).toMatchObject({
      free: true,
    });
    expect(range(['min', '1'], ['max', '2'], ['restricted', 'true'])).not.toHaveProperty('free');
    expect(controlOf(attribute('a', 'float', [['Angle']]))).toMatchObject({ max: 360, free: true });
    expect(controlOf(attribute('p', 'float', [['Percent']]))).toMatchObject({
      min: 0,
      max: 1,
      shownAs: 100,
    });
  });
  it('offer the values of another attribute', () => {
    const note: [string, ...[string, string][]][] = [['Enum', ['valuesAttr', 'lods']]];
    expect(controlOf(attribute('lod', 'string', note), { lods: ['low', 'high'] })).toEqual({
      kind: 'choice',
      choices: ['low', 'high'],
      free: false,
    });
    const imported = controlOf(attribute('a.lod', 'float', note), { 'a.lods': [1, 2], lods: [9] });
    expect(imported).toMatchObject({ choices: ['1', '2'] });
    expect(controlOf(attribute('lod', 'string', note))).toEqual({ kind: 'text' });
  });
  it('are called as their author says', () => {
    const fields = groupFields([
      attribute('h', 'float', [['DisplayName', ['', 'Building height']]]),
      attribute('wall.h', 'float'),
    ])[0]!.fields;
    expect(fields.map((f) => f.label)).toEqual(['Building height', 'h']);
  });
  it('read back what was set', () => {
    expect(valueOfText('3.5', 'float')).toBe(3.5);
    expect(valueOfText('oops', 'float')).toBeNull();
    expect(valueOfText('true', 'bool')).toBe(true);
    expect(valueOfText('1', 'string')).toBe('1');
  });
  it('are grouped and ordered, hidden ones left out', () => {
    const groups = groupFields([
      attribute('late', 'float', [
        ['Group', ['', 'B'], ['order', '2']],
        ['Order', ['', '2']],
      ]),
      attribute('plain', 'float'),
      attribute('first', 'float', [['Group', ['', 'A'], ['', '7'], ['order', '1']]]),
      attribute('early', 'float', [
        ['Group', ['', 'B'], ['order', '2']],
        ['Order', ['', '1']],
      ]),
      attribute('never', 'float', [], true),
    ]);
    expect(groups.map((g) => g.name)).toEqual(['A › 7', 'B', 'Attributes']);
    expect(groups[1]!.fields.map((f) => f.name)).toEqual(['early', 'late']);
  });
});

describe('numbers', () => {
  it('are typed as expressions with units', () => {
    expect(evaluate('3.25*2')).toBe(6.5);
    expect(evaluate('1/4')).toBe(0.25);
    expect(evaluate('(1+2)*-3')).toBe(-9);
    expect(evaluate('120 cm')).toBeCloseTo(1.2);
    expect(evaluate('10ft')).toBeCloseTo(3.048);
    for (const wrong of ['', 'x', '1+', '(1', '1 2', '1/0', 'alert(1)'])
      expect(evaluate(wrong), wrong).toBeNull();
  });
  it('are shown short', () => {
    expect(shown(1284)).toBe('1\u2009284');
    expect(shown(3.14159)).toBe('3.14');
    expect(shown(-0.5)).toBe('-0.5');
  });
  it('go to the engine whole', () => {
    expect(valueText(0.1234567)).toBe('0.1234567');
    expect(valueText([1, 2])).toBe('[1,2]');
    expect(
      valueText([
        [1, 2],
        [3, 4],
      ]),
    ).toBe('[1,2;3,4]');
    expect(valueText(true)).toBe('true');
  });
});
