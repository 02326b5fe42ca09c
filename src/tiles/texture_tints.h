// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What materials look like from far away: their colour, times the mean of their texture.
#pragma once

#include <map>
#include <string>

#include "io/exporters/write_model.h"

namespace gable {

class TextureTints {
 public:
  /// The reader has to outlive it.
  explicit TextureTints(const TextureReader& read) : read_(read) {}
  /// sRGB. A texture that cannot be read is white.
  Vec3 of(const Material& m);

 private:
  // In linear light.
  Vec3 meanOf(const std::string& path) const;

  const TextureReader& read_;
  /// By path, in linear light.
  std::map<std::string, Vec3> known_;
};

}  // namespace gable
