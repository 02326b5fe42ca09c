// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// node pack.mjs OUT.vsix: packs the extension with the packages that it needs. A .vsix is a zip file with
// a manifest and a list of types beside the folder `extension`. The packages are read from build/editors,
// where ./test and editors/vscode/build.sh install them as package-lock.json says. The same input gives the
// same bytes.
import { readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import zlib from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '../..');
const packages = join(process.env.GABLE_EDITORS ?? join(root, 'build/editors'), 'node_modules');
const manifest = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));

const TYPES = {
  '.json': 'application/json',
  '.js': 'application/javascript',
  '.md': 'text/markdown',
  '.txt': 'text/plain',
  '.vsixmanifest': 'text/xml',
};

function crcOf(bytes) {
  if (zlib.crc32) return zlib.crc32(bytes);
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return ~crc >>> 0;
}

/** All files below a folder, sorted; what only matters to those who write packages is left out. */
function filesBelow(folder, prefix = '') {
  return readdirSync(folder)
    .sort()
    .flatMap((name) => {
      const path = join(folder, name);
      if (name === 'bin') return [];
      if (statSync(path).isDirectory()) return filesBelow(path, `${prefix}${name}/`);
      return /\.(ts|map|md|yml|bnf|cmd)$|^\.|tsconfig/.test(name) ? [] : [prefix + name];
    });
}

/** The packages that a package needs, and those that they need. */
function needed(name, out = new Set()) {
  if (out.has(name)) return out;
  out.add(name);
  const { dependencies = {} } = JSON.parse(readFileSync(join(packages, name, 'package.json'), 'utf8'));
  for (const each of Object.keys(dependencies)) needed(each, out);
  return out;
}

function entries() {
  const out = new Map();
  const own = ['package.json', 'extension.js', 'language-configuration.json', 'README.md'];
  for (const name of own) out.set(`extension/${name}`, readFileSync(join(here, name)));
  for (const name of filesBelow(join(here, 'syntaxes'))) {
    out.set(`extension/syntaxes/${name}`, readFileSync(join(here, 'syntaxes', name)));
  }
  out.set('extension/LICENSE.txt', readFileSync(join(root, 'LICENSE')));
  const all = new Set();
  for (const name of Object.keys(manifest.dependencies)) needed(name, all);
  for (const name of [...all].sort()) {
    for (const file of filesBelow(join(packages, name))) {
      out.set(`extension/node_modules/${name}/${file}`, readFileSync(join(packages, name, file)));
    }
  }
  return out;
}

const escaped = (text) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/"/g, '&quot;');

function contentTypes(paths) {
  const known = [...new Set(paths.map((p) => /\.[^./]+$/.exec(p)?.[0] ?? ''))].sort();
  const rows = known
    .filter(Boolean)
    .map((e) => `<Default Extension="${e}" ContentType="${TYPES[e] ?? 'application/octet-stream'}"/>`);
  const plain = paths.filter((p) => !/\.[^./]+$/.test(p));
  rows.push(...plain.map((p) => `<Override PartName="/${escaped(p)}" ContentType="text/plain"/>`));
  return `<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">${rows.join('')}</Types>
`;
}

function vsixManifest() {
  const asset = (type, path) => `    <Asset Type="Microsoft.VisualStudio.${type}" Path="${path}" Addressable="true"/>`;
  return `<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id="${manifest.name}" Version="${manifest.version}" Publisher="${manifest.publisher}"/>
    <DisplayName>${escaped(manifest.displayName)}</DisplayName>
    <Description xml:space="preserve">${escaped(manifest.description)}</Description>
    <Tags>${escaped(manifest.keywords.join(','))}</Tags>
    <Categories>${escaped(manifest.categories.join(','))}</Categories>
    <License>extension/LICENSE.txt</License>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value="${escaped(manifest.engines.vscode)}"/>
      <Property Id="Microsoft.VisualStudio.Code.ExtensionKind" Value="workspace"/>
    </Properties>
  </Metadata>
  <Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
  <Dependencies/>
  <Assets>
${asset('Code.Manifest', 'extension/package.json')}
${asset('Services.Content.Details', 'extension/README.md')}
${asset('Services.Content.License', 'extension/LICENSE.txt')}
  </Assets>
</PackageManifest>
`;
}

/** A zip file of entries, whose time is the first that zip knows. */
function zip(files) {
  const parts = [];
  const directory = [];
  let offset = 0;
  for (const [name, bytes] of files) {
    const path = Buffer.from(name, 'utf8');
    const packed = zlib.deflateRawSync(bytes, { level: 9 });
    const common = Buffer.alloc(26);
    common.writeUInt16LE(20, 0);
    common.writeUInt16LE(0x800, 2);
    common.writeUInt16LE(8, 4);
    common.writeUInt16LE(0x21, 8);
    common.writeUInt32LE(crcOf(bytes), 10);
    common.writeUInt32LE(packed.length, 14);
    common.writeUInt32LE(bytes.length, 18);
    common.writeUInt16LE(path.length, 22);
    const local = Buffer.concat([Buffer.from('PK\x03\x04', 'latin1'), common, path, packed]);
    const tail = Buffer.alloc(14);
    tail.writeUInt32LE(offset, 10);
    directory.push(Buffer.concat([Buffer.from('PK\x01\x02\x14\x00', 'latin1'), common, tail, path]));
    parts.push(local);
    offset += local.length;
  }
  const list = Buffer.concat(directory);
  const end = Buffer.alloc(22);
  end.write('PK\x05\x06', 0, 'latin1');
  end.writeUInt16LE(files.length, 8);
  end.writeUInt16LE(files.length, 10);
  end.writeUInt32LE(list.length, 12);
  end.writeUInt32LE(offset, 16);
  return Buffer.concat([...parts, list, end]);
}

const content = entries();
const files = [
  ['extension.vsixmanifest', Buffer.from(vsixManifest())],
  ['[Content_Types].xml', Buffer.from(contentTypes(['extension.vsixmanifest', ...content.keys()]))],
  ...content,
];
const target = process.argv[2];
if (!target) {
  console.error('usage: node pack.mjs OUT.vsix');
  process.exit(2);
}
writeFileSync(target, zip(files));
console.log(`${target}: ${files.length} files, ${Math.round(statSync(target).size / 1024)} KB`);
