// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Derivation: a program and initial shapes in, a scene out.
//
// Every initial shape is derived on its own, so the work spreads over threads; the result does not
// depend on their number. Equal sub-derivations of shared rules are derived once and stand in the
// scene as instances of one prototype; with sharing off the same leaves come out, flattened.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/most_diagnostics.h"
#include "gable/limits.h"
#include "gable/trace.h"
#include "program/program.h"
#include "runtime/spare_memory.h"
#include "scene/scene.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

struct InitialShape {
  std::string name;
  /// The footprint in its object frame: x, y, z as the world's, origin near the shape.
  Mesh mesh;
  /// The object frame in the world.
  Frame origin;
  /// Attributes by name; they set rule attributes of the same name.
  std::vector<std::pair<std::string, Value>> attributes;
  /// The scope has the axes of the object frame, as a wall from comp(f) that looks along z. Else y
  /// is the normal of a single face.
  bool upright = false;
  /// Empty: the derivation's start rule.
  std::string startRule;
  /// What identifies the shape for randomness: its feature id or name; empty: its index.
  std::string identity;
  /// The feature of the file that it is, from 1; 0 where it is none. For messages.
  uint64_t feature = 0;
  /// The index that counts where some shapes of an input are left out; below 0: the place here.
  int64_t index = -1;
  /// In place of the derivation's seed.
  std::optional<double> seed;
  /// By name, each an array with a value for each face edge of the mesh; shape/edge_attributes.h.
  std::vector<std::pair<std::string, Value>> edgeAttributes;
  /// By face of the mesh, or empty: its tag, if it has one.
  std::vector<std::string> faceTags;
  /// By face of the mesh, or empty: the width of the street that a line is the middle of, or 0.
  std::vector<double> streetWidths;
  /// Of the slots from 1 of the mesh: their materials, and the groups that they are of; both empty
  /// where the file tells of none.
  std::vector<Material> materials;
  std::vector<std::string> groups;
};

/// The tables that one or more derivations share.
struct Environment {
  explicit Environment(std::shared_ptr<ValuePool> values, Assets& files)
      : pool(std::move(values)), tags(*pool), assets(files) {}
  std::shared_ptr<ValuePool> pool;
  MaterialTable materials;
  AttributePool attributes;
  TagTable tags;
  Assets& assets;
  /// Of derivations that were remembered and are gone.
  SpareMemory spare;

  /// A table has no room any more: a derivation ended for it.
  std::atomic<bool> full{false};
};

/// A node of the derivation tree, in path order: a shape made by a rule, or an unnamed leaf.
struct TraceNode {
  static constexpr uint32_t kNone = 0xffffffff;
  /// Stands for a shape that lies below what a filter shows.
  static constexpr uint32_t kCut = kNone - 1;
  uint32_t parent = kNone;
  uint32_t initialShape = 0;
  StringId name = 0;
  /// The instruction that made the shape.
  Span span;
  /// Scope in the world when the shape was made.
  Frame scope;
  Vec3 size;
  bool leaf = false;
  bool dropped = false;
  /// Of a shape that a rule call made, which a step of the derivation replaces: index into
  /// Program::rules. Names without modules do not tell rules apart.
  uint32_t rule = kNone;
  /// What all faces of the shape were tagged with, as it was made and while its rule worked on it
  /// outside of blocks. While deriving a set of the tag table, in the result an index into
  /// DeriveResult::traceTags.
  uint32_t tags = 0;
  /// Index among the leaves of its initial shape's prototype, for leaves with geometry.
  uint32_t leafIndex = kNone;
  /// With DeriveOptions::traceShapes: the same for the shape as the rule got it.
  uint32_t shapeIndex = kNone;
};

/// What a rule drew or looked up while it was at work, in that order; with
/// DeriveOptions::traceShapes.
struct TraceNote {
  enum class Kind : uint8_t { Choice, Draw, Attribute, Parameter } kind = Kind::Draw;
  /// Index of the rule's shape among the trace.
  uint32_t node = 0;
  /// Of a draw, the call in the text; of a choice, the alternatives.
  Span span;
  /// What came of it, under the name of the attribute or parameter. Of a choice nothing.
  AttributeValue value;
  /// Of a choice: what was drawn from 0 to 1, the number of the alternative that this is, among how
  /// many, and its chance. The number behind the last is `else`.
  double draw = 0, chance = 0;
  uint32_t chosen = 0, choices = 0;
};

/// The value of an attribute for an initial shape, in the pool of the derivation.
struct EvaluatedAttribute {
  /// Index into Program::attributes.
  uint32_t attribute = 0;
  Value value;
};

struct DeriveResult;
struct Recall;

struct DeriveOptions {
  int32_t startRule = -1;
  double seed = 0;
  bool sharing = true;
  bool trace = false;
  /// With `trace`: shapes that rules replace are leaves of the scene as well.
  bool traceShapes = false;
  /// With `trace`: what of it is kept.
  TraceFilter traceFilter;
  /// Evaluate the attributes of imported files as well, and hidden ones.
  bool importedAttributes = false;
  int jobs = 1;
  Limits limits;
  /// Attribute values for all initial shapes, over those of the shapes.
  std::vector<std::pair<std::string, Value>> attributes;
  /// Attributes of edges, likewise.
  std::vector<std::pair<std::string, Value>> edgeAttributes;
  /// Where the world lies on the Earth; null where nobody knows.
  const GeoFrame* geo = nullptr;
  /// Called from any thread with the number of initial shapes done.
  std::function<void(size_t done, size_t total)> progress;
  const std::atomic<bool>* cancel = nullptr;
  /// Keep in the result what a later derivation needs to take parts of it over. Without effect
  /// where sharing is off and where rules ask about other shapes.
  bool remember = false;
  /// With `remember`: a derivation in the same environment whose parts may be taken over; null for
  /// none. The result is the same.
  const DeriveResult* before = nullptr;
  /// For lines and columns in the scene's source places; may be null.
  const Sources* sources = nullptr;
};

/// What a root of the scene is of.
struct DerivedRoot {
  /// The number of the initial shape: those whose derivation a limit ended have no root.
  size_t shape = 0;
  /// Its reports are those of the scene from where the root before ends to here.
  size_t reportsEnd = 0;
};

/// Of all shapes that asked for room in a group (`ifFree`).
struct RoomTotal {
  std::string group;
  uint64_t kept = 0, dropped = 0;
};

struct DeriveResult {
  Scene scene;
  /// By root of the scene.
  std::vector<DerivedRoot> roots;
  Diagnostics diagnostics;
  End end = End::Done;
  std::vector<TraceNode> trace;
  std::vector<TraceNote> notes;
  /// Sets of tags that nodes of the trace have, in the order of the nodes; the first is empty.
  std::vector<std::vector<StringId>> traceTags;
  /// Rule attributes of each initial shape as they were evaluated: visible ones of the main file,
  /// and of imported ones where the options ask for them.
  std::vector<std::vector<EvaluatedAttribute>> attributes;
  /// Sorted by group; none where no shape asked.
  std::vector<RoomTotal> rooms;
  /// Derivations that the sharing cache answered.
  uint64_t shared = 0;
  /// Shapes that were taken over from the derivation before, instances expanded.
  uint64_t recalled = 0;
  /// How many parts of initial shapes workers took from each other. It depends on their speed, and
  /// nothing else in the result does.
  uint64_t portions = 0;
  /// With DeriveOptions::remember, of a derivation that came to its end.
  std::shared_ptr<Recall> recall;
};

DeriveResult derive(const Program& program, const std::vector<InitialShape>& shapes,
                    Environment& environment, const DeriveOptions& options);

}  // namespace gable
