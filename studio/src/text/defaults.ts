// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values of a place written into the rules, as what the attributes are from then on.

import { notationOf } from '../lib/notation';
import { definitions, imports, type Change, type RuleFile } from './rules';

/** The file and the name in it of "id.height", seen from a file. */
export function attributeFile(
  files: RuleFile[],
  main: string,
  name: string,
): { file: RuleFile; name: string } | null {
  const file = files.find((f) => f.path === main);
  if (!file || !name.includes('.')) return file ? { file, name } : null;
  const [id = '', ...rest] = name.split('.');
  const found = imports(file).find((i) => i.id === id);
  const target =
    found &&
    files.find(
      (f) => f.path === found.path || f.path.endsWith(`/${found.path.replace(/^\.?\//, '')}`),
    );
  return target ? attributeFile(files, target.path, rest.join('.')) : null;
}

/** The change that gives an attribute another default; null where it has none that is text. */
export function defaultChange(
  files: RuleFile[],
  main: string,
  name: string,
  value: string,
  type: string,
): { path: string; change: Change } | null {
  const at = attributeFile(files, main, name);
  const found =
    at &&
    definitions(at.file.text, notationOf(at.file.path)).find(
      (d) => d.kind === 'attribute' && d.name === at.name,
    );
  if (!at || !found || found.body.from >= found.body.to) return null;
  const insert = type === 'string' ? JSON.stringify(value) : value;
  return { path: at.file.path, change: { ...found.body, insert } };
}
