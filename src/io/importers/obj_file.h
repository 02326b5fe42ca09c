// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The text of an OBJ file as plain tables, before anything is made of it. Wrong lines are passed
// over and counted.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "math/vec.h"

namespace gable {

struct ObjCorner {
  static constexpr uint32_t kNone = 0xffffffff;
  /// Indices from 0.
  uint32_t position = 0, uv = kNone, normal = kNone;
};

struct ObjFace {
  uint32_t firstCorner = 0, cornerCount = 0;
  /// Indices into ObjFile::materials, objects and groups; kNone before the first.
  uint32_t material = ObjCorner::kNone;
  uint32_t object = ObjCorner::kNone;
  uint32_t group = ObjCorner::kNone;
  bool smooth = false;
};

struct ObjFile {
  /// A position whose numbers could not be read is NaN.
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uvs;
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
  /// In the order of first mention, each once.
  std::vector<std::string> materials, objects, groups, materialFiles;
  uint64_t badLines = 0;
  /// The first of them, from 1, and what is wrong with it.
  uint64_t firstBadLine = 0;
  std::string firstBadReason;
  /// Statements `l`: edges without a face.
  uint64_t lines = 0;
};

/// Linear in the text. Relative indices, line continuations, comments and either line end.
ObjFile parseObj(std::string_view text);

}  // namespace gable
