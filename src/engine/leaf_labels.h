// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What shapes are called by @Label and by tags, and which leaves came of them: from the derivation
// tree, where the leaves of a shape lie together in path order.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/impl.h"

namespace gable {

/// By rule, as Rules::rules() has them: its @Label, or nothing.
std::vector<std::string> labelsOf(const Rules& rules);

/// The tag that a call of the operation gives.
struct GivenTag {
  bool isComputed = false;
  /// As the operation takes it; empty where it is computed.
  std::string name;
};
/// Of an instruction of the program; nothing where it gives no tag.
std::optional<GivenTag> givenTag(const Program& program, size_t at);
/// What the rules name where they give tags: texts that stand in the call itself.
std::set<std::string> tagsNamedBy(const Program& program);
/// Rules may give tags that they compute.
bool computesTags(const Program& program);

/// By node of the trace the first of the queries that its tags answer (tagMatches), from 1; 0 for
/// none. A part of what has the same tag is no shape of its own and has none.
std::vector<uint32_t> taggedNodes(const std::vector<std::string>& queries,
                                  const DerivationTrace& trace);

/// By leaf in path order.
struct LeafMarks {
  /// The nearest shape above it with a mark, from 1 in the order of the trace; 0 for none.
  std::vector<uint32_t> shapes;
  /// Its mark.
  std::vector<uint32_t> marks;
};
/// `markOfNode`: 0 for none. Leaves beyond the first `leaves` are left out.
LeafMarks marksOf(const DerivationTrace& trace, const std::vector<uint32_t>& markOfNode,
                  uint64_t leaves);

}  // namespace gable
