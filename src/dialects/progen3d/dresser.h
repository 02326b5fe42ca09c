// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A body's named texture as operations that stand before it, in the same brackets: color,
// texture(path) and the material's opacity, roughness and scale.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "dialects/progen3d/lower.h"
#include "dialects/progen3d/nodes.h"
#include "dialects/progen3d/textures.h"

namespace gable::progen3d {

class Dresser {
 public:
  /// `remedy` says what may stand in place of a name that means nothing.
  Dresser(Builder& builder, const FileExists& exists, Diagnostics& diagnostics, const char* remedy)
      : b_(builder), exists_(exists), diagnostics_(diagnostics), remedy_(remedy) {}

  struct Wearing {
    std::string_view name;
    Span nameSpan, at;
    /// The share of the picture that a face shows, and its turn in degrees; each makes new nodes.
    std::function<NodeId()> share, turn;
  };
  Nodes operations(const Wearing& w);

 private:
  // The picture of that name in the folder of textures, else what its words say.
  NamedTexture textureOf(const Wearing& w);
  NodeId set(const char* attribute, NodeId value, Span at);

  Builder& b_;
  const FileExists& exists_;
  Diagnostics& diagnostics_;
  const char* remedy_;
  std::set<std::string_view> unknown_;
};

}  // namespace gable::progen3d
