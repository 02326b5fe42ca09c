// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

// Built by tools/playground.sh.
declare module 'gable-wasm/gable.mjs' {
  const makeGable: (settings: { wasmBinary: ArrayBuffer | Uint8Array }) => Promise<unknown>;
  export default makeGable;
}
declare module 'gable-wasm/gable.wasm.lzma?url' {
  const address: string;
  export default address;
}
