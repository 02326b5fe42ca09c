// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Services: what operations and functions need from outside the shape. The runtime and the engine
// implement it; operations know only this interface.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/diagnostic.h"
#include "base/ref.h"
#include "base/result.h"
#include "base/status.h"
#include "geom/mesh/mesh.h"
#include "material/material.h"
#include "program/spec.h"
#include "program/value.h"
#include "shape/shape.h"
#include "shape/tags.h"

namespace gable {

class EdgeAttributes;  // shape/edge_attributes.h
class GeoFrame;        // shape/geo_frame.h
struct Program;        // program/program.h

/// A property that a file carries: a number, a truth (Bool, as a number) or a text.
struct Metadatum {
  std::string key;
  ValueType type = ValueType::Float;
  double number = 0;
  std::string text;
};

/// A model that i() inserts: one mesh, its slots' materials (slot k uses materials[k]).
struct AssetModel : RefCounted {
  MeshRef mesh;
  std::vector<Material> materials;
  /// By slot, the group of the file that its faces are of; empty where the file has no groups.
  std::vector<std::string> groups;
  /// What the file tells of itself.
  std::vector<Metadatum> metadata;
  /// One sentence each: what of the file is left out.
  std::vector<std::string> warnings;
  Box3 bounds;
  /// What is inserted: the mesh moved to begin at the origin, with slots that count from 1 where
  /// there are materials. Made by fitModel; shared by all shapes that insert the model.
  MeshRef fitted;
};

/// Fills in `bounds` and `fitted` from the mesh.
void fitModel(AssetModel& model);
/// What is inserted, made anew where the model does not have it.
MeshRef fittedMesh(const AssetModel& model);

struct ImageInfo {
  bool found = false;
  uint32_t width = 0, height = 0;
  bool hasAlpha = false;
};

/// The hint of all messages about a path that leads nowhere.
inline constexpr const char* kWherePathsStart =
    "paths start at the assets folder or at the root of the project";

/// Files of the project, by the paths that rules write. `fromFile` is the rule file that names the
/// path. A path never leads out of the project. Any thread may call; answers are cached.
class Assets {
 public:
  virtual ~Assets() = default;
  /// Null when there is no such model or it cannot be read; `why` then says which.
  virtual Ref<AssetModel> model(std::string_view path, std::string_view fromFile, bool zUp,
                                std::string& why) = 0;
  virtual ImageInfo image(std::string_view path, std::string_view fromFile) = 0;
  /// The first material of an MTL file. Codes: missing-file, bad-material.
  virtual Result<Material> material(std::string_view path, std::string_view fromFile) = 0;
  virtual bool exists(std::string_view path, std::string_view fromFile) = 0;
  /// Project paths that a query means (shape/file_query.h), sorted; none where it cannot be read.
  virtual std::vector<std::string> search(std::string_view query, std::string_view fromFile) = 0;
  /// The text of a file, for readTextFile and tables; false when there is none.
  virtual bool text(std::string_view path, std::string_view fromFile, std::string& out) = 0;
  /// The project path under which the file is found; the path itself when it is not.
  virtual std::string resolve(std::string_view path, std::string_view fromFile) = 0;
};

/// The values that set() gave to rule attributes of a shape, interned. Keys are indices of the
/// program's attribute table. Any thread may call.
class AttributePool {
 public:
  AttributePool();
  ~AttributePool();
  struct Entry {
    uint32_t key;
    Value value;
    bool operator==(const Entry&) const = default;
  };
  /// Sorted by key. Set 0 is empty.
  const std::vector<Entry>& entries(uint32_t set) const;
  const Value* find(uint32_t set, uint32_t key) const;
  uint32_t with(uint32_t set, uint32_t key, const Value& value);
  /// With several more, sorted by key.
  uint32_t with(uint32_t set, const std::vector<Entry>& more);

  /// Lists of materials for the slots of inserted models; list 0 is empty. Behind the materials in
  /// use a list holds those that the model brought, in the same order, for resetMaterial.
  const std::vector<MaterialId>& materials(uint32_t list) const;
  /// The names of the groups by slot, from slot 1; empty where there are none.
  const std::vector<StringId>& groups(uint32_t list) const;
  uint32_t internMaterials(std::vector<MaterialId> list, std::vector<StringId> groups = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The initial shape that a derivation started from.
struct InitialShapeInfo {
  std::string name;
  std::string startRule;
  /// The object frame in the world.
  Frame origin;
  double seed = 0;
  uint32_t index = 0;
  /// The shape as it was given, in the object frame; for resetGeometry.
  Shape shape;
  /// What is known of its edges; null where nothing is.
  std::shared_ptr<const EdgeAttributes> edges;
  /// Where the world lies on the Earth; null where nobody knows.
  const GeoFrame* geo = nullptr;
};

/// Which occluders a context query looks at.
enum class ContextScope : uint8_t { Intra, Inter, All };
enum class ContextTest : uint8_t { Inside, Overlaps, Touches };

/// By what contextCompare ranks shapes: the first has rank 0.
enum class ContextOrder : uint8_t {
  Northernmost,
  Southernmost,
  Easternmost,
  Westernmost,
  Highest,
  Lowest,
  LargestArea,
  SmallestArea,
};

/// A shape asks for room among those that ask in the same group; see runtime/room.h.
struct RoomRequest {
  StringId group = 0;
  /// Metres to all others of the group.
  double clearance = 0;
  /// Lower ones are answered first.
  double rank = 0;
  /// Things above each other are not in each other's way.
  bool byHeight = false;
  /// The block slot for shapes that have room.
  uint32_t slot = 0;
};
/// Unknown: in the pass that finds out what asks. The shape goes both ways there.
enum class Room : uint8_t { Taken, Free, Unknown };

/// What the code of arguments gave while a call was at work, in order. The second run of the call
/// for the audit gets the same again: the code would see the shape as the first run left it.
struct Evaluations {
  struct One {
    uint32_t entry = 0;
    uint64_t address = 0;
    Value value;
  };
  std::vector<One> all;
  size_t next = 0;
  bool again = false;
  /// The second run asked for something else.
  bool strayed = false;
};

class Services {
 public:
  virtual ~Services() = default;

  ValuePool& pool() const { return *pool_; }
  MaterialTable& materials() const { return *materials_; }
  AttributePool& attributes() const { return *attributes_; }
  TagTable& tags() const { return *tags_; }
  Assets& assets() const { return *assets_; }

  /// The numbered texture that a shape got last, so that the next like it needs no look-up.
  struct TextureMemo {
    bool known = false;
    MaterialId before = 0, after = 0;
    double number = 0, quarters = 0, scale = 0;
  };
  TextureMemo& textureMemo() { return textureMemo_; }

  /// What is derived; null where values are all there is.
  virtual const Program* program() const { return nullptr; }
  /// Runs the code of an argument (ValueCode) on the shape at work, or on another, with an address
  /// of its own for randomness.
  Value evaluate(uint32_t entry, uint64_t address, const Shape* as) {
    if (!evaluations_) return evaluateAtWork(entry, address, as);
    Evaluations& e = *evaluations_;
    if (e.again) {
      const bool known =
          e.next < e.all.size() && e.all[e.next].entry == entry && e.all[e.next].address == address;
      e.strayed = e.strayed || !known;
      return known ? e.all[e.next++].value : Value{};
    }
    // What the code itself works out is part of what it gives.
    const Recording pause(*this, nullptr);
    const Value v = evaluateAtWork(entry, address, as);
    e.all.push_back({entry, address, v});
    return v;
  }

  /// What the call at work may ask for: the effects of its specification. A call that asks for more
  /// would be shared or scheduled wrongly, so builds with checks stop at it.
  class Declared {
   public:
    Declared(Services& services, uint32_t effects)
        : services_(services), before_(services.declared_) {
      services.declared_ = effects;
    }
    ~Declared() { services_.declared_ = before_; }
    Declared(const Declared&) = delete;
    Declared& operator=(const Declared&) = delete;

   private:
    Services& services_;
    uint32_t before_;
  };
  /// While one lives, warnings and leaves of the call at work are lost: it is run a second time.
  class Muted {
   public:
    explicit Muted(Services& services) : services_(services) { services.muted_ = true; }
    ~Muted() { services_.muted_ = false; }
    Muted(const Muted&) = delete;
    Muted& operator=(const Muted&) = delete;

   private:
    Services& services_;
  };
  /// While one lives, what evaluate() gives is kept, or taken from what was kept.
  class Recording {
   public:
    Recording(Services& services, Evaluations* evaluations)
        : services_(services), before_(services.evaluations_) {
      services.evaluations_ = evaluations;
    }
    ~Recording() { services_.evaluations_ = before_; }
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

   private:
    Services& services_;
    Evaluations* before_;
  };
  /// Whether the next call of an operation or a function, by its address, is to be audited: the
  /// first ones of each, and some of the others.
  bool isAuditDue(uintptr_t callee) {
    constexpr uint32_t kFirst = 8, kBetween = 512;
    const uint32_t calls = calls_[callee]++;
    return !muted_ && (calls < kFirst || calls % kBetween == 0);
  }
  /// Whether one of these effects has been declared.
  bool mayAsk(uint32_t effects) const { return (declared_ & effects) != 0; }

  const InitialShapeInfo& initialShape() const {
    GABLE_DCHECK(mayAsk(kReadsInitialShape | kReadsWorld));
    return initialShapeAtWork();
  }
  /// Where the local frame of the present rule call lies in the world.
  const Frame& world() const {
    GABLE_DCHECK(mayAsk(kReadsWorld));
    return worldAtWork();
  }

  /// The shape whose component is asked for a selector's condition; null for all other questions.
  /// Sides (top, front) are those of this shape.
  const Shape* divided() const { return divided_; }

  /// Where a face or an edge of a region comes from, by its tags; null for others.
  const RegionProvenance* regionAt(TagSetId set) const {
    GABLE_DCHECK(mayAsk(kReadsRegion));
    return tags_->region(set);
  }
  const EdgeProvenance* edgeAt(TagSetId set) const {
    GABLE_DCHECK(mayAsk(kReadsRegion));
    return tags_->edge(set);
  }

  void report(StringId key, const Value& value) {
    GABLE_DCHECK(mayAsk(kReports));
    takeReport(key, value);
  }
  void print(std::string text) {
    GABLE_DCHECK(mayAsk(kReports));
    takePrint(std::move(text));
  }
  /// A warning at the present instruction, with the shape's path.
  void warn(const char* code, std::string message, std::string hint) {
    if (!muted_) takeMessage(Severity::Warning, code, std::move(message), std::move(hint));
  }
  /// The same for what may well be meant, and should be known.
  void note(const char* code, std::string message, std::string hint) {
    if (!muted_) takeMessage(Severity::Note, code, std::move(message), std::move(hint));
  }

  /// Context queries; labels are by name, 0 for any occluder.
  bool query(ContextTest test, ContextScope scope, StringId label, const Shape& shape) {
    GABLE_DCHECK(mayAsk(kReadsContext));
    return answerQuery(test, scope, label, shape);
  }
  double minimumDistance(ContextScope scope, StringId label, const Shape& shape) {
    GABLE_DCHECK(mayAsk(kReadsContext));
    return answerDistance(scope, label, shape);
  }
  double contextCount(ContextScope scope, StringId label) {
    GABLE_DCHECK(mayAsk(kReadsContext));
    return answerCount(scope, label);
  }
  /// How many shapes with the label come before this one.
  double contextRank(ContextScope scope, StringId label, ContextOrder order, const Shape& shape) {
    GABLE_DCHECK(mayAsk(kReadsContext));
    return answerRank(scope, label, order, shape);
  }
  Room room(const RoomRequest& request, const Shape& shape) {
    GABLE_DCHECK(mayAsk(kAsksForRoom));
    return answerRoom(request, shape);
  }
  void label(StringId name, const Shape& shape) {
    GABLE_DCHECK(mayAsk(kLabels));
    takeLabel(name, shape);
  }
  /// The path of the present shape in the shape tree ("0;0;1;").
  std::string treeKey() const {
    GABLE_DCHECK(mayAsk(kReadsPath));
    return treeKeyAtWork();
  }

  /// Leaves a copy of the shape at work in the result, as a leaf named after its rule. The shape
  /// goes on, and its rule has made something.
  void leaf() {
    if (!muted_) leaveLeaf();
  }

 private:
  virtual const InitialShapeInfo& initialShapeAtWork() const = 0;
  virtual const Frame& worldAtWork() const = 0;
  virtual void takeReport(StringId key, const Value& value) = 0;
  virtual void takePrint(std::string text) = 0;
  virtual bool answerQuery(ContextTest test, ContextScope scope, StringId label,
                           const Shape& shape) = 0;
  virtual double answerDistance(ContextScope scope, StringId label, const Shape& shape) = 0;
  virtual double answerCount(ContextScope scope, StringId label) = 0;
  virtual double answerRank(ContextScope scope, StringId label, ContextOrder order,
                            const Shape& shape) = 0;
  virtual Room answerRoom(const RoomRequest& request, const Shape& shape) = 0;
  virtual void takeLabel(StringId name, const Shape& shape) = 0;
  virtual std::string treeKeyAtWork() const = 0;
  virtual void takeMessage(Severity severity, const char* code, std::string message,
                           std::string hint) = 0;
  virtual void leaveLeaf() = 0;
  virtual Value evaluateAtWork(uint32_t, uint64_t, const Shape*) { return {}; }

  TextureMemo textureMemo_;
  uint32_t declared_ = ~uint32_t{0};
  bool muted_ = false;
  Evaluations* evaluations_ = nullptr;
  std::unordered_map<uintptr_t, uint32_t> calls_;

 protected:
  ValuePool* pool_ = nullptr;
  MaterialTable* materials_ = nullptr;
  AttributePool* attributes_ = nullptr;
  TagTable* tags_ = nullptr;
  Assets* assets_ = nullptr;
  const Shape* divided_ = nullptr;
};

}  // namespace gable
