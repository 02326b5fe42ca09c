// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/city_json_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/most_diagnostics.h"
#include "base/work.h"
#include "io/geo/geo_frames.h"
#include "io/importers/city_json_geometry.h"
#include "io/importers/shape_parts.h"
#include "math/box.h"

namespace gable {
namespace {

// Coordinates beyond are those of a map, and are brought near the origin.
constexpr double kMapCoordinates = 1e5;
constexpr double kFarthest = 1e8;

class Reader {
 public:
  Reader(const JsonValue& root, std::string path, const FeatureFilter& filter)
      : root_(root), path_(std::move(path)), filter_(filter), geometry_(root) {}

  Result<ShapeFile> read() {
    if (!root_["CityObjects"].isObject() || !root_["vertices"].isArray()) {
      return Error{"shapes-broken", "'" + path_ + "' is CityJSON without city objects or vertices",
                   "check it with a validator of CityJSON"};
    }
    const auto& all = root_["CityObjects"].members();
    for (const auto& [id, object] : all) objects_.emplace(id, &object);
    chooseOrigin();
    for (const auto& [id, object] : all) {
      work();
      add(id, object);
    }
    conclude();
    if (out_.shapes.empty()) return empty();
    turnFootprintsUp(out_);
    return std::move(out_);
  }

 private:
  void complain(const std::string& id, const std::string& reason) {
    if (++messages_ > kMostDiagnostics) return;
    out_.diagnostics.warning(
        "shape-surface-broken", {},
        "object '" + id + "' of '" + path_ + "': " + reason + "; the surface is left out");
  }

  void conclude() {
    if (messages_ > kMostDiagnostics) {
      out_.diagnostics.warning("shape-surface-broken", {},
                               "'" + path_ + "' has " +
                                   std::to_string(messages_ - kMostDiagnostics) +
                                   " more messages of this kind");
    }
  }

  Error empty() const {
    Error error = emptyShapes(path_);
    if (passed_ == 0 && !filter_.key.empty()) {
      error.message = "of the " + std::to_string(objects_.size()) + " objects of '" + path_ +
                      "' none has '" + filter_.key +
                      (filter_.value.empty() ? "" : "=" + filter_.value) + "'";
      error.hint = "choose by an attribute, or by type: --only type=Building";
    }
    return error;
  }

  // The middle of all vertices that objects use would depend on what is chosen; that of all of the
  // file does not.
  void chooseOrigin() {
    const JsonValue &scale = root_["transform"]["scale"], &shift = root_["transform"]["translate"];
    Box2 box;
    for (const JsonValue& v : root_["vertices"].items()) {
      work();
      const auto at = [&](size_t i) {
        return v.at(i).number(0) * scale.at(i).number(1) + shift.at(i).number(0);
      };
      const Vec2 p{at(0), at(1)};
      if (std::isfinite(p.x) && std::isfinite(p.y)) box.include(p);
    }
    if (box.empty()) return;
    const Vec2 c = box.center();
    if (std::fabs(c.x) > kMapCoordinates || std::fabs(c.y) > kMapCoordinates) {
      origin_ = {std::floor(c.x), std::floor(c.y)};
    }
    const std::string system = cityJsonSystem(root_);
    if (!system.empty()) out_.geo = mapGeoFrame(system, origin_);
  }

  bool passes(const JsonValue& object) const {
    if (filter_.key.empty()) return true;
    const JsonValue& v = filter_.key == "type" ? object["type"] : attributeOf(object);
    if (!filter_.value.empty()) return cityJsonText(v) == filter_.value;
    return !v.isNull() && v.text() != "no";
  }

  // That of the filter: the object's own, else that of the building that it is a part of.
  const JsonValue& attributeOf(const JsonValue& object) const {
    const JsonValue* v = &object["attributes"][filter_.key];
    forEachOwner(object, [&](const JsonValue& of) {
      if (v->isNull()) v = &of["attributes"][filter_.key];
    });
    return *v;
  }

  // Calls `visit` for an object and what it is a part of, from the inside out.
  template <class Visit>
  void forEachOwner(const JsonValue& object, const Visit& visit) const {
    constexpr int kDeepest = 8;
    const JsonValue* of = &object;
    for (int depth = 0; of && depth < kDeepest; ++depth) {
      visit(*of);
      const auto parent = objects_.find((*of)["parents"].at(0).text());
      of = parent == objects_.end() ? nullptr : parent->second;
    }
  }

  void add(const std::string& id, const JsonValue& object) {
    if (!passes(object)) return;
    ++passed_;
    const std::vector<CityJsonBody> bodies =
        geometry_.of(object, [&](const std::string& reason) { complain(id, reason); });
    const CityJsonBody* finest = nullptr;
    for (const CityJsonBody& b : bodies) {
      if (!b.faces.empty() && (!finest || b.lod > finest->lod)) finest = &b;
    }
    if (!finest) return;
    ShapeInput shape;
    shape.name = id;
    shape.id = id;
    addFaces(*finest, id, shape);
    if (shape.mesh.empty()) return;
    addAttributes(object, shape);
    out_.shapes.push_back(std::move(shape));
  }

  void addFaces(const CityJsonBody& body, const std::string& id, ShapeInput& shape) {
    MeshBuilder b;
    std::map<std::array<double, 3>, uint32_t> known;
    bool tagged = false;
    for (const CityJsonFace& face : body.faces) {
      if (!(length(cityJsonNormal(face.rings[0])) > 0)) continue;
      const bool near = std::all_of(face.rings.begin(), face.rings.end(), [&](const auto& ring) {
        return std::all_of(ring.begin(), ring.end(), [&](const Vec3& p) {
          return std::fabs(p.x - origin_.x) < kFarthest && std::fabs(p.y - origin_.y) < kFarthest &&
                 std::fabs(p.z) < kFarthest;
        });
      });
      if (!near) {
        complain(id, "a vertex is too far away");
        continue;
      }
      b.beginFace();
      for (const std::vector<Vec3>& ring : face.rings) {
        b.beginLoop();
        for (const Vec3& p : ring) {
          work();
          const Vec3 at{p.x - origin_.x, p.z, -(p.y - origin_.y)};
          const auto [place, isNew] = known.try_emplace({at.x, at.y, at.z}, 0);
          if (isNew) place->second = b.addPosition(at);
          b.addCorner(place->second);
        }
      }
      shape.faceTags.emplace_back(face.meaning);
      tagged = tagged || !face.meaning.empty();
    }
    if (!tagged) shape.faceTags.clear();
    shape.mesh = b.take();
  }

  // Those of the object go before those of the building that it is a part of.
  void addAttributes(const JsonValue& object, ShapeInput& shape) const {
    shape.attributes.push_back(
        {"cityType", {{PlainValue::Kind::Text, 0, object["type"].text()}}, 0, 0});
    forEachOwner(object, [&](const JsonValue& of) {
      for (const JsonValue::Member& member : of["attributes"].members()) {
        work();
        ShapeInput one;
        addAttribute(member, one);
        if (one.attributes.empty()) continue;
        const auto same = [&](const AttributeValue& a) { return a.name == one.attributes[0].name; };
        if (std::none_of(shape.attributes.begin(), shape.attributes.end(), same)) {
          shape.attributes.push_back(std::move(one.attributes[0]));
        }
      }
    });
  }

  const JsonValue& root_;
  std::string path_;
  const FeatureFilter& filter_;
  CityJsonGeometry geometry_;
  std::map<std::string_view, const JsonValue*> objects_;
  Vec2 origin_;
  ShapeFile out_;
  size_t messages_ = 0, passed_ = 0;
};

}  // namespace

Result<ShapeFile> readCityJsonShapes(const JsonValue& root, const std::string& path,
                                     const FeatureFilter& filter) {
  return Reader(root, path, filter).read();
}

}  // namespace gable
