// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/city_content.h"

#include <map>

#include "base/work.h"
#include "scene/flatten.h"

namespace gable {
namespace {

class Collector {
 public:
  Collector(const Scene& scene, RootParts& parts, CityFaces& faces, CityKind kindOfShape)
      : scene_(scene), parts_(parts), faces_(faces), kindOfShape_(kindOfShape) {}

  CityContent collect(const Root& root) {
    parts_.settle(scene_, root, faces_, kindOfShape_);
    if (!enters(root.instance, root.instance.frame)) return std::move(out_);
    std::vector<uint32_t> placements;
    const auto open = [&](const Frame& at, size_t level) {
      placements.resize(level + 1);
      placements[level] = static_cast<uint32_t>(out_.placements.size());
      out_.placements.push_back(at);
    };
    open(root.instance.frame, 0);
    const auto leaf = [&](uint32_t index, const Frame&, size_t level) {
      add({index, placements[level]});
    };
    const auto enter = [&](const Instance& in, const Frame& at, size_t level) {
      if (!enters(in, at)) return false;
      open(at, level);
      return true;
    };
    walk(scene_, scene_.prototypes[root.instance.prototype], root.instance.frame, leaf, enter);
    return std::move(out_);
  }

 private:
  // False for what is an object as a whole.
  bool enters(const Instance& in, const Frame& at) {
    const std::optional<CityPart> part = parts_.solitary(in.prototype);
    if (!part) return true;
    out_.instances.push_back({*part, in.prototype, at});
    parts_.skip(in.prototype);
    return false;
  }

  void add(const PlannedLeaf& planned) {
    const Leaf& leaf = scene_.leaves[planned.leaf];
    const CityPart part = parts_.next(leaf);
    PlacedPart placed{planned, part.kind, 0};
    CityObjectKey key;
    key.object = part.object;
    if (specOf(part.kind).object) key.kind = part.kind;
    if (isSolitary(part.kind) || isOpening(part.kind)) {
      if (parts_.begins()) ++runs_;
      placed.run = runs_;
      if (isSolitary(part.kind) && part.object == 0) key.run = runs_;
    }
    const auto [at, isNew] = known_.try_emplace(key, out_.objects.size());
    if (isNew) out_.objects.push_back({key, {}});
    std::vector<PlacedPart>& parts = out_.objects[at->second].parts;
    if (parts.size() == parts.capacity()) workMemory(parts.size() * sizeof(PlacedPart));
    parts.push_back(placed);
  }

  const Scene& scene_;
  RootParts& parts_;
  CityFaces& faces_;
  CityKind kindOfShape_;
  CityContent out_;
  std::map<CityObjectKey, size_t> known_;
  uint32_t runs_ = 0;
};

}  // namespace

CityKind kindOfShape(const std::string& name, const std::vector<AttributeValue>& attributes) {
  for (const AttributeValue& a : attributes) {
    if (a.name != "cityPart" || a.values.empty()) continue;
    const CityKind kind = cityKindNamed(textOf(a.values[0]));
    if (kind != CityKind::Unknown) return kind;
  }
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  if (name.find_first_not_of(kLetters) != std::string::npos) return CityKind::Unknown;
  const CityKind kind = cityKindOfIdentifier(name);
  return isOfBuilding(kind) || kind == CityKind::Land ? CityKind::Unknown : kind;
}

CityKind kindOrLand(const Scene& scene, RootParts& parts, const Root& root, CityKind kind) {
  if (kind != CityKind::Unknown) return kind;
  parts.begin();
  bool lies = false, stands = false;
  forEachLeaf(scene, scene.prototypes[root.instance.prototype], root.instance.frame,
              [&](const Leaf& leaf, const Frame&) {
                const CityKind of = parts.next(leaf).kind;
                lies = lies || of == CityKind::Ground;
                stands = stands || (of != CityKind::Ground && isOfBuilding(of));
              });
  return lies && !stands ? CityKind::Land : kind;
}

std::string titleOfShape(const std::string& name, const std::vector<AttributeValue>& attributes) {
  for (const AttributeValue& a : attributes) {
    if (a.name != "id" || a.values.empty()) continue;
    const std::string& id = a.values[0].text;
    const bool goesOn = id.size() > name.size() + 1 && id.starts_with(name + "/");
    if (!goesOn || id[name.size() + 1] == '/') continue;
    return name == "Building" ? id.substr(name.size() + 1) : id;
  }
  return name;
}

CityContent cityContentOf(const Scene& scene, RootParts& parts, CityFaces& faces, const Root& root,
                          CityKind kindOfShape) {
  const CityKind kind = kindOrLand(scene, parts, root, kindOfShape);
  return Collector(scene, parts, faces, kind).collect(root);
}

}  // namespace gable
