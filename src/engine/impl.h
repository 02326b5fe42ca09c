// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What stands behind the public classes. Only the engine sees it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "city/terrain_surface.h"
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
  /// See InitialShape.
  uint64_t feature = 0;
  Mesh mesh;
  Frame origin;
  std::vector<AttributeValue> attributes;
  /// By face, or empty.
  std::vector<std::string> faceTags;
  std::vector<double> streetWidths;
  /// Of the slots from 1 of the mesh; see InitialShape.
  std::vector<Material> materials;
  std::vector<std::string> groups;
  /// Its place in the input that it was chosen from; below 0: the place where it is.
  int64_t index = -1;
  /// Its attributes reach attributes of imported files as well: see Rules::Impl::open.
  bool reachesImports = false;
  /// See InitialShape.
  bool upright = false;
};

struct Rules::Impl {
  bool found = true;
  DiagnosticList diagnostics;
  std::shared_ptr<ValuePool> pool;
  Sources sources;
  /// By file of the sources, so that the rules that come next need not parse it again; null where
  /// its text is not Gable's own language or something was told of it.
  std::vector<lang::TreeRef> trees;
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
  /// As the public class gives them.
  std::vector<ImportInfo> imports;
  std::vector<AssetUse> assets;
  std::vector<std::vector<AttributeInfo::Annotation>> ruleAnnotations;
  std::string description;
  std::vector<std::string> styles;
  /// Attributes of imported files that no file above declares, overrides or protects, by their own
  /// names: "height" to "house.height".
  std::multimap<std::string, std::string> open;
  /// These rules with the code of those that are not reached, for starting with one of them; made
  /// when it is first asked for, of the texts that these were made of.
  std::shared_ptr<const Impl> whole() const;
  std::function<std::shared_ptr<const Impl>(const Impl& reached)> readWhole;
  mutable std::mutex wholeMutex;
  mutable std::shared_ptr<const Impl> wholeMade;
};

struct Shapes::Impl {
  bool found = true;
  DiagnosticList diagnostics;
  std::vector<ShapeFootprint> footprints;
  GeoOrigin geoOrigin;
  /// The pictures that materials of the footprints name.
  TextureBytes textures;
  std::shared_ptr<const GeoFrame> geo;
  /// Where it is set, what is made of shapes that lie on the ground is laid on it; see
  /// city/drape.h.
  std::shared_ptr<const TerrainSurface> terrain;
  /// Their properties are words of the map, which nobody has written for these rules.
  bool ofMap = false;
  /// Not some of others, of which more can be said together.
  bool isWhole = true;
};

/// What a model was derived from besides its rules, for what is found out later by deriving again.
struct DerivedFrom {
  Shapes shapes;
  /// Without what belongs to the one derivation: progress, cancelling, what came before.
  DeriveSettings settings;
};

struct Model::Impl {
  Impl() = default;
  Impl(const Impl&) = default;
  /// Leaves its large blocks of memory to the next derivation, where there may be one.
  ~Impl();

  bool found = true;
  DiagnosticList diagnostics;
  std::shared_ptr<Project> project;
  /// Holds the tables that trace names point into.
  std::shared_ptr<const Rules::Impl> rules;
  DeriveResult result;
  /// Null where it was not derived.
  std::shared_ptr<const DerivedFrom> from;
  /// What initial shapes came with, and where their world lies on the Earth, for city models.
  std::vector<std::vector<AttributeValue>> shapeAttributes;
  std::shared_ptr<const GeoFrame> geo;
  /// The rule that shapes start with that name none, and the attributes that the caller has set.
  int32_t startRule = -1;
  std::set<std::string> setAttributes;
  /// What of result.scene can be shown and written; a later derivation goes on from the other.
  SoundScene sound;
  double seconds = 0;

  const Scene& scene() const { return sound.scene ? *sound.scene : result.scene; }
  /// Where result.scene has been made or changed. Tells what is left out.
  void makeSound(unsigned jobs = 1);
};

/// Cuts footprints out of larger ones that they lie in or overlap: flat faces at one height only.
/// Of a footprint that others cover wholly an inner part stays. O(n^2) box tests, a boolean
/// operation a pair that meets.
void cutNested(std::vector<ShapeFootprint>& footprints);

/// What city models say of a root: its reports, numbers of one key summed; then the attributes that
/// its rules read or that the caller has set, as rules see them; then those that it came with, but
/// for those of its edges.
std::vector<AttributeValue> knownOfRoot(const Model::Impl& model, size_t root);

std::vector<ShapeReports> reportsByShapeOf(const Model::Impl& model);

/// The paths of all textures that materials of a scene name.
std::vector<std::string> texturesOf(const Scene& scene);

/// Seconds of a steady clock.
double now();

Diagnostic diagnosticOf(const Diagnostics::Entry& e, const Sources& sources);
Diagnostic diagnosticOf(const Error& e);
/// What an operation gives that could not be done: nothing but the reason.
template <class Made>
Made failed(const Error& e) {
  Made none;
  none.diagnostics.push_back(diagnosticOf(e));
  return none;
}
DiagnosticList listOf(const Diagnostics& diagnostics, const Sources& sources);

/// Text of the command line ("3", "true", "#ff0000", "[1,2;3,4]") as a value of an attribute, whose
/// type it must have. Code: attribute-value.
/// What a text says on its own: [1,2;3,4] is an array, with rows by semicolons, of the type of its
/// first element.
Value valueOfText(const std::string& text, ValuePool& pool);
Result<Value> settingOf(const std::string& name, const std::string& text, ValueType type,
                        ValuePool& pool);
/// What is wrong with a value that the annotations of its attribute do not allow. A word that
/// @Enum does not have is an error, all else a warning: attribute-outside.
std::optional<Diagnostics::Entry> outsideOf(const AttributeCode& a, const Value& v,
                                            const ValuePool& pool);
Value valueOfAttribute(const AttributeValue& a, ValuePool& pool);

RuleValue ruleValueOf(const AttributeValue& a);
AttributeValue attributeValueOf(const NamedValue& given);
std::vector<NamedValue> namedValuesOf(const std::vector<AttributeValue>& attributes);
MaterialInfo materialInfoOf(const Material& m);
BoundingBox boundingBoxOf(const Box3& box);

Statistics statisticsOf(const Scene& scene);
std::shared_ptr<Model::Impl> derived(const Rules& rules, const Shapes& shapes,
                                     const DeriveSettings& settings);
DerivationTrace traceOf(const DeriveResult& result, const Program& program, const Sources& sources);
/// Absent when there is no leaf of that number.
std::optional<LeafInfo> leafOf(const Scene& scene, uint64_t number);
ModelParts partsOf(const Scene& scene, uint64_t leaf, size_t level, uint64_t most);
ModelGeometry geometryOf(const Scene& scene, uint64_t mostLeaves);
/// The same as a settled asset; see Model::prepared.
std::shared_ptr<const Model::Impl> preparedOf(const Model::Impl& from,
                                              const PrepareSettings& settings);

}  // namespace gable
