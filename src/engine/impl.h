// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What stands behind the public classes. Only the engine sees it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/json.h"
#include "dialects/dialect.h"
#include "engine/project.h"
#include "gable/gable.h"
#include "program/program.h"
#include "runtime/derive.h"
#include "scene/sound.h"

namespace gable {

/// An initial shape as it was read, before attribute values meet a rule file's pool.
struct ShapeFootprint {
  std::string name;
  std::string id;
  Mesh mesh;
  Frame origin;
  std::vector<AttributeValue> attributes;
  /// By face, or empty.
  std::vector<std::string> faceTags;
  /// Its place in the input that it was chosen from; below 0: the place where it is.
  int64_t index = -1;
};

struct Rules::Impl {
  bool found = true;
  Messages messages;
  std::shared_ptr<ValuePool> pool;
  Sources sources;
  Program program;
  std::shared_ptr<Project> project;
  /// The pool with the tables of derivations. Shared with the rules that came before, so that what
  /// those have made can be compared; they grow a little with each text, so after a number of
  /// generations there are new ones.
  std::shared_ptr<Environment> tables;
  uint32_t generation = 0;
  bool ok = false;
  double seconds = 0;
  /// Null for Gable's own language.
  const Dialect* dialect = nullptr;
};

struct Shapes::Impl {
  bool found = true;
  Messages messages;
  std::vector<ShapeFootprint> footprints;
  GeoOrigin geoOrigin;
};

struct Model::Impl {
  bool found = true;
  Messages messages;
  std::shared_ptr<Project> project;
  /// Holds the tables that trace names point into.
  std::shared_ptr<const Rules::Impl> rules;
  DeriveResult result;
  /// What of result.scene can be shown and written; a later derivation goes on from the other.
  SoundScene sound;
  double seconds = 0;

  const Scene& scene() const { return sound.scene ? *sound.scene : result.scene; }
  /// Where result.scene has been made or changed. Tells what is left out.
  void makeSound();
};

/// Cuts footprints out of larger ones that they lie in or overlap: flat faces at one height only.
/// Of a footprint that others cover wholly an inner part stays. O(n^2) box tests, a boolean
/// operation a pair that meets.
void cutNested(std::vector<ShapeFootprint>& footprints);

/// Seconds of a steady clock.
double now();

Message toMessage(const Diagnostic& d, const Sources& sources);
Messages toMessages(const Diagnostics& diagnostics, const Sources& sources);
Message errorMessage(const Error& e);

/// Text of the command line ("3", "true", "#ff0000", "[1,2;3,4]") as a value of an attribute, whose
/// type it must have. Code: attribute-value.
Result<Value> settingOf(const std::string& name, const std::string& text, ValueType type,
                        ValuePool& pool);
Value valueOfAttribute(const AttributeValue& a, ValuePool& pool);

std::string statsOf(const DeriveResult& result, const Scene& scene, const Messages& messages,
                    const Model::Times& times);
std::string traceOf(const DeriveResult& result, const Program& program, const Sources& sources);

/// A number, a text, a bool, or an array of them.
void writeAttribute(JsonWriter& json, const AttributeValue& a);

Tree treeOf(const DeriveResult& result, const Program& program, const Sources& sources);

}  // namespace gable
