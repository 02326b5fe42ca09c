// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Attributes of the edges of a feature: lists with a value for each edge as it is written, outlines
// first and then their holes. The mesh has these edges in an order of its own, since outlines are
// turned round and edges without length go.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.h"
#include "math/vec.h"
#include "scene/scene.h"

namespace gable {

/// The value of a number, a text or a truth value.
PlainValue plainValue(const JsonValue& v);
bool isPlainValue(const JsonValue& v);

class WrittenEdges {
 public:
  /// Of the next feature, by its properties.
  void begin(const JsonValue* properties);
  /// False where the feature has no such attributes; nothing else need be told then.
  bool wanted() const { return wanted_; }
  /// A ring as it is written. Gives its corners; edges in line stay apart, as they may differ.
  std::vector<Vec2> ring(const std::vector<Vec2>& points, double tolerance);
  /// The next face edge of the mesh.
  void add(Vec2 from, Vec2 to);

  /// How many edges are written.
  size_t written() const { return written_; }
  /// The values of a list in the order of the mesh. Edges without a value have 0, false or an empty
  /// text; so have `more` edges behind the others. No values where the list has not one kind alone.
  AttributeValue values(const std::string& name, const JsonValue& list, size_t more) const;

 private:
  struct Corner {
    Vec2 next;
    size_t edge = 0;
  };
  bool wanted_ = false;
  // By place.
  std::map<std::pair<double, double>, Corner> corners_;
  size_t written_ = 0;
  // By face edge of the mesh the number of the written one; below 0 for none.
  std::vector<int64_t> edges_;
};

}  // namespace gable
