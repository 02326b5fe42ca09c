// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a leaf is in a city model or a building model: a wall, a window, a tree, a street. The word
// for it comes, in this order, from
//   1. the attribute cityPart of the leaf, which rules set: a name of the table below, or the word
//      that CityJSON or IFC have for it ("WallSurface", "IfcWall");
//   2. the label (@Label) or the tag of the nearest shape above it that has one which says it;
//      names go before it where they say a window or a door in a wall or a roof;
//   3. the last word of the leaf's name that says it: FrontDoor is a door, DoorWall a wall;
//   4. the last such word of the rule that made it.
// Small parts that many things have, such as frames and sills, are of what they touch (RootParts).
// Of a name only what follows its last dot counts: what stands before is the name of an import.
// What none of them says is unknown: part of the building, told by where it looks.
// docs/guide/city-models.md has the table for authors of rules.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace gable {

enum class CityKind : uint8_t {
  Unknown,
  Wall,
  Roof,
  Floor,
  Ground,
  Ceiling,
  Window,
  Door,
  Covering,
  Stair,
  Railing,
  Column,
  Beam,
  Chimney,
  Installation,
  Balcony,
  Closure,
  Furniture,
  StreetFurniture,
  Tree,
  Plants,
  Road,
  Square,
  Railway,
  Water,
  Land,
  Bridge,
  Tunnel,
  Construction,
};
constexpr size_t kCityKinds = 29;

struct CityKindSpec {
  /// As rules write it.
  const char* name;
  /// The semantic surface of CityJSON; null: by where the surface looks.
  const char* surface;
  /// The city object that it makes; null: it belongs to the building itself.
  const char* object;
  const char* ifc;
  /// The words of names that say it, with blanks between.
  const char* words;
  /// Words of small parts that it has, and other things as well.
  const char* trim = "";
};
const CityKindSpec& specOf(CityKind kind);

/// Part of a building, or an object that is a child of one.
bool isOfBuilding(CityKind kind);
/// Stands for itself wherever it stands: each one is an object.
bool isSolitary(CityKind kind);
/// Has a semantic surface for each of it: windows and doors.
bool isOpening(CityKind kind);
/// Openings are in it: walls and roofs.
bool holdsOpenings(CityKind kind);

/// Looks up or down by nature: floors, balconies, ceilings and ground.
bool isLevel(CityKind kind);

/// A kind by a name of its row, whatever the case of its letters; Unknown for any other text.
CityKind cityKindNamed(std::string_view name);
/// What the last telling word of an identifier says, without the import before its dot.
struct CityWord {
  /// Unknown where no word tells.
  CityKind kind = CityKind::Unknown;
  /// The word is "lot". Rules begin with a lot, so it says land of what is called so and flat:
  /// `Lot --> extrude(9)` is a house, and what its rule makes besides is anything.
  bool isLot = false;
};
CityWord cityWordOf(std::string_view name);
/// Its kind alone.
CityKind cityKindOfIdentifier(std::string_view name);
/// What a label or a tag says: a name of the table, else the last telling word of all its text. The
/// tags that roofs give their faces (roof.top, roof.side, roof.bottom) say nothing: the sides of a
/// roof are walls.
CityKind cityKindOfLabel(std::string_view label);
/// What a name alone says whose telling words are of small parts that windows have, and doors,
/// stairs and roofs as well: Window for a frame or a bar, Covering for a sill or a moulding.
/// Unknown for all other names.
CityKind trimKindOf(std::string_view name);
/// Trim that touches it is part of it.
bool takesTrim(CityKind kind);

/// What a leaf is a part of.
struct CityPart {
  CityKind kind = CityKind::Unknown;
  /// The kind is that of trim alone, and what it touches says more.
  bool trim = false;
  /// Of the attributes cityObject and cityStorey: indices into CityParts::texts(), 0 for none.
  uint32_t object = 0, storey = 0;
  /// LabelledLeaves::shape where a label says the kind, 0 elsewhere.
  uint32_t shape = 0;
  friend bool operator==(const CityPart&, const CityPart&) = default;
};

/// What two leaves that touch are together, where they are of one thing: of one part, or one is
/// trim of the other. Two that are trim are a window where one of them is of a window.
std::optional<CityPart> partOfBoth(const CityPart& a, const CityPart& b);

/// What a leaf or a prototype of a shape of that kind is: a shape that is no building makes none.
CityPart partWithin(CityPart part, CityKind kindOfShape);

/// The parts of a scene's leaves, as names and attributes say them.
class CityParts {
 public:
  /// Linear in what the scene stores.
  explicit CityParts(const Scene& scene);

  CityPart of(const Leaf& leaf) const;
  /// What its attributes alone say.
  CityPart saidBy(const Leaf& leaf) const;
  /// The part that all leaves of a prototype are of, instances expanded; null where they differ, or
  /// where it is not known.
  const CityPart* wholePart(uint32_t prototype) const { return named_.one(prototype); }
  /// The same by attributes alone; its kind may be unknown.
  const CityPart* wholeSaid(uint32_t prototype) const { return said_.one(prototype); }
  /// Names or attributes say an opening of some leaf of a prototype, instances expanded.
  bool hasOpening(uint32_t prototype) const { return hasOpening_[prototype]; }
  /// Of a prototype, instances expanded.
  uint64_t leafCount(uint32_t prototype) const { return leafCounts_[prototype]; }
  /// How often instances and roots show a prototype, 2 for more.
  uint8_t uses(uint32_t prototype) const { return uses_[prototype]; }
  const std::string& text(uint32_t number) const { return texts_[number]; }
  /// Values of cityPart that name nothing, each once, in the order of the scene.
  const std::vector<std::string>& unknownWords() const { return unknownWords_; }

 private:
  // By prototype, whether its leaves are of one part, and which.
  struct Wholes {
    enum class Whole : uint8_t { Empty, One, Mixed };
    std::vector<Whole> whole;
    std::vector<CityPart> part;
    const CityPart* one(uint32_t p) const { return whole[p] == Whole::One ? &part[p] : nullptr; }
    void take(size_t prototype, const CityPart& of, Whole how);
  };
  void readAttributes(const Scene& scene, const std::vector<uint32_t>& set);
  template <class PartOf>
  static Wholes wholesOf(const Scene& scene, PartOf&& partOf);
  void countUses(const Scene& scene);
  void findOpenings(const Scene& scene);
  uint32_t numberOf(const std::string& text);

  CityKind kindOf(const CityWord& name, const Leaf& leaf) const;

  // By name, source and attribute set.
  std::vector<CityWord> names_, sources_;
  // By mesh: the height of a body, where a leaf of a lot shows it.
  std::vector<std::optional<double>> bodies_;
  std::vector<CityKind> trims_;
  std::vector<CityPart> setParts_;
  std::vector<std::string> texts_{""};
  std::map<std::string, uint32_t> textNumbers_;
  std::vector<std::string> unknownWords_;
  Wholes named_, said_;
  std::vector<bool> hasOpening_;
  std::vector<uint64_t> leafCounts_;
  std::vector<uint8_t> uses_;
};

/// What an attribute or a report says, as text: numbers as short as they are, bools true or false.
std::string textOf(const PlainValue& v);

}  // namespace gable
