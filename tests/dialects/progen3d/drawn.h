// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the tests of the ProGen3d notation share: a grammar drawn, its bodies with their boxes in
// the world and their textures, and the measured truth of the original program. The truth lies
// beside the repository (GABLE_SHARED, else ../shared).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "math/box.h"

namespace gable::progen3d_test {

/// A leaf of the result.
struct Body {
  /// The rule that drew it.
  std::string rule;
  Box3 box;
  /// The number of a built-in texture, quarter turns and scale; texture -1 for none.
  int texture = -1;
  int quarters = 0;
  double scale = 0;
  uint32_t mesh = 0;
  /// Enclosed by its faces as they look: negative when they look inwards.
  double volume = 0;
  bool closed = false;
};

struct Drawn {
  Model model;
  Rules rules;
  std::vector<Body> bodies;
  Box3 bounds;

  /// All messages of reading and deriving.
  DiagnosticList messages() const;
  /// "code line:column", in order.
  std::vector<std::string> codes() const;
  bool has(const std::string& code) const;
  /// How many bodies have each texture.
  std::map<int, int> textures() const;
};

struct DrawOptions {
  double seed = 1;
  bool sharing = true;
  Limits limits;
  /// For the surfaces of each body: slower.
  bool surfaces = false;
};

Drawn draw(const std::string& grammar, const DrawOptions& options = {},
           const std::string& name = "test.grammar");
/// Rule text that conversion gave.
Drawn drawConverted(const std::string& cga, const DrawOptions& options = {});

/// The folder with measured grammars; empty when it is not there.
std::string dataFolder();
/// The text of a file below it; empty when it is not there.
std::string dataText(const std::string& path);

/// A line of measured truth.
struct Truth {
  std::string type;
  int texture = 0, quarters = 0;
  double scale = 0;
  Box3 box;
};
std::vector<Truth> truthOf(const std::string& name);

std::string text(const Box3& box);
bool near(const Box3& a, const Box3& b, double tolerance = 1e-4);

}  // namespace gable::progen3d_test
