// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// NormalTable: the normals of many vertices, each that differs once. A face has one normal and most
// faces of a place look one of a few ways, so a number a vertex takes a fraction of what its normal
// does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gable {

class NormalTable {
 public:
  /// Of each vertex (three floats in `normals`) the number of its normal, by the bits of its
  /// floats. Normals are numbered as they come; those of the call before are forgotten.
  const std::vector<uint32_t>& number(std::span<const float> normals);
  /// Three floats each, by their number.
  const std::vector<float>& normals() const { return normals_; }

 private:
  uint32_t find(const float* normal);
  void grow();

  std::vector<float> normals_;
  std::vector<uint32_t> numbers_;
  /// A hash table with as many places as a power of two: one more than the number that lies there,
  /// or 0.
  std::vector<uint32_t> places_;
};

}  // namespace gable
