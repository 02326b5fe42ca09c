// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces are taken out of whatever solids and surfaces an object has. Its footprint is the outline
// of those that are said to be its ground, else of those that look down, else of all, seen from
// above; models are full of triangles, so that this goes by the edges that no two faces share. The
// shape of a roof is told by the directions that its faces look in.
#include "io/importers/city_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/number.h"
#include "base/text.h"
#include "base/work.h"
#include "io/importers/city_json_geometry.h"
#include "math/trig.h"

namespace gable {
namespace {

// Of a face's normal, upwards: less is a wall; more is level.
constexpr double kWall = 0.1, kLevel = 0.985;
constexpr double kLeastHeight = 0.5;
// Of the area of a roof: its level part makes it flat; a direction that counts has as much.
constexpr double kMostlyLevel = 0.6, kSide = 0.12;
constexpr int kDirections = 8;

using Face = CityJsonFace;
using Geometry = CityJsonBody;

std::string rounded(double metres) { return shortestText(std::round(metres * 100) / 100); }

void put(MapFeature& f, const std::string& name, std::string value) {
  if (!value.empty() && f.tag(name).empty()) f.tags.emplace_back(name, std::move(value));
}

// What words say that name the use of a road, in the languages of the models that are about.
bool says(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view w) { return text.find(w) != std::string_view::npos; });
}
bool isForFeet(std::string_view use) {
  return says(use, {"voet", "foot", "pedestrian", "sidewalk", "gehweg", "trottoir", "steps"});
}

// The outline of faces that lie side by side: edges that two of them share go. O(n log n).
std::vector<Ring> outlineOf(const std::vector<Ring>& rings) {
  using Place = std::pair<double, double>;
  std::map<Place, std::vector<Place>> next;
  size_t left = 0;
  for (const Ring& r : rings) {
    for (size_t i = 0; i < r.size(); ++i) {
      work(8);
      const Vec2 a = r[i], b = r[(i + 1) % r.size()];
      const Place from{a.x, a.y}, to{b.x, b.y};
      if (from == to) continue;
      const auto back = next.find(to);
      if (back != next.end()) {
        work(back->second.size());
        const auto at = std::find(back->second.begin(), back->second.end(), from);
        if (at != back->second.end()) {
          back->second.erase(at);
          --left;
          continue;
        }
      }
      next[from].push_back(to);
      ++left;
    }
  }
  // As many edges leave each place as come to it, so every walk ends where it began.
  std::vector<Ring> out;
  for (auto at = next.begin(); left > 0 && at != next.end();) {
    if (at->second.empty()) {
      ++at;
      continue;
    }
    Ring ring;
    Place place = at->first;
    do {
      work();
      ring.push_back({place.first, place.second});
      std::vector<Place>& ways = next[place];
      const Place to = ways.back();
      ways.pop_back();
      --left;
      place = to;
    } while (place != at->first);
    if (ring.size() >= 3) out.push_back(std::move(ring));
  }
  return out;
}

class Reader {
 public:
  Reader(const JsonValue& root, MapSkips& skips) : root_(root), skips_(skips), geometry_(root) {}

  CityJsonMap read() {
    for (const auto& [id, object] : root_["CityObjects"].members()) objects_.emplace(id, &object);
    for (const auto& [id, object] : root_["CityObjects"].members()) {
      work();
      id_ = id;
      add(object);
    }
    out_.system = cityJsonSystem(root_);
    return std::move(out_);
  }

 private:
  void skip(const std::string& reason) { skips_.add(id_, reason); }

  void add(const JsonValue& object) {
    const std::string& type = object["type"].text();
    // A part goes with its building.
    if (type == "BuildingPart" && !object["parents"].items().empty()) return;
    if (type == "Building" || type == "BuildingPart") return addBuilding(object);
    MapFeature f;
    f.id = id_;
    if (type == "SolitaryVegetationObject") return addTree(object, std::move(f));
    if (!describe(object, type, f)) {
      return skip(type == "TINRelief" ? "a place has its heights from --terrain"
                                      : "a place is not made from a '" + type + "'");
    }
    addAttributes(object, f);
    addArea(geometriesOf(object), std::move(f));
  }

  // Tags by the type of an object; false for one that no place is made from.
  static bool describe(const JsonValue& object, const std::string& type, MapFeature& f) {
    const JsonValue& own = object["attributes"];
    std::string use;
    for (const char* key : {"function", "class", "usage"}) {
      use += lowerCase(own[key].text()) + ' ';
    }
    if (type == "Road") {
      if (says(use, {"parkeer", "parking"})) {
        put(f, "amenity", "parking");
      } else {
        const bool cycles = says(use, {"fiets", "cycle", "radweg"});
        put(f, "area:highway", isForFeet(use) ? "footway" : cycles ? "cycleway" : "road");
      }
    } else if (type == "TransportSquare") {
      put(f, "place", "square");
    } else if (type == "Railway") {
      put(f, "landuse", "railway");
    } else if (type == "WaterBody" || type == "Waterway") {
      put(f, "natural", "water");
    } else if (type == "PlantCover") {
      put(f, "landuse", says(use, {"bos", "forest", "wood"}) ? "forest" : "grass");
    } else if (type == "LandUse") {
      const std::string& named = own["class"].text();
      put(f, "landuse", named.empty() ? "yes" : named);
    } else {
      return false;
    }
    return true;
  }

  static void addAttributes(const JsonValue& object, MapFeature& f) {
    const JsonValue& own = object["attributes"];
    // Of a model without heights.
    const bool isBuilt = !f.tag("building").empty() || !f.tag("building:part").empty();
    if (isBuilt) put(f, "height", cityJsonText(own["measuredHeight"]));
    put(f, "building:levels", cityJsonText(own["storeysAboveGround"]));
    put(f, "start_date", cityJsonText(own["yearOfConstruction"]));
    const JsonValue& address = object["address"].at(0);
    put(f, "addr:country", cityJsonText(address["Country"]));
    put(f, "addr:city", cityJsonText(address["Locality"]));
    put(f, "addr:street", cityJsonText(address["ThoroughfareName"]));
    put(f, "addr:housenumber", cityJsonText(address["ThoroughfareNumber"]));
    for (const auto& [name, value] : own.members()) {
      work();
      put(f, name, cityJsonText(value));
    }
  }

  std::vector<Geometry> geometriesOf(const JsonValue& object) {
    return geometry_.of(object, [this](const std::string& reason) { skip(reason); });
  }

  // ---- Areas ------------------------------------------------------------------------------------

  template <class Takes>
  static std::vector<Ring> ringsFromAbove(const std::vector<Face>& faces, Takes&& takes) {
    std::vector<Ring> rings;
    for (const Face& f : faces) {
      work();
      const Vec3 normal = cityJsonNormal(f.rings[0]);
      const double size = length(normal);
      if (!(size > 0) || !takes(f, normal.z / size)) continue;
      for (size_t i = 0; i < f.rings.size(); ++i) {
        Ring flat;
        for (const Vec3& p : f.rings[i]) flat.push_back({p.x, p.y});
        const bool left = signedArea(flat) > 0;
        if (left != (i == 0)) std::reverse(flat.begin(), flat.end());
        rings.push_back(std::move(flat));
      }
    }
    return rings;
  }

  // What an object covers, as rings of an area; none where nothing of it lies.
  static std::vector<Ring> coveredBy(const std::vector<Geometry>& all) {
    const Geometry *least = nullptr, *most = nullptr;
    for (const Geometry& g : all) {
      if (g.faces.empty()) continue;
      if (!least || g.lod < least->lod) least = &g;
      if (!most || g.lod > most->lod) most = &g;
    }
    if (!most) return {};
    std::vector<Ring> rings = ringsFromAbove(
        most->faces, [](const Face& f, double) { return f.meaning == "GroundSurface"; });
    const auto lies = [](const Face&, double up) { return std::fabs(up) > kWall; };
    if (rings.empty() && least->lod < 1) rings = ringsFromAbove(least->faces, lies);
    if (rings.empty()) {
      rings = ringsFromAbove(most->faces, [](const Face&, double up) { return up < -kWall; });
    }
    if (rings.empty()) rings = ringsFromAbove(most->faces, lies);
    return outlineOf(rings);
  }

  void addArea(const std::vector<Geometry>& geometries, MapFeature f) {
    f.rings = coveredBy(geometries);
    if (!f.rings.empty()) {
      f.kind = MapFeature::Kind::Area;
      out_.features.push_back(std::move(f));
      return;
    }
    bool any = false;
    for (const Geometry& g : geometries) {
      for (const std::vector<Vec3>& line : g.lines) any = addLine(line, f) || any;
    }
    if (!any) skip(geometries.empty() ? "it has no geometry" : "it covers no ground");
  }
  // The middle of a street.
  bool addLine(const std::vector<Vec3>& line, const MapFeature& of) {
    if (line.size() < 2) return false;
    MapFeature f = of;
    f.kind = MapFeature::Kind::Line;
    for (const Vec3& p : line) f.points.push_back({p.x, p.y});
    for (auto& [name, value] : f.tags) {
      if (name != "area:highway") continue;
      name = "highway";
      if (value == "road") value = "residential";
    }
    out_.features.push_back(std::move(f));
    return true;
  }

  void addTree(const JsonValue& object, MapFeature f) {
    Box2 box;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto include = [&](const Vec3& p) {
      box.include({p.x, p.y});
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    };
    for (const Geometry& g : geometriesOf(object)) {
      for (const Face& face : g.faces) {
        for (const auto& r : face.rings) std::for_each(r.begin(), r.end(), include);
      }
      for (const auto& l : g.lines) std::for_each(l.begin(), l.end(), include);
    }
    if (box.empty()) return skip("it has no geometry");
    put(f, "natural", "tree");
    if (high - low > kLeastHeight) put(f, "height", rounded(high - low));
    addAttributes(object, f);
    f.points.push_back(box.center());
    out_.features.push_back(std::move(f));
  }

  // ---- Buildings --------------------------------------------------------------------------------

  void addBuilding(const JsonValue& building) {
    const std::string id = id_;
    std::vector<Geometry> whole = geometriesOf(building);
    std::vector<std::pair<const JsonValue*, std::vector<Geometry>>> parts;
    for (const JsonValue& child : building["children"].items()) {
      const auto at = objects_.find(child.text());
      if (at == objects_.end() || (*at->second)["type"].text() != "BuildingPart") continue;
      id_ = child.text();
      std::vector<Geometry> own = geometriesOf(*at->second);
      whole.insert(whole.end(), own.begin(), own.end());
      if (!own.empty()) parts.emplace_back(at->second, std::move(own));
    }
    id_ = id;
    MapFeature f = outlined(joined(whole), "building", "yes");
    addAttributes(building, f);
    if (parts.size() == 1) addAttributes(*parts[0].first, f);
    if (f.rings.empty()) {
      return skip(whole.empty() ? "it has no geometry" : "it covers no ground");
    }
    out_.features.push_back(std::move(f));
    if (parts.size() < 2) return;
    for (const auto& [object, own] : parts) {
      MapFeature part = outlined(own, "building:part", "yes");
      part.id = id + "/part";
      addAttributes(*object, part);
      if (!part.rings.empty()) out_.features.push_back(std::move(part));
    }
  }

  // Geometries of one level of detail as one, since parts have each its own.
  static std::vector<Geometry> joined(const std::vector<Geometry>& all) {
    std::map<double, Geometry> byLod;
    for (const Geometry& g : all) {
      Geometry& to = byLod[g.lod];
      to.lod = g.lod;
      to.faces.insert(to.faces.end(), g.faces.begin(), g.faces.end());
    }
    std::vector<Geometry> out;
    for (auto& [lod, g] : byLod) out.push_back(std::move(g));
    return out;
  }

  MapFeature outlined(const std::vector<Geometry>& geometries, const char* key,
                      const char* value) const {
    MapFeature f;
    f.id = id_;
    f.kind = MapFeature::Kind::Area;
    f.rings = coveredBy(geometries);
    put(f, key, value);
    const Geometry* most = nullptr;
    for (const Geometry& g : geometries) {
      if (!g.faces.empty() && (!most || g.lod > most->lod)) most = &g;
    }
    if (most) measure(*most, f);
    return f;
  }

  static void measure(const Geometry& g, MapFeature& f) {
    double low = std::numeric_limits<double>::infinity(), high = -low, eaves = low;
    double all = 0, level = 0;
    std::array<double, kDirections> sides{};
    for (const Face& face : g.faces) {
      const Vec3 normal = cityJsonNormal(face.rings[0]);
      const double size = length(normal), up = size > 0 ? normal.z / size : 0;
      double lowest = std::numeric_limits<double>::infinity();
      for (const Vec3& p : face.rings[0]) {
        work();
        lowest = std::min(lowest, p.z);
        high = std::max(high, p.z);
      }
      low = std::min(low, lowest);
      if (up <= kWall) continue;
      all += size;
      if (up > kLevel) {
        level += size;
        continue;
      }
      eaves = std::min(eaves, lowest);
      const double turns = atan2Deg(normal.y, normal.x) / 360 + 1;
      sides[static_cast<size_t>(std::floor(turns * kDirections + 0.5)) % kDirections] += size;
    }
    if (!(high - low >= kLeastHeight)) return;
    put(f, "height", rounded(high - low));
    if (g.lod < 2 || !(all > 0)) return;
    if (level > kMostlyLevel * all) return put(f, "roof:shape", "flat");
    // What a side has may lie on the border of two directions.
    int count = 0;
    for (size_t i = 0; i < sides.size(); ++i) {
      const double before = sides[(i + sides.size() - 1) % sides.size()];
      const double after = sides[(i + 1) % sides.size()];
      const bool most = sides[i] > before && sides[i] >= after;
      if (most && sides[i] + before + after > kSide * (all - level)) ++count;
    }
    put(f, "roof:shape", count <= 1 ? "skillion" : count == 2 ? "gabled" : "hipped");
    if (high - eaves > kLeastHeight) put(f, "roof:height", rounded(high - eaves));
  }

  const JsonValue& root_;
  MapSkips& skips_;
  CityJsonMap out_;
  CityJsonGeometry geometry_;
  std::map<std::string_view, const JsonValue*> objects_;
  std::string id_;
};

}  // namespace

bool isCityJson(const JsonValue& root) { return root["type"].text() == "CityJSON"; }

Result<CityJsonMap> readCityJson(const JsonValue& root, const std::string& path, MapSkips& skips) {
  if (!root["CityObjects"].isObject() || !root["vertices"].isArray()) {
    return Error{"shapes-broken", "'" + path + "' is CityJSON without city objects or vertices",
                 "check it with a validator of CityJSON"};
  }
  return Reader(root, skips).read();
}

}  // namespace gable
