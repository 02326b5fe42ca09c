// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/room_key.h"

#include <algorithm>
#include <string_view>

#include "base/hash.h"
#include "runtime/key_hash.h"
#include "shape/geo_frame.h"

namespace gable {

namespace {

void addLimits(KeyHash& h, const Limits& l) {
  for (const uint64_t most :
       {uint64_t{l.depth}, uint64_t{l.functionDepth}, uint64_t{l.width}, uint64_t{l.arraySize},
        l.shapes, l.vertices, l.shapeVertices, l.steps}) {
    h.add(most);
  }
}

class Given {
 public:
  Given(KeyHash& hash, const Program& program, const Reach& reach)
      : hash_(hash), program_(program), reach_(reach) {}

  /// Those that nothing reads do not count.
  void add(const std::vector<std::pair<std::string, Value>>& attributes) {
    for (const auto& [name, value] : attributes) {
      const int32_t number = program_.findAttribute(name);
      if (number < 0 || !std::binary_search(reach_.attributes.begin(), reach_.attributes.end(),
                                            static_cast<uint32_t>(number))) {
        continue;
      }
      addAny(name, value);
    }
    hash_.add(uint64_t{0});
  }
  void addAll(const std::vector<std::pair<std::string, Value>>& attributes) {
    for (const auto& [name, value] : attributes) addAny(name, value);
    hash_.add(uint64_t{0});
  }

 private:
  void addAny(std::string_view name, const Value& value) {
    hash_.add(hashBytes(name));
    hash_.add(value.hash());
  }

  KeyHash& hash_;
  const Program& program_;
  const Reach& reach_;
};

void addShape(KeyHash& h, Given& given, const InitialShape& s) {
  h.add(hashBytes(s.name));
  h.add(hashBytes(s.startRule));
  h.add(hashBytes(s.identity));
  h.add(static_cast<uint64_t>(s.index));
  h.add(uint64_t{s.upright});
  h.add(uint64_t{s.seed.has_value()});
  h.add(s.seed.value_or(0));
  h.add(s.origin);
  h.add(s.mesh.contentHash());
  given.add(s.attributes);
  given.addAll(s.edgeAttributes);
  h.add(uint64_t{s.faceTags.size()});
  for (const std::string& tag : s.faceTags) h.add(hashBytes(tag));
  h.add(uint64_t{s.streetWidths.size()});
  for (const double width : s.streetWidths) h.add(width);
}

}  // namespace

std::optional<ShareKey> roomKey(const Program& program, const Reaches& reaches,
                                const std::vector<InitialShape>& shapes,
                                const DeriveOptions& options) {
  std::vector<uint32_t> roots;
  for (const InitialShape& s : shapes) {
    // Materials of files have no hash.
    if (!s.materials.empty() || !s.groups.empty()) return {};
    const int32_t root = s.startRule.empty() ? options.startRule : program.findRule(s.startRule);
    if (root >= 0) roots.push_back(static_cast<uint32_t>(root));
  }
  const Reach reach = reaches.within(roots, kAsksForRoom | kLabels);
  KeyHash h;
  h.add(reach.code);
  h.add(options.seed);
  h.add(options.startRule >= 0
            ? hashBytes(program.rules[static_cast<size_t>(options.startRule)].qualifiedName)
            : uint64_t{0});
  h.add(options.geo ? options.geo->hash() : uint64_t{0});
  addLimits(h, options.limits);
  Given given(h, program, reach);
  given.add(options.attributes);
  given.addAll(options.edgeAttributes);
  for (const InitialShape& s : shapes) addShape(h, given, s);
  return h.key();
}

}  // namespace gable
