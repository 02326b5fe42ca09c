// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Component split: what comp and modify have in common. The components of a mesh that the items of
// a block select become shapes, in axes of their own where a rectangle becomes a primitive again.
#pragma once

#include <cstdint>
#include <vector>

#include "builtins/ops/subdivide/shared/components.h"
#include "builtins/selection.h"
#include "shape/op_call.h"

namespace gable {

/// The words for components, in the order of a table of what they mean.
enum class KindWord : uint8_t {};
enum class Alignment : uint8_t { ZUp, NoAlign };

template <>
struct WordsOf<KindWord> {
  static constexpr const char* text =
      "f faces e edges fe v vertices fv g groups m materials h holes";
};
template <>
struct WordsOf<Alignment> {
  static constexpr const char* text = "zUp noAlign";
};

struct Comp {
  KindWord component;
  Alignment alignment;
};

inline constexpr ParamSpec kCompParams[] = {
    param<&Comp::component>("component",
                            "What to divide into: faces, edges, face edges, vertices, face "
                            "vertices, groups, materials or "
                            "holes."),
    param<&Comp::alignment>(
        "scopeAlignment",
        "zUp gives each component axes of its own, with z along its normal; noAlign keeps the axes "
        "and the pivot.",
        "zUp"),
};
inline constexpr Signature kCompSignatures[] = {{kCompParams}};

ComponentKind kindOf(const Comp& args);
/// By material slot of the shape's geometry the first slot of its set, where components are sets of
/// them: groups or materials. Empty for others.
std::vector<uint16_t> componentSlots(const Comp& args, const Shape& s, const Services& services);

/// The components that the selectors of a call may select. The mesh is the shape's and must outlive
/// them.
Components componentsOf(OpCall& call, const Comp& args, const Mesh& mesh);

/// What all children of a call have in common.
struct ComponentCall {
  OpCall& call;
  bool align;
  /// The children have origins, since they shall be glued back.
  bool tracked = false;

  Shape child(StringId name, size_t index, size_t total) const;
  StringId nameOf(const SelectorItem& item, const Selector& selector) const;
};

/// Gives out the components that the items of the block select. Says of each whether one took it.
std::vector<bool> splitMesh(const ComponentCall& context, Components& all, const Mesh& mesh,
                            ComponentKind kind);

/// The plane through an edge of a face that halves the angle to the face beyond it. All in scope
/// coordinates; `along` runs as the face does.
struct SharedEdge {
  Vec3 point, along, normal, otherNormal;
};
void addTrimPlane(ShapeExtra& extra, const Shape& parent, const SharedEdge& e);

/// Equal faces come out with equal sizes: coordinates in a face's own axes lie on a grid.
double onGrid(double v);

}  // namespace gable
