// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Numbers of the glTF 2.0 format that its readers and its writers share.
#pragma once

#include <cstdint>

namespace gable::gltf {

// Component types of accessors.
inline constexpr int kByte = 5120, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
// Targets of buffer views.
inline constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

// The words "glTF", "JSON" and "BIN\0" of a .glb file, and its version.
inline constexpr uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a,
                          kBinaryChunk = 0x004e4942;
inline constexpr uint32_t kGlbVersion = 2;
/// Bytes of the file's head with the head of the JSON chunk, and of the head of each other chunk.
inline constexpr uint64_t kGlbHead = 20, kGlbChunkHead = 8;
/// A .glb file tells its length in 32 bits.
inline constexpr uint64_t kGlbLimit = 0xffffffff;

}  // namespace gable::gltf
