// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/city_kinds.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/text.h"
#include "base/work.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// In the order of CityKind. The classes of CityJSON 2.0 (https://www.cityjson.org/specs/2.0.1) and
// of IFC4 ADD2 TC1.
constexpr CityKindSpec kSpecs[kCityKinds] = {
    {"Unknown", nullptr, nullptr, "IfcBuildingElementProxy", ""},
    {"Wall", "WallSurface", nullptr, "IfcWall",
     "wall walls facade facades siding stucco plaster masonry gable spandrel"},
    {"Roof", "RoofSurface", nullptr, "IfcRoof",
     "roof roofs roofing dormer ridge thatch slate slates shingle shingles"},
    {"Floor", "OuterFloorSurface", nullptr, "IfcSlab", "slab slabs deck terrace"},
    {"Ground", "GroundSurface", nullptr, "IfcSlab", "foundation ground"},
    {"Ceiling", "OuterCeilingSurface", nullptr, "IfcCovering", "ceiling ceilings soffit"},
    {"Window", "Window", nullptr, "IfcWindow",
     "window windows glass glazing pane panes sash shutter shutters skylight",
     "frame frames bar bars mullion mullions muntin muntins"},
    {"Door", "Door", nullptr, "IfcDoor", "door doors gate entrance portal"},
    {"Covering", nullptr, nullptr, "IfcCovering", "covering cladding",
     "sill sills trim trims moulding mouldings cornice cornices"},
    {"Stair", nullptr, "BuildingInstallation", "IfcStair", "stair stairs staircase step steps"},
    {"Railing", nullptr, "BuildingInstallation", "IfcRailing",
     "railing railings rail handrail balustrade baluster balusters"},
    {"Column", nullptr, "BuildingConstructiveElement", "IfcColumn",
     "column columns pillar pillars pilaster pilasters"},
    {"Beam", nullptr, "BuildingConstructiveElement", "IfcBeam",
     "beam beams lintel lintels girder rafter rafters joist purlin"},
    {"Chimney", nullptr, "BuildingInstallation", "IfcChimney", "chimney chimneys"},
    {"Installation", nullptr, "BuildingInstallation", "IfcBuildingElementProxy",
     "installation antenna awning"},
    {"Balcony", "OuterFloorSurface", "BuildingInstallation", "IfcSlab",
     "balcony balconies loggia loggias"},
    {"Closure", "ClosureSurface", nullptr, "IfcBuildingElementProxy", "closure"},
    {"Furniture", nullptr, "BuildingFurniture", "IfcFurniture",
     "furniture chair chairs sofa cupboard"},
    {"StreetFurniture", nullptr, "CityFurniture", "IfcFurniture",
     "bench benches lamp lamps lamppost bollard bollards hydrant signpost fence"},
    {"Tree", nullptr, "SolitaryVegetationObject", "IfcGeographicElement",
     "tree trees trunk crown foliage bark branch branches bush shrub"},
    {"Plants", nullptr, "PlantCover", "IfcGeographicElement",
     "plants grass lawn meadow hedge flowers flowerbed"},
    {"Road", nullptr, "Road", "IfcGeographicElement",
     "road roads street carriageway junction sidewalk pavement kerb curb asphalt path driveway"},
    {"Square", nullptr, "TransportSquare", "IfcGeographicElement",
     "square paving parking courtyard forecourt patio plaza"},
    {"Railway", nullptr, "Railway", "IfcGeographicElement", "railway rails sleeper"},
    {"Water", nullptr, "WaterBody", "IfcGeographicElement", "water sea lake pond pool river"},
    {"Land", nullptr, "LandUse", "IfcGeographicElement",
     "land lot yard garden gardens soil earth field sand"},
    {"Bridge", nullptr, "Bridge", "IfcCivilElement", "bridge"},
    {"Tunnel", nullptr, "Tunnel", "IfcCivilElement", "tunnel"},
    {"Construction", nullptr, "OtherConstruction", "IfcBuildingElementProxy", "construction"},
};

// Sorted.
using Words = std::vector<std::pair<std::string_view, CityKind>>;

Words wordsOf(const char* CityKindSpec::*list) {
  Words out;
  for (size_t k = 0; k < kCityKinds; ++k) {
    std::string_view left = kSpecs[k].*list;
    while (!left.empty()) {
      const size_t end = std::min(left.find(' '), left.size());
      out.emplace_back(left.substr(0, end), static_cast<CityKind>(k));
      left.remove_prefix(std::min(end + 1, left.size()));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

CityKind kindOf(const std::string& word, const Words& words) {
  const auto at =
      std::lower_bound(words.begin(), words.end(), word,
                       [](const auto& row, const std::string& w) { return row.first < w; });
  return at != words.end() && at->first == word ? at->second : CityKind::Unknown;
}

CityKind kindOfWord(const std::string& word) {
  static const Words kWords = wordsOf(&CityKindSpec::words);
  return kindOf(word, kWords);
}

CityKind trimKindOfWord(const std::string& word) {
  static const Words kWords = wordsOf(&CityKindSpec::trim);
  return kindOf(word, kWords);
}

bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool isLetter(char c) { return isUpper(c) || (c >= 'a' && c <= 'z'); }

}  // namespace

const CityKindSpec& specOf(CityKind kind) { return kSpecs[static_cast<size_t>(kind)]; }

bool isOfBuilding(CityKind kind) {
  const char* object = specOf(kind).object;
  return !object || std::string_view(object).starts_with("Building");
}

bool isSolitary(CityKind kind) {
  return kind == CityKind::Tree || kind == CityKind::StreetFurniture;
}

bool isOpening(CityKind kind) { return kind == CityKind::Window || kind == CityKind::Door; }

bool holdsOpenings(CityKind kind) { return kind == CityKind::Wall || kind == CityKind::Roof; }

bool isLevel(CityKind kind) {
  return kind == CityKind::Floor || kind == CityKind::Balcony || kind == CityKind::Ceiling ||
         kind == CityKind::Ground;
}

CityKind cityKindNamed(std::string_view name) {
  for (size_t k = 1; k < kCityKinds; ++k) {
    const CityKindSpec& s = kSpecs[k];
    for (const char* known : {s.name, s.surface, s.object, s.ifc}) {
      if (known && equalButForCase(name, known)) return static_cast<CityKind>(k);
    }
  }
  return CityKind::Unknown;
}

namespace {

// What follows the last dot: what stands before is the name of an import.
std::string_view ownName(std::string_view name) { return name.substr(name.rfind('.') + 1); }

// Calls `take` for each word, the last first, until it gives true.
template <class Take>
void forEachWord(std::string_view name, Take&& take) {
  size_t end = name.size();
  while (end > 0) {
    if (!isLetter(name[end - 1])) {
      --end;
      continue;
    }
    // A word begins with a capital, or behind what is no letter.
    size_t begin = end - 1;
    while (begin > 0 && !isUpper(name[begin]) && isLetter(name[begin - 1])) --begin;
    if (take(lowerCase(name.substr(begin, end - begin)))) return;
    end = begin;
  }
}

// Of a mesh that looks down somewhere, in the frame of its leaf; else 0.
double heightOfBody(const Mesh& mesh) {
  constexpr double kDown = -0.5;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    work();
    if (mesh.normal(f).y < kDown) return mesh.bounds().size().y;
  }
  return 0;
}

}  // namespace

CityWord cityWordOf(std::string_view name) {
  CityWord out;
  forEachWord(ownName(name), [&](const std::string& word) {
    out = {kindOfWord(word), word == "lot"};
    return out.kind != CityKind::Unknown;
  });
  return out;
}

CityKind cityKindOfIdentifier(std::string_view name) { return cityWordOf(name).kind; }

CityKind cityKindOfLabel(std::string_view label) {
  CityKind kind = cityKindNamed(label);
  if (kind != CityKind::Unknown) return kind;
  for (const std::string_view ofRoofs : {"roof.top", "roof.side", "roof.bottom"}) {
    if (label == ofRoofs) return kind;
  }
  forEachWord(label, [&](const std::string& word) {
    kind = kindOfWord(word);
    return kind != CityKind::Unknown;
  });
  return kind;
}

CityKind trimKindOf(std::string_view name) {
  CityKind kind = CityKind::Unknown;
  forEachWord(ownName(name), [&](const std::string& word) {
    kind = trimKindOfWord(word);
    return kind != CityKind::Unknown;
  });
  return cityKindOfIdentifier(name) == CityKind::Unknown ? kind : CityKind::Unknown;
}

bool takesTrim(CityKind kind) {
  switch (kind) {
    case CityKind::Window:
    case CityKind::Door:
    case CityKind::Stair:
    case CityKind::Railing:
    case CityKind::Column:
    case CityKind::Beam:
    case CityKind::Chimney:
    case CityKind::Installation:
    case CityKind::Furniture:
    case CityKind::StreetFurniture: return true;
    default: return false;
  }
}

CityParts::CityParts(const Scene& scene) {
  for (const std::string& name : scene.names) {
    work(name.size());
    names_.push_back(cityWordOf(name));
    trims_.push_back(trimKindOf(name));
  }
  for (const SourcePlace& s : scene.sources) {
    work(s.rule.size());
    sources_.push_back(cityWordOf(s.rule));
  }
  bodies_.resize(scene.meshes.size());
  for (const Leaf& l : scene.leaves) {
    work();
    const bool isLot = l.name < names_.size() && names_[l.name].isLot;
    std::optional<double>& height = bodies_[l.mesh];
    if (isLot && !height) height = heightOfBody(*scene.meshes[l.mesh]);
  }
  for (const auto& set : scene.attributeSets) readAttributes(scene, set);
  named_ = wholesOf(scene, [this](const Leaf& leaf) {
    const CityPart part = of(leaf);
    return part.kind == CityKind::Unknown ? std::nullopt : std::optional(part);
  });
  said_ = wholesOf(scene, [this](const Leaf& leaf) { return std::optional(saidBy(leaf)); });
  findOpenings(scene);
  leafCounts_ = prototypeLeafCounts(scene);
  countUses(scene);
}

uint32_t CityParts::numberOf(const std::string& text) {
  if (text.empty()) return 0;
  const auto [at, isNew] = textNumbers_.try_emplace(text, static_cast<uint32_t>(texts_.size()));
  if (isNew) texts_.push_back(text);
  return at->second;
}

void CityParts::readAttributes(const Scene& scene, const std::vector<uint32_t>& set) {
  CityPart& part = setParts_.emplace_back();
  for (const uint32_t place : set) {
    work();
    const AttributeValue& a = scene.attributeValues[place];
    // Attributes of imported files have the name of the import before a dot.
    const size_t dot = a.name.rfind('.');
    const std::string_view name =
        std::string_view(a.name).substr(dot == std::string::npos ? 0 : dot + 1);
    if (!name.starts_with("city") || a.values.empty()) continue;
    const std::string value = textOf(a.values[0]);
    if (name == "cityObject") part.object = numberOf(value);
    if (name == "cityStorey") part.storey = numberOf(value);
    if (name != "cityPart" || value.empty()) continue;
    part.kind = cityKindNamed(value);
    if (part.kind != CityKind::Unknown) continue;
    if (std::find(unknownWords_.begin(), unknownWords_.end(), value) == unknownWords_.end()) {
      constexpr size_t kMostTold = 20;
      if (unknownWords_.size() < kMostTold) unknownWords_.push_back(value);
    }
  }
}

// A body that is higher than soil is thick is what stands on the lot.
CityKind CityParts::kindOf(const CityWord& name, const Leaf& leaf) const {
  constexpr double kSoil = 1;
  const bool stands = name.isLot && bodies_[leaf.mesh].value_or(0) * std::abs(leaf.scale.y) > kSoil;
  return stands ? CityKind::Unknown : name.kind;
}

CityPart CityParts::saidBy(const Leaf& leaf) const {
  return leaf.attributes < setParts_.size() ? setParts_[leaf.attributes] : CityPart{};
}

CityPart CityParts::of(const Leaf& leaf) const {
  CityPart part = saidBy(leaf);
  if (part.kind == CityKind::Unknown && leaf.name < names_.size()) {
    part.kind = kindOf(names_[leaf.name], leaf);
  }
  if (part.kind != CityKind::Unknown) return part;
  if (leaf.source < sources_.size() && !sources_[leaf.source].isLot) {
    part.kind = sources_[leaf.source].kind;
  }
  const bool isTrimmed = part.kind == CityKind::Unknown || part.kind == CityKind::Wall;
  if (!isTrimmed || leaf.name >= trims_.size()) return part;
  if (const CityKind trim = trims_[leaf.name]; trim != CityKind::Unknown) {
    part.kind = trim;
    part.trim = true;
  }
  return part;
}

CityPart partWithin(CityPart part, CityKind kindOfShape) {
  const bool says = part.kind != CityKind::Unknown;
  const bool takesShape = !says || (!isOfBuilding(kindOfShape) && isOfBuilding(part.kind));
  if (kindOfShape == CityKind::Unknown || !takesShape) return part;
  part.kind = kindOfShape;
  part.shape = 0;
  return part;
}

std::optional<CityPart> partOfBoth(const CityPart& a, const CityPart& b) {
  if (a.object != b.object || a.storey != b.storey) return std::nullopt;
  if (a == b) return a;
  if (a.trim && b.trim) return a.kind == CityKind::Window ? a : b;
  if (a.trim && takesTrim(b.kind)) return b;
  if (b.trim && takesTrim(a.kind)) return a;
  return std::nullopt;
}

void CityParts::Wholes::take(size_t p, const CityPart& of, Whole how) {
  if (how == Whole::Empty || whole[p] == Whole::Mixed) return;
  const std::optional<CityPart> both =
      whole[p] == Whole::One ? partOfBoth(part[p], of) : std::optional(of);
  whole[p] = both ? how : Whole::Mixed;
  part[p] = both.value_or(of);
}

// `partOf` gives nothing for leaves that no prototype may be whole with.
template <class PartOf>
CityParts::Wholes CityParts::wholesOf(const Scene& scene, PartOf&& partOf) {
  using Whole = Wholes::Whole;
  Wholes out;
  out.whole.assign(scene.prototypes.size(), Whole::Empty);
  out.part.resize(scene.prototypes.size());
  for (size_t p = 0; p < scene.prototypes.size(); ++p) {
    const Prototype& prototype = scene.prototypes[p];
    for (uint32_t l = 0; l < prototype.leafCount && out.whole[p] != Whole::Mixed; ++l) {
      work();
      const std::optional<CityPart> part = partOf(scene.leaves[prototype.firstLeaf + l]);
      out.take(p, part.value_or(CityPart{}), part ? Whole::One : Whole::Mixed);
    }
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      work();
      const uint32_t inner = scene.instances[prototype.firstInstance + i].prototype;
      out.take(p, out.part[inner], out.whole[inner]);
    }
  }
  return out;
}

void CityParts::findOpenings(const Scene& scene) {
  hasOpening_.assign(scene.prototypes.size(), false);
  for (size_t p = 0; p < scene.prototypes.size(); ++p) {
    const Prototype& prototype = scene.prototypes[p];
    for (uint32_t l = 0; l < prototype.leafCount && !hasOpening_[p]; ++l) {
      work();
      hasOpening_[p] = isOpening(of(scene.leaves[prototype.firstLeaf + l]).kind);
    }
    for (uint32_t i = 0; i < prototype.instanceCount && !hasOpening_[p]; ++i) {
      work();
      hasOpening_[p] = hasOpening_[scene.instances[prototype.firstInstance + i].prototype];
    }
  }
}

void CityParts::countUses(const Scene& scene) {
  uses_.assign(scene.prototypes.size(), 0);
  const auto use = [&](uint32_t p) {
    uses_[p] = static_cast<uint8_t>(uses_[p] < 2 ? uses_[p] + 1 : 2);
  };
  for (const Prototype& prototype : scene.prototypes) {
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      work();
      use(scene.instances[prototype.firstInstance + i].prototype);
    }
  }
  for (const Root& r : scene.roots) use(r.instance.prototype);
}

std::string textOf(const PlainValue& v) {
  if (v.kind == PlainValue::Kind::Text) return v.text;
  if (v.kind == PlainValue::Kind::Bool) return v.number != 0 ? "true" : "false";
  return shortestText(v.number);
}

}  // namespace gable
