// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import assert from 'node:assert/strict';
import { mkdtempSync, mkdirSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { introduction } from '../src/gallery';
import { Links, relative } from '../src/links';
import { Markdown, slug } from '../src/markdown';
import { notebookText } from '../src/notebook';
import { pathOf, titleOf, type Page } from '../src/pages';
import { exampleOf, fragmentOf } from '../src/playground';

const page = (source: string): Page => ({ source, path: pathOf(source), title: source, group: '' });

function folder(files: Record<string, string>): string {
  const root = mkdtempSync(join(tmpdir(), 'site-'));
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(join(root, path, '..'), { recursive: true });
    writeFileSync(join(root, path), text);
  }
  return root;
}

test('headings are named as on the usual viewers', () => {
  assert.equal(slug('How a material lies'), 'how-a-material-lies');
  assert.equal(slug('What `split(x)` does: sizes'), 'what-splitx-does-sizes');
  assert.equal(slug('Über_alles - 2'), 'über_alles---2');
});

test('the title of a page is its first heading without marks', () => {
  assert.equal(titleOf('text\n# The `split` of [x](y.md)\n## No\n'), 'The split of x');
  assert.equal(titleOf('no heading'), undefined);
});

test('README is the index of its folder', () => {
  assert.equal(pathOf('README.md'), 'index.html');
  assert.equal(pathOf('docs/reference/README.md'), 'docs/reference/index.html');
  assert.equal(pathOf('docs/MYREADME.md'), 'docs/MYREADME.html');
});

test('links lead from page to page, and what they lead to comes along', () => {
  const root = folder({ 'docs/a.md': '', 'docs/b/README.md': '', 'docs/p.png': '', 'x/y.cga': '' });
  const a = page('docs/a.md');
  const links = new Links(root, [a, page('docs/b/README.md')]);
  assert.equal(links.resolve(a, 'b/README.md#there'), 'b/index.html#there');
  assert.equal(links.resolve(a, 'b/'), 'b/index.html');
  assert.equal(links.resolve(a, '#here'), '#here');
  assert.equal(links.resolve(a, 'https://example.org/a.md'), 'https://example.org/a.md');
  assert.equal(links.resolve(a, 'p.png'), 'p.png');
  assert.equal(links.resolve(a, '../x/y.cga'), '../source/x/y.cga.html');
  assert.equal(links.resolve(a, '../x'), '../source/x/index.html');
  assert.deepEqual(links.files(), ['docs/p.png']);
  assert.deepEqual(links.sources(), ['x/y.cga']);
  assert.deepEqual(links.folders(), ['x']);
});

test('a link that leads to nothing, or out of the repository, stops the making', () => {
  const a = page('docs/a.md');
  const links = new Links(folder({ 'docs/a.md': '' }), [a]);
  assert.throws(() => links.resolve(a, 'gone.md'), /docs\/a\.md: the link to docs\/gone\.md/);
  assert.throws(() => links.resolve(a, '../../etc/passwd'), /leads to nothing/);
});

test('addresses are relative to their page', () => {
  assert.equal(relative('docs/guide/a.html', 'index.html'), '../../index.html');
  assert.equal(relative('a.html', 'a.html'), 'a.html');
});

test('equal headings of a page are told apart, and sections have their text', () => {
  const root = folder({ 'a.md': '' });
  const a = page('a.md');
  const markdown = new Markdown(root, new Links(root, [a]), (code) => `<pre>${code}</pre>`);
  const { html, sections } = markdown.page(a, '# A\none\n## Same\ntwo\n## Same\n```cga\nx\n```\n');
  assert.match(html, /<h2 id="same">[^]*<h2 id="same-1">/);
  assert.deepEqual(
    sections.map(({ anchor, text }) => [anchor, text.trim()]),
    [
      ['', 'one'],
      ['same', 'two'],
      ['same-1', 'x'],
    ],
  );
});

test('the introduction of an example is its first paragraph of words', () => {
  assert.equal(
    introduction('<p><img src="a"></p><p>Two <a href="b">houses</a>.</p>'),
    'Two houses.',
  );
});

test('a notebook is its words, its code and what it shows', () => {
  const cells = [
    { cell_type: 'markdown', source: ['# A\n', 'words'] },
    {
      cell_type: 'code',
      source: 'print(1)\n2',
      outputs: [
        { output_type: 'stream', text: ['1\n'] },
        { output_type: 'execute_result', data: { 'text/plain': ['2'] } },
        { output_type: 'display_data', data: { 'image/png': 'AAAA\n', 'text/plain': ['<Image>'] } },
      ],
    },
    { cell_type: 'code', source: 'pass', outputs: [] },
  ];
  const text = notebookText(JSON.stringify({ cells }));
  assert.match(
    text,
    /^# A\nwords\n\n```python\nprint\(1\)\n2\n```\n\n```text\n1\n```\n\n```text\n2\n```\n/,
  );
  assert.match(text, /!\[[^\]]+\]\(data:image\/png;base64,AAAA\)\n\n```python\npass\n```/);
  assert.doesNotMatch(text, /<Image>/);
});

test('rules of a page become a link to a shared place', () => {
  const rules = 'Lot --> extrude(3) Building.\n';
  const code = fragmentOf('The `offset` operation', rules)!.slice('#share='.length);
  const bundle = JSON.parse(inflateSync(Buffer.from(code, 'base64url')).toString()) as {
    gable: number;
    main: string;
    files: Record<string, string>;
  };
  assert.equal(bundle.gable, 1);
  assert.equal(bundle.main, 'The-offset-operation.cga');
  assert.deepEqual(bundle.files, { [bundle.main]: rules });
});

test('parts of rules and rules of several files have no link', () => {
  assert.equal(fragmentOf('x', 'extrude(3) comp(f) { top : Roof }'), undefined);
  assert.equal(fragmentOf('x', 'import trees : "rules/trees.cga"\nLot --> trees.Oak\n'), undefined);
});

test('the page of an example names it', () => {
  assert.equal(exampleOf('examples/town/README.md'), 'town');
  assert.equal(exampleOf('examples/README.md'), undefined);
});
