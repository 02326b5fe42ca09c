// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The module of main.cpp as objects: a request goes in, an answer comes out. In a page's worker, and
// in node for the tests.

const text = new TextEncoder();

/**
 * `makeGable` is what gable.mjs exports, `wasmBinary` the bytes of gable.wasm. `files` are put below
 * / before the project is opened: [path, bytes], such as /examples/town/town.cga.
 */
export async function openEngine(makeGable, wasmBinary, files = []) {
  const module = await makeGable({ wasmBinary });
  const { FS } = module;
  for (const folder of ['/project', '/examples']) FS.mkdirTree(folder);

  function put(path, bytes) {
    FS.mkdirTree(path.slice(0, path.lastIndexOf('/')) || '/');
    FS.writeFile(path, bytes);
  }

  /** Calls with the addresses and lengths of some bytes, which are freed after. */
  function withBytes(each, call) {
    const places = each.map((bytes) => {
      const at = module._malloc(Math.max(1, bytes.length)) >>> 0;
      // Memory may have grown, and its view with it.
      module.HEAPU8.set(bytes, at);
      return [at, bytes.length];
    });
    try {
      return call(...places.flat());
    } finally {
      for (const [at] of places) module._free(at);
    }
  }

  for (const [path, bytes] of files) put(path, bytes);
  if (!module._gable_open()) throw new Error('the project cannot be opened');

  return {
    put,

    /** `query`: names and values, not escaped. The body of the answer is a copy. */
    ask(method, path, query = [], body = new Uint8Array()) {
      const head = text.encode([method, path, ...query.flat()].map((word) => `${word}\0`).join(''));
      const status = withBytes([head, body], module._gable_ask);
      const lines = module.UTF8ToString(module._gable_head()).split('\n');
      const headers = [];
      for (let i = 0; i + 1 < lines.length; i += 2) headers.push([lines[i], lines[i + 1]]);
      const at = module._gable_body() >>> 0;
      const answer = module.HEAPU8.slice(at, at + (module._gable_body_bytes() >>> 0));
      module._gable_done();
      return { status, headers, body: answer };
    },

    language: {
      begin: () => module._gable_language_begin(),
      hear: (message) => withBytes([text.encode(message)], module._gable_language_hear),
      step: () => module._gable_language_step() !== 0,
      wait: () => module._gable_language_wait(),
      said() {
        const at = module._gable_language_said();
        return at ? module.UTF8ToString(at) : null;
      },
    },
  };
}
