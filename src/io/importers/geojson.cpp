// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// GeoJSON (RFC 7946, and the coordinate systems of its predecessor of 2008). Degrees become metres
// about the middle of all coordinates; a file whose `crs` names a projected system, or whose
// numbers cannot be degrees, is taken as metres already.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/allowance.h"
#include "base/json.h"
#include "base/most_diagnostics.h"
#include "base/number.h"
#include "base/text.h"
#include "base/work.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/region.h"
#include "io/geo/geo_frames.h"
#include "io/geo/transverse_mercator.h"
#include "io/importers/city_json.h"
#include "io/importers/city_json_sequence.h"
#include "io/importers/city_json_shapes.h"
#include "io/importers/feature_pieces.h"
#include "io/importers/geojson_edges.h"
#include "io/importers/geojson_root.h"
#include "io/importers/shape_input.h"
#include "io/importers/shape_parts.h"
#include "shape/edge_attributes.h"
#include "shape/feature_text.h"

namespace gable {
namespace {

// Vertices nearer than this to each other or to the line through their neighbours say nothing about
// a building; survey coordinates are written to a centimetre at best.
constexpr double kTolerance = 1e-3;
// Beyond, a plane is no picture of the Earth.
constexpr double kWidestDegrees = 10;
// No lot or building is so wide: 20 kilometres. Such numbers are metres.
constexpr double kWidestPolygon = 0.2;
// More than once around the Earth.
constexpr double kFarthest = 1e8;
constexpr int kDeepestCollection = 16;
// What has no extent is left out by intent, more often than not.
constexpr std::string_view kEmpty = "geojson-empty";
// Of what is left out, so many are named.
constexpr size_t kMostNamed = 20;

struct Feature {
  const JsonValue* geometry = nullptr;
  const JsonValue* properties = nullptr;
  std::string id;
  size_t number = 0;
};

std::string textOf(const JsonValue& v) {
  return v.isNumber() ? shortestText(v.number(0)) : v.text();
}

class GeoJsonReader {
 public:
  GeoJsonReader(std::string path, const FeatureFilter& filter)
      : path_(std::move(path)), filter_(filter) {}

  Result<ShapeFile> read(std::string_view text);
  Result<ShapeFile> readPieces(FeaturePieces& file, const ShapeSink& sink);

 private:
  Result<JsonValue> pieceOf(const std::string& features) const;
  std::optional<Error> measurePieces(FeaturePieces& file);
  void handOn(const ShapeSink& sink);
  void conclude();
  void collect(const JsonValue& v);
  bool passes(const Feature& f) const;
  void noteProperties(const Feature& f);
  Error empty() const;
  Error chosenButEmpty() const;
  void measureAll();
  void chooseProjection(const JsonValue& root);
  std::string swappedHint() const;
  bool tellsMetres();
  void measure(const JsonValue& geometry, bool lines, int depth);
  void addFeature(const Feature& f);
  void addGeometry(const JsonValue& geometry, int depth);
  void addPolygon(const JsonValue& rings);
  void addLine(const JsonValue& coordinates);
  void buildLines(MeshBuilder& b, std::vector<double>& widths) const;
  void addAllLines();
  Result<ShapeFile> readRoot(const JsonValue& root);
  Result<ShapeFile> withoutShapes();
  bool readPoints(const JsonValue& coordinates, std::vector<Vec2>& out);
  bool readRing(const JsonValue& coordinates, Ring& out);
  void addFace(const Polygon& p);
  Vec2 local(Vec2 p) const {
    if (!projection_) return p - shift_;
    return projection_->forward({p.x < west_ ? p.x + 360 : p.x, p.y});
  }
  void complain(const char* code, const std::string& what, const std::string& hint = {});
  void leaveOut(std::string_view code, const std::string& why, const std::string& hint = {});
  std::string place() const;
  void addAttributes(const JsonValue& properties, ShapeInput& shape);
  void addEdgeValues(const std::string& name, const JsonValue& list, ShapeInput& shape);

  std::string path_;
  const FeatureFilter& filter_;
  ShapeFile out_;
  std::vector<Feature> features_;
  Box2 extent_;
  // Longitudes from the prime meridian eastwards, for input on both sides of the 180th.
  Box2 eastward_;
  double west_ = -1e300;
  Vec2 shift_;
  std::optional<TransverseMercator> projection_;
  // Of the polygons, as they are written.
  std::vector<double> widths_;
  // Of the feature at hand.
  const Feature* feature_ = nullptr;
  std::string name_;
  MeshBuilder builder_;
  WrittenEdges edges_;
  std::vector<std::vector<Vec2>> lines_;
  // Those of features without polygons.
  MeshBuilder allLines_;
  std::vector<double> allLineWidths_;
  size_t lineFeatures_ = 0;
  // Of features that the filter leaves out: their properties, and the values of the one that it
  // asks for, with how often they come.
  std::map<std::string, size_t> properties_, values_;
  // Of those seen: which the filter lets pass, and which of these are points.
  size_t chosen_ = 0, chosenPoints_ = 0;
  bool inParts_ = false, broken_ = false;
  size_t seen_ = 0, faces_ = 0, messages_ = 0, leftOut_ = 0, otherGeometries_ = 0;
  bool hasHeights_ = false;
  // Those that have been handed on, when the file is read in pieces.
  size_t handedOn_ = 0;
};

std::string GeoJsonReader::place() const {
  return featureText(feature_->number + 1, feature_->id, name_);
}

void GeoJsonReader::complain(const char* code, const std::string& what, const std::string& hint) {
  // A file that is wrong throughout is told so once, not a million times.
  if (++messages_ > kMostDiagnostics) return;
  out_.diagnostics.warning(code, {}, place() + " of '" + path_ + "': " + what, hint);
}

// Of a feature of several parts the others stay.
void GeoJsonReader::leaveOut(std::string_view code, const std::string& why,
                             const std::string& hint) {
  const std::string of = inParts_ ? "a part of " : "";
  broken_ = broken_ || code != kEmpty;
  if (++leftOut_ > kMostNamed) return;
  out_.diagnostics.warning(std::string(code), {},
                           of + place() + " of '" + path_ + "' is left out: " + why, hint);
}

bool GeoJsonReader::passes(const Feature& f) const {
  if (filter_.key.empty()) return true;
  if (!f.properties) return false;
  const JsonValue& v = (*f.properties)[filter_.key];
  if (!filter_.value.empty()) return textOf(v) == filter_.value;
  return !v.isNull() && v.text() != "no";
}

void GeoJsonReader::collect(const JsonValue& v) {
  const std::string& type = v["type"].text();
  if (type == "FeatureCollection") {
    for (const JsonValue& f : v["features"].items()) {
      if (f.isObject()) collect(f);
    }
    return;
  }
  Feature f;
  f.number = seen_;
  if (type == "Feature") {
    f.geometry = v.find("geometry");
    f.properties = v.find("properties");
    f.id = textOf(v["id"]);
    for (const char* key : {"osm_id", "id", "@id", "fid", "OBJECTID"}) {
      if (f.id.empty() && f.properties) f.id = textOf((*f.properties)[key]);
    }
  } else {
    f.geometry = &v;
  }
  ++seen_;
  if (passes(f)) {
    ++chosen_;
    const std::string& kind = f.geometry ? (*f.geometry)["type"].text() : std::string();
    if (kind == "Point" || kind == "MultiPoint") ++chosenPoints_;
    features_.push_back(std::move(f));
  } else {
    noteProperties(f);
  }
}

void GeoJsonReader::noteProperties(const Feature& f) {
  // More kinds are not shown, and hardly asked for.
  constexpr size_t kMostKinds = 1000;
  const auto note = [](std::map<std::string, size_t>& counts, const std::string& name) {
    const auto at = counts.find(name);
    if (at != counts.end()) {
      ++at->second;
    } else if (counts.size() < kMostKinds) {
      counts.emplace(name, 1);
    }
  };
  if (!f.properties) return;
  for (const auto& [name, value] : f.properties->members()) {
    work();
    if (value.isNull()) continue;
    note(properties_, name);
    if (name == filter_.key) note(values_, textOf(value));
  }
}

// The extent of all polygons, or of lines too.
void GeoJsonReader::measure(const JsonValue& geometry, bool lines, int depth) {
  const std::string& type = geometry["type"].text();
  const auto line = [&](const JsonValue& points) {
    for (const JsonValue& p : points.items()) {
      Vec2 at;
      if (!positionOf(p, at)) continue;
      extent_.include(at);
      eastward_.include({at.x < 0 ? at.x + 360 : at.x, at.y});
    }
  };
  const auto polygon = [&](const JsonValue& rings) {
    for (const JsonValue& ring : rings.items()) line(ring);
    if (type == "MultiLineString") return;
    Box2 own;
    for (const JsonValue& p : rings.at(0).items()) {
      Vec2 at;
      if (positionOf(p, at)) own.include(at);
    }
    if (!own.empty()) widths_.push_back(std::max(own.size().x, own.size().y));
  };
  const JsonValue& coordinates = geometry["coordinates"];
  if (type == "Polygon" || (lines && type == "MultiLineString")) polygon(coordinates);
  if (lines && type == "LineString") line(coordinates);
  if (type == "MultiPolygon") {
    for (const JsonValue& p : coordinates.items()) polygon(p);
  }
  if (type == "GeometryCollection" && depth < kDeepestCollection) {
    for (const JsonValue& g : geometry["geometries"].items()) measure(g, lines, depth + 1);
  }
}

void GeoJsonReader::measureAll() {
  // Lines count where there is nothing else.
  for (const bool lines : {false, true}) {
    if (!extent_.empty()) break;
    for (const Feature& f : features_) {
      if (f.geometry) measure(*f.geometry, lines, 0);
    }
  }
}

void GeoJsonReader::chooseProjection(const JsonValue& root) {
  if (extent_.empty()) return;
  const bool canBeDegrees =
      extent_.min.x >= -180 && extent_.max.x <= 180 && extent_.min.y >= -90 && extent_.max.y <= 90;
  if (!namesDegrees(root) || !canBeDegrees) {
    // Metres. Large map coordinates are brought near the origin, by whole metres.
    const Vec2 c = extent_.center();
    if (std::fabs(c.x) > 1e5 || std::fabs(c.y) > 1e5) shift_ = {std::floor(c.x), std::floor(c.y)};
    out_.geo = mapGeoFrame(root["crs"]["properties"]["name"].text(), shift_);
    return;
  }
  if (tellsMetres()) return;
  Box2 box = extent_;
  if (box.size().x > 180 && eastward_.size().x < box.size().x) {
    box = eastward_;
    west_ = 0;
  }
  const Vec2 c = box.center();
  projection_.emplace(LonLat{c.x, c.y});
  out_.geoOrigin = {true, projection_->center().longitude, projection_->center().latitude};
  out_.geo = localGeoFrame(projection_->center());
  if (box.size().x > kWidestDegrees || box.size().y > kWidestDegrees) {
    out_.diagnostics.warning("geojson-wide", {},
                             "'" + path_ + "' spans more than " + shortestText(kWidestDegrees) +
                                 " degrees: lengths are distorted",
                             "read a part of it at a time");
  }
}

// Half of the polygons are wider than any lot is in degrees.
bool GeoJsonReader::tellsMetres() {
  if (widths_.empty()) return false;
  const auto middle = widths_.begin() + static_cast<std::ptrdiff_t>(widths_.size() / 2);
  std::nth_element(widths_.begin(), middle, widths_.end());
  if (*middle <= kWidestPolygon) return false;
  out_.diagnostics.error(
      "geojson-metres", {},
      "'" + path_ + "' has polygons " + shortestText(std::round(*middle * 100) / 100) +
          " degrees wide, " + shortestText(std::round(*middle * 111)) +
          " kilometres: its numbers must be metres",
      "say so in the file: \"crs\": {\"type\": \"name\", \"properties\": {\"name\": "
      "\"EPSG:3857\"}}, or give longitude and latitude");
  return true;
}

bool GeoJsonReader::readPoints(const JsonValue& coordinates, std::vector<Vec2>& out) {
  out.clear();
  for (const JsonValue& v : coordinates.items()) {
    work();
    Vec2 p;
    if (!positionOf(v, p)) {
      leaveOut("geojson-coordinates", "a position is not two numbers");
      return false;
    }
    const Vec2 at = local(p);
    if (!(std::fabs(at.x) < kFarthest && std::fabs(at.y) < kFarthest)) {
      leaveOut("geojson-coordinates", "a position is too far away");
      return false;
    }
    const double height = v.at(2).number(0);
    hasHeights_ = hasHeights_ || height != 0;
    out.push_back(at);
  }
  return true;
}

bool GeoJsonReader::readRing(const JsonValue& coordinates, Ring& out) {
  if (!readPoints(coordinates, out)) return false;
  if (edges_.wanted()) {
    out = edges_.ring(out, kTolerance);
    return true;
  }
  dropDuplicates(out, kTolerance);
  dropCollinear(out, kTolerance);
  return true;
}

void GeoJsonReader::addFace(const Polygon& p) {
  builder_.beginFace();
  const auto loop = [&](const Ring& ring) {
    builder_.beginLoop();
    for (size_t i = 0; i < ring.size(); ++i) {
      builder_.addCorner(builder_.addPosition(fromPlan(ring[i])));
      if (edges_.wanted()) edges_.add(ring[i], ring[(i + 1) % ring.size()]);
    }
  };
  loop(p.outer);
  for (const Ring& hole : p.holes) loop(hole);
  ++faces_;
}

// Two by two, and the results again: where hundreds lie over each other, all at once would meet at
// as many points as there are pairs.
Region united(const std::vector<Ring>& rings) {
  std::vector<Region> parts;
  for (const Ring& r : rings) {
    Polygon p{r, {}};
    orient(p);
    parts.push_back({std::move(p)});
  }
  while (parts.size() > 1) {
    const size_t half = (parts.size() + 1) / 2;
    for (size_t i = 0; i + half < parts.size(); ++i) parts[i] = unite(parts[i], parts[i + half]);
    parts.resize(half);
  }
  return parts.empty() ? Region{} : std::move(parts[0]);
}

void GeoJsonReader::addPolygon(const JsonValue& rings) {
  Polygon p;
  if (!readRing(rings.at(0), p.outer)) return;
  if (p.outer.size() < 3) {
    leaveOut(kEmpty, "a polygon has fewer than three corners");
    return;
  }
  for (size_t i = 1; i < rings.size(); ++i) {
    Ring hole;
    if (!readRing(rings.at(i), hole)) return;
    if (hole.size() >= 3) p.holes.push_back(std::move(hole));
  }
  orient(p);
  if (!isSimple(p.outer)) {
    leaveOut("geojson-crossing", "the outline of a polygon crosses itself",
             "mend the polygon in a map editor");
    return;
  }
  if (isValid(p)) {
    addFace(p);
    return;
  }
  // Holes side by side, or across the outline: what they leave of the area.
  Region left;
  const Status cut = guarded([&] {
    left = subtract({{p.outer, {}}}, united(p.holes));
    return Status();
  });
  unwindIfStopped(cut);
  if (!cut.ok()) {
    leaveOut("geojson-crossing", "the holes of a polygon cannot be cut out: " + cut.message(),
             "mend the polygon in a map editor");
    return;
  }
  complain("geojson-holes",
           "holes of a polygon touch or cross each other or its outline and are merged",
           "mend the polygon in a map editor");
  for (const Polygon& part : left) addFace(part);
}

void GeoJsonReader::addLine(const JsonValue& coordinates) {
  std::vector<Vec2> line;
  if (!readPoints(coordinates, line)) return;
  const auto near = [](Vec2 a, Vec2 b) { return length(a - b) < kTolerance; };
  line.erase(std::unique(line.begin(), line.end(), near), line.end());
  if (line.size() > 1) {
    lines_.push_back(std::move(line));
  } else {
    leaveOut(kEmpty, "a line has fewer than two points");
  }
}

// A face of two corners for each stretch.
void GeoJsonReader::buildLines(MeshBuilder& b, std::vector<double>& widths) const {
  double width = 0;
  if (feature_->properties) {
    const JsonValue& v = (*feature_->properties)["width"];
    if (v.isNumber()) width = v.number(0);
    if (v.isText() && !parseNumber(v.text(), width)) width = 0;
  }
  const bool told = width > 0 && std::isfinite(width);
  if (told) widths.resize(b.mesh().faceCount());
  for (const std::vector<Vec2>& line : lines_) {
    uint32_t from = b.addPosition(fromPlan(line[0]));
    const uint32_t first = from;
    for (size_t i = 1; i < line.size(); ++i) {
      const bool back = i > 1 && i + 1 == line.size() && line[i] == line[0];
      const uint32_t to = back ? first : b.addPosition(fromPlan(line[i]));
      const uint32_t ends[2] = {from, to};
      b.addPolygon(ends);
      from = to;
    }
  }
  if (told) widths.resize(b.mesh().faceCount(), width);
}

void GeoJsonReader::addAllLines() {
  ShapeInput shape;
  shape.mesh = allLines_.take();
  if (!out_.shapes.empty() || handedOn_ > 0) {
    otherGeometries_ += lineFeatures_;
    return;
  }
  if (shape.mesh.empty()) return;
  shape.name = "lines";
  shape.streetWidths = std::move(allLineWidths_);
  if (!shape.streetWidths.empty()) shape.streetWidths.resize(shape.mesh.faceCount());
  out_.shapes.push_back(std::move(shape));
}

void GeoJsonReader::addGeometry(const JsonValue& geometry, int depth) {
  const std::string& type = geometry["type"].text();
  if (type == "Polygon") {
    addPolygon(geometry["coordinates"]);
  } else if (type == "MultiPolygon") {
    for (const JsonValue& p : geometry["coordinates"].items()) addPolygon(p);
  } else if (type == "LineString") {
    addLine(geometry["coordinates"]);
  } else if (type == "MultiLineString") {
    for (const JsonValue& l : geometry["coordinates"].items()) addLine(l);
  } else if (type == "GeometryCollection" && depth < kDeepestCollection) {
    for (const JsonValue& g : geometry["geometries"].items()) addGeometry(g, depth + 1);
  } else {
    ++otherGeometries_;
  }
}

void GeoJsonReader::addEdgeValues(const std::string& name, const JsonValue& list,
                                  ShapeInput& shape) {
  // Lines of the feature follow its faces.
  AttributeValue values = edges_.values(name, list, shape.mesh.faceCount() - faces_);
  if (values.values.empty()) {
    complain("edge-values",
             "the attribute '" + name + "' is no list of values of one kind, and is left out",
             "give each edge a number, a text, or true or false");
    return;
  }
  if (list.size() != edges_.written()) {
    complain("edge-count",
             "the attribute '" + name + "' has " + std::to_string(list.size()) +
                 (list.size() == 1 ? " value" : " values") + " for " +
                 std::to_string(edges_.written()) + " edges",
             "give a value for each edge, in the order of the outline and its holes");
  }
  shape.attributes.push_back(std::move(values));
}

void GeoJsonReader::addAttributes(const JsonValue& properties, ShapeInput& shape) {
  for (const JsonValue::Member& member : properties.members()) {
    const JsonValue& v = member.second;
    if (EdgeAttributes::isNamed(member.first, v.isArray())) {
      addEdgeValues(member.first, v, shape);
      continue;
    }
    addAttribute(member, shape);
  }
}

void GeoJsonReader::addFeature(const Feature& f) {
  feature_ = &f;
  name_ = f.properties ? (*f.properties)["name"].text() : std::string{};
  edges_.begin(f.properties);
  builder_ = MeshBuilder();
  faces_ = 0;
  lines_.clear();
  inParts_ = f.geometry && (*f.geometry)["type"].text() != "Polygon" &&
             (*f.geometry)["type"].text() != "LineString";
  const size_t before = messages_ + leftOut_ + otherGeometries_;
  if (f.geometry && f.geometry->isObject()) addGeometry(*f.geometry, 0);
  if (faces_ == 0 && !lines_.empty()) {
    // Lines are a shape where there is no other.
    if (out_.shapes.empty() && handedOn_ == 0) buildLines(allLines_, allLineWidths_);
    ++lineFeatures_;
    return;
  }
  if (faces_ == 0) {
    if (messages_ + leftOut_ + otherGeometries_ == before) {
      inParts_ = false;
      leaveOut(kEmpty, "it has no polygon and no line");
    }
    return;
  }
  ShapeInput shape;
  buildLines(builder_, shape.streetWidths);
  shape.mesh = builder_.take();
  shape.id = f.id;
  shape.feature = f.number + 1;
  shape.name = !name_.empty() ? name_ : !f.id.empty() ? f.id : featureText(f.number + 1, {}, {});
  if (f.properties) addAttributes(*f.properties, shape);
  out_.shapes.push_back(std::move(shape));
}

// The names that come most often, the first of the alphabet among equals.
std::string commonest(const std::map<std::string, size_t>& counts) {
  constexpr size_t kShown = 12;
  std::vector<std::pair<std::string, size_t>> all(counts.begin(), counts.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string out;
  for (size_t i = 0; i < all.size() && i < kShown; ++i) {
    out += (i > 0 ? ", " : "") + all[i].first + " (" + std::to_string(all[i].second) + ")";
  }
  return out + (all.size() > kShown ? ", ..." : "");
}

// The letters as one byte each, so that an accent that is left out counts as one slip.
std::string oneByteEach(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) out += c;
    if (byte >= 0xc0) out += '?';
  }
  return out;
}

// The nearest name, or where none is near, the nearest but for accents.
std::string nearestButForAccents(std::string_view name,
                                 const std::vector<std::string_view>& names) {
  if (std::string nearest = nearestName(name, names); !nearest.empty()) return nearest;
  std::vector<std::string> plain;
  for (const std::string_view n : names) plain.push_back(oneByteEach(n));
  const std::vector<std::string_view> views(plain.begin(), plain.end());
  const std::string nearest = nearestName(oneByteEach(name), views);
  const auto at = std::find(views.begin(), views.end(), nearest);
  return nearest.empty() ? nearest : std::string(names[static_cast<size_t>(at - views.begin())]);
}

// There are features that the filter lets pass, and none has an extent.
Error GeoJsonReader::chosenButEmpty() const {
  const std::string wanted = filter_.key + (filter_.value.empty() ? "" : '=' + filter_.value);
  const bool one = chosen_ == 1;
  std::string what = one ? "it is no polygon and no line" : "none is a polygon or a line";
  if (chosenPoints_ == chosen_) what = one ? "it is a point" : "all are points";
  return {"shapes-empty",
          std::to_string(chosen_) + " of the " + std::to_string(seen_) + " features of '" + path_ +
              (one ? "' has '" : "' have '") + wanted + "', and " + what,
          "initial shapes are made of polygons and lines; choose features that are with --only, "
          "such as --only building or --only highway"};
}

// Degrees of which the second goes beyond the pole are read as metres, in which lots are points.
std::string GeoJsonReader::swappedHint() const {
  if (extent_.empty()) return {};
  if (extent_.min.x < -90 || extent_.max.x > 90 || extent_.min.y < -180 || extent_.max.y > 180) {
    constexpr double kTiny = 0.1;
    const Vec2 size = extent_.max - extent_.min;
    if (size.x > kTiny || size.y > kTiny) return {};
    return "its numbers around " + shortestText(extent_.min.x) + ", " +
           shortestText(extent_.min.y) +
           " are no longitude and latitude and are read as metres, in which nothing there is "
           "larger than ten centimetres";
  }
  const double most = std::max(extent_.max.y, -extent_.min.y);
  if (most <= 90) return {};
  return "its second numbers go to " + shortestText(most) +
         ", and latitudes end at 90: GeoJSON writes longitude first; swap them if they are degrees";
}

Error GeoJsonReader::empty() const {
  if (filter_.key.empty() || seen_ == 0) {
    return {"shapes-empty",
            "'" + path_ + "' has no polygon and no line that could be an initial shape",
            swappedHint()};
  }
  if (chosen_ > 0) return chosenButEmpty();
  // The value is wrong where others are there, else the property.
  const bool byValue = !filter_.value.empty() && !values_.empty();
  const std::map<std::string, size_t>& counts = byValue ? values_ : properties_;
  std::vector<std::string_view> names;
  for (const auto& [name, count] : counts) names.push_back(name);
  const std::string begin = byValue ? filter_.key + '=' : std::string();
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::string nearest = nearestButForAccents(byValue ? filter_.value : filter_.key, names);
  std::string hint = "choose others with --only, such as --only landuse or --only natural=water";
  if (!nearest.empty()) {
    hint = "did you mean --only " + begin + nearest + "?";
  } else if (!names.empty()) {
    hint = byValue ? "the values of '" + filter_.key + "' are " : "its properties are ";
    hint += commonest(counts) + "; write --only " + begin + most->first;
  }
  return {"shapes-empty",
          "none of the " + std::to_string(seen_) + " features of '" + path_ + "' has " +
              (byValue ? "the value '" + filter_.value + "' for '" + filter_.key + "'"
                       : "the property '" + filter_.key + "'"),
          hint};
}

// Where broken features were all there is, why they are left out is told as well.
Result<ShapeFile> GeoJsonReader::withoutShapes() {
  if (out_.diagnostics.hasErrors()) return std::move(out_);
  const Error e = empty();
  if (!broken_) return e;
  out_.diagnostics.error(e.code, {}, e.message, e.hint);
  return std::move(out_);
}

Result<ShapeFile> GeoJsonReader::read(std::string_view text) {
  const Result<JsonValue> root = parseGeometries(text, path_);
  if (!root.ok()) return root.error();
  return readRoot(root.value());
}

Result<ShapeFile> GeoJsonReader::readRoot(const JsonValue& root) {
  if (isCityJson(root)) return readCityJsonShapes(root, path_, filter_);
  collect(root);
  measureAll();
  chooseProjection(root);
  if (out_.diagnostics.hasErrors()) return std::move(out_);
  for (const Feature& f : features_) addFeature(f);
  addAllLines();
  conclude();
  if (out_.shapes.empty()) return withoutShapes();
  return std::move(out_);
}

// What there is to say when all features have been seen.
void GeoJsonReader::conclude() {
  if (messages_ > kMostDiagnostics) {
    out_.diagnostics.warning("geojson-more", {},
                             "'" + path_ + "' has " + std::to_string(messages_ - kMostDiagnostics) +
                                 " more messages of this kind");
  }
  if (leftOut_ > kMostNamed) {
    out_.diagnostics.warning("map-rows", {},
                             std::to_string(leftOut_) + " features or parts of them of '" + path_ +
                                 "' are left out, of which the first " +
                                 std::to_string(kMostNamed) + " are named",
                             "mend them in a map editor where they matter");
  }
  if (otherGeometries_ > 0) {
    Diagnostics::Entry d;
    d.severity = Severity::Note;
    d.code = "geojson-no-polygon";
    d.message = std::to_string(otherGeometries_) +
                (otherGeometries_ == 1 ? " geometry of '" : " geometries of '") + path_ +
                (otherGeometries_ == 1 ? "' is no polygon and is passed over"
                                       : "' are no polygons and are passed over");
    out_.diagnostics.add(std::move(d));
  }
  if (hasHeights_) {
    Diagnostics::Entry d;
    d.severity = Severity::Note;
    d.code = "geojson-heights";
    d.message = "the heights that coordinates of '" + path_ +
                "' have are left out: initial shapes lie level at 0";
    d.hint = "give them as a property, such as elevation, and move the model by it in the rules";
    out_.diagnostics.add(std::move(d));
  }
}

Result<JsonValue> GeoJsonReader::pieceOf(const std::string& features) const {
  Result<JsonValue> piece =
      parseJson("{\"type\":\"FeatureCollection\",\"features\":[" + features + "]}");
  if (piece.ok()) return piece;
  return Error{"shapes-broken",
               "'" + path_ + "', one of the features from the " + std::to_string(seen_ + 1) +
                   "th on: " + piece.error().message,
               piece.error().hint};
}

// The extent of all features, in one go through the file, or two where there are lines alone.
std::optional<Error> GeoJsonReader::measurePieces(FeaturePieces& file) {
  for (const bool lines : {false, true}) {
    if (!extent_.empty()) break;
    file.rewind();
    seen_ = chosen_ = chosenPoints_ = 0;
    for (;;) {
      const Result<std::string> features = file.next();
      if (!features.ok()) return features.error();
      if (features.value().empty()) break;
      const Result<JsonValue> piece = pieceOf(features.value());
      if (!piece.ok()) return piece.error();
      collect(piece.value());
      for (const Feature& f : features_) {
        if (f.geometry) measure(*f.geometry, lines, 0);
      }
      features_.clear();
    }
  }
  properties_.clear();
  values_.clear();
  seen_ = chosen_ = chosenPoints_ = 0;
  return std::nullopt;
}

void GeoJsonReader::handOn(const ShapeSink& sink) {
  for (ShapeInput& shape : out_.shapes) sink(std::move(shape));
  handedOn_ += out_.shapes.size();
  out_.shapes.clear();
}

Result<ShapeFile> GeoJsonReader::readPieces(FeaturePieces& file, const ShapeSink& sink) {
  if (auto e = measurePieces(file)) return *e;
  const Result<JsonValue> root = parseGeometries(file.rest(), path_);
  if (!root.ok()) return root.error();
  if (root.value()["type"].text() != "FeatureCollection") {
    // One feature or geometry is no list that could be read in pieces.
    Result<ShapeFile> all = readRoot(root.value());
    if (!all.ok()) return all.error();
    for (ShapeInput& shape : all->shapes) sink(std::move(shape));
    all->shapes.clear();
    return all;
  }
  chooseProjection(root.value());
  if (out_.diagnostics.hasErrors()) return std::move(out_);
  file.rewind();
  for (;;) {
    const Result<std::string> features = file.next();
    if (!features.ok()) return features.error();
    if (features.value().empty()) break;
    const Result<JsonValue> piece = pieceOf(features.value());
    if (!piece.ok()) return piece.error();
    collect(piece.value());
    for (const Feature& f : features_) addFeature(f);
    features_.clear();
    handOn(sink);
  }
  addAllLines();
  handOn(sink);
  conclude();
  if (handedOn_ == 0) return withoutShapes();
  return std::move(out_);
}

}  // namespace

Result<ShapeFile> readGeoJsonShapes(std::string_view text, const std::string& path,
                                    const FeatureFilter& filter) {
  return GeoJsonReader(path, filter).read(text);
}

Result<ShapeFile> streamGeoJsonShapes(const std::string& file, const std::string& path,
                                      const FeatureFilter& filter, const ShapeSink& sink) {
  FeaturePieces pieces;
  const Result<uint64_t> opened = pieces.open(file);
  if (!opened.ok()) return opened.error();
  return GeoJsonReader(path, filter).readPieces(pieces, sink);
}

}  // namespace gable
