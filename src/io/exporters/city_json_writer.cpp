// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// CityJSON 2.0 (https://www.cityjson.org/specs/2.0.1), an initial shape after the other: its leaves
// are sorted into city objects, each object is written with its levels of detail. In memory are the
// leaves of one shape, and the vertices, which come last in the file; with a feature a line
// (.city.jsonl) those of one shape as well.
//
//   LoD 1, 2   of buildings: city_blocks.h, of the faces that look up
//   LoD 3      the leaves themselves, as a MultiSurface
//
// What stands several times and is an object of its own, such as a tree, is a template.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/allowance.h"
#include "base/files.h"
#include "base/number.h"
#include "base/work.h"
#include "io/exporters/city_blocks.h"
#include "io/exporters/city_content.h"
#include "io/exporters/city_faces.h"
#include "io/exporters/city_kinds.h"
#include "io/exporters/city_place.h"
#include "io/exporters/city_text.h"
#include "io/exporters/root_parts.h"
#include "io/exporters/write_model.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// Text is handed on in pieces of so many bytes.
constexpr size_t kPiece = 1 << 20;
// More, or less than its negative, is level.
constexpr double kLevel = 0.9;
// Square metres of a face that may be a roof.
constexpr double kLeastFace = 0.02;

// x east, y north, z up.
Vec3 upright(const Vec3& p) { return {p.x, -p.z, p.y}; }
Vec3 laid(const Vec3& p) { return {p.x, p.z, -p.y}; }

bool isBuildingKey(const CityObjectKey& key) { return key.kind == CityKind::Unknown; }

class CityJsonWriter {
 public:
  CityJsonWriter(const Scene& scene, const std::string& path, const WriteOptions& options)
      : scene_(scene),
        options_(options),
        path_(path),
        lines_(modelFormatOf(path) == "city.jsonl"),
        out_(path),
        kinds_(scene),
        parts_(kinds_),
        faces_(scene),
        place_(options.geo, scene.geoOrigin),
        materials_(scene.materials) {
    const Vec3 at = place_.at({0, 0, 0});
    origin_ = {std::floor(at.x), std::floor(at.y), 0};
  }

  Result<WriteReport> write();

 private:
  using Detail = WriteOptions::Detail;
  using Attributes = std::vector<AttributeValue>;
  struct Body {
    Box3 box;
    std::vector<BuildingShell> shells;
  };
  using Bodies = std::map<const CityObjectContent*, Body>;
  struct Template {
    uint32_t number = 0;
    uint64_t triangles = 0;
  };
  struct Surfaces : CitySurfaces {
    std::map<std::pair<const char*, uint32_t>, uint32_t> known;
    /// Openings that have the name of their trim so far.
    std::set<uint32_t> namedByTrim;
  };

  bool wants(Detail d) const { return options_.detail == Detail::All || options_.detail == d; }
  void flush(bool whole = false);
  CityVertices::Vertex vertexAt(const Vec3& world);
  std::string uniqueId(const std::string& wanted);

  void writeHead();
  void writeTail();
  void writeMetadata();
  void writeRoot(uint32_t root);
  void openLine(const std::string& id);
  void closeLine();
  void openObject(const std::string& id, const std::string& type, const Attributes& attributes,
                  const std::string& parent, const std::vector<std::string>& children);
  void closeObject();
  void openGeometry(const char* type, const char* lod);
  void writeBuilding(const std::string& id, const CityContent& content, const Bodies& bodies,
                     const Attributes& known);
  void writeBody(const CityObjectContent* object, const CityContent& content, const Bodies& bodies);
  void writeThing(const std::string& id, const CityObjectContent& object,
                  const CityContent& content, const Attributes& known, const std::string& parent);
  void writeInstance(const std::string& id, const CityInstance& whole);
  Bodies bodiesOf(const CityContent& content);
  void writeBlocks(const Body& body);
  void writeShells(const std::vector<BuildingShell>& shells, const char* lod);
  void writeShell(const BuildingShell& shell);
  void writeFull(const CityObjectContent& object, const CityContent& content, const char* lod,
                 bool upOnly);
  void writeLeaf(const Leaf& leaf, const Frame& world, const PlacedPart& part, double base,
                 bool upOnly, Surfaces& said);
  const char* surfaceOf(CityKind kind, const CityFace& face, double base) const;
  uint32_t semanticOf(const PlacedPart& part, const char* type, Surfaces& said) const;
  const Template& templateOf(const CityInstance& whole);
  void writeWhole(const CityInstance& whole, const Frame& world, std::string& out);
  Box3 boxOf(const CityObjectContent& object, const CityContent& content);
  bool putFace(const CityFace& face, bool first);
  template <class Put>
  void forEachLeafOf(const CityObjectContent& object, const CityContent& content, Put&& put);

  const Scene& scene_;
  const WriteOptions& options_;
  std::string path_;
  bool lines_;
  FileWriter out_;
  CityParts kinds_;
  RootParts parts_;
  CityFaces faces_;
  CityPlace place_;
  CityMaterials materials_;
  CityVertices vertices_, templateVertices_;
  Vec3 origin_;
  Box3 extent_;
  std::string text_, templateText_;
  bool firstObject_ = true, firstGeometry_ = true, inTemplate_ = false;
  std::map<std::string, uint32_t> ids_;
  std::map<uint32_t, Template> templates_;
  WriteReport report_;
  uint64_t openBuildings_ = 0, failedBuildings_ = 0;
  /// The lowest point of the buildings of a shape.
  double foot_ = 0;
};

void CityJsonWriter::flush(bool whole) {
  if (inTemplate_ || (!whole && text_.size() < kPiece)) return;
  out_.append(text_);
  text_.clear();
}

// Templates count from their own origin.
CityVertices::Vertex CityJsonWriter::vertexAt(const Vec3& world) {
  Vec3 local = upright(world);
  if (!inTemplate_) {
    const Vec3 at = place_.at(world);
    extent_.include(at);
    local = at - origin_;
  }
  const auto whole = [](double v) { return static_cast<int64_t>(std::llround(v / kCityScale)); };
  return {whole(local.x), whole(local.y), whole(local.z)};
}

std::string CityJsonWriter::uniqueId(const std::string& wanted) {
  std::string id = wanted.empty() ? "shape" : wanted;
  for (uint32_t& next = ids_[id]; next > 0;) {
    work();
    const std::string tried = id + "-" + std::to_string(++next);
    if (ids_.try_emplace(tried, 1).second) return tried;
  }
  ids_[id] = 1;
  return id;
}

template <class Put>
void CityJsonWriter::forEachLeafOf(const CityObjectContent& object, const CityContent& content,
                                   Put&& put) {
  for (const PlacedPart& p : object.parts) {
    work();
    const Leaf& leaf = scene_.leaves[p.planned.leaf];
    put(leaf, content.placements[p.planned.placement] * leaf.frame, p);
  }
}

Box3 CityJsonWriter::boxOf(const CityObjectContent& object, const CityContent& content) {
  Box3 box;
  forEachLeafOf(object, content, [&](const Leaf& leaf, const Frame& world, const PlacedPart&) {
    box.include(faces_.boxOf(leaf, world));
  });
  return box;
}

// ---- Faces --------------------------------------------------------------------------------------

// By the table of kinds; what it leaves open, and floors, by where the face looks.
const char* CityJsonWriter::surfaceOf(CityKind kind, const CityFace& face, double base) const {
  const CityKind sight = kindBySight(face, base);
  if (isLevel(kind)) {
    if (sight == CityKind::Roof || sight == CityKind::Floor) return "OuterFloorSurface";
    if (sight == CityKind::Wall) return "WallSurface";
    return kind == CityKind::Ground ? "GroundSurface" : "OuterCeilingSurface";
  }
  // The top of a wall that is a body is none.
  const double up = face.normal.y / length(face.normal);
  const bool lies = kind == CityKind::Wall && std::fabs(up) > kLevel;
  if (const char* known = specOf(kind).surface; known && !lies) return known;
  return specOf(sight).surface;
}

uint32_t CityJsonWriter::semanticOf(const PlacedPart& part, const char* type,
                                    Surfaces& said) const {
  const uint32_t run = isOpening(part.kind) ? part.run : 0;
  const auto [at, isNew] =
      said.known.try_emplace({type, run}, static_cast<uint32_t>(said.semantics.size()));
  const uint32_t number = at->second;
  if (isNew) said.semantics.push_back({type, ""});
  if (run == 0 || (!isNew && !said.namedByTrim.contains(number))) return number;
  // A window has the name of its pane, not of its sill.
  const Leaf& leaf = scene_.leaves[part.planned.leaf];
  const bool isTrim = kinds_.of(leaf).trim;
  if (isTrim && !isNew) return number;
  if (leaf.name < scene_.names.size()) said.semantics[number].name = scene_.names[leaf.name];
  if (isTrim)
    said.namedByTrim.insert(number);
  else
    said.namedByTrim.erase(number);
  return number;
}

// The boundaries of a face, unless it has no area in whole millimetres.
bool CityJsonWriter::putFace(const CityFace& face, bool first) {
  std::vector<std::vector<CityVertices::Vertex>> rings;
  size_t corners = 0;
  for (const std::vector<Vec3>& ring : face.rings) {
    std::vector<CityVertices::Vertex> whole;
    for (const Vec3& p : ring) {
      const CityVertices::Vertex v = vertexAt(p);
      if (whole.empty() || whole.back() != v) whole.push_back(v);
    }
    while (whole.size() > 1 && whole.front() == whole.back()) whole.pop_back();
    if (whole.size() < 3) {
      if (rings.empty()) return false;
      continue;
    }
    corners += whole.size();
    rings.push_back(std::move(whole));
  }
  std::vector<Vec3> outer;
  for (const CityVertices::Vertex& v : rings[0]) {
    outer.push_back({static_cast<double>(v[0] - rings[0][0][0]),
                     static_cast<double>(v[1] - rings[0][0][1]),
                     static_cast<double>(v[2] - rings[0][0][2])});
  }
  const Vec3 normal = ringNormal(outer);
  if (!(dot(normal, normal) > 0)) return false;
  std::string& out = inTemplate_ ? templateText_ : text_;
  CityVertices& vertices = inTemplate_ ? templateVertices_ : vertices_;
  out += first ? "[" : ",[";
  for (size_t r = 0; r < rings.size(); ++r) {
    out += r ? ",[" : "[";
    for (size_t i = 0; i < rings[r].size(); ++i) {
      if (i > 0) out += ',';
      appendNumber(out, vertices.add(rings[r][i]));
    }
    out += ']';
  }
  out += ']';
  report_.triangles += corners - 2 + 2 * (rings.size() - 1);
  return true;
}

void CityJsonWriter::writeLeaf(const Leaf& leaf, const Frame& world, const PlacedPart& part,
                               double base, bool upOnly, Surfaces& said) {
  const bool semantic = !specOf(part.kind).object || isOfBuilding(part.kind);
  faces_.forEach(leaf, world, [&](CityFace& face) {
    if (upOnly && face.normal.y <= kCityUp * length(face.normal)) return;
    if (!putFace(face, said.semanticOf.empty())) return;
    const char* type = semantic ? surfaceOf(part.kind, face, base) : nullptr;
    said.semanticOf.push_back(type ? semanticOf(part, type, said) : CitySurfaces::kNone);
    said.materialOf.push_back(materials_.use(materialIndexOf(scene_, leaf, face.slot)));
  });
  flush();
}

// ---- Geometries ---------------------------------------------------------------------------------

void CityJsonWriter::openGeometry(const char* type, const char* lod) {
  text_ += firstGeometry_ ? "{\"type\":\"" : ",{\"type\":\"";
  firstGeometry_ = false;
  text_ += std::string(type) + "\",\"lod\":\"" + lod + "\",\"boundaries\":[";
}

void CityJsonWriter::writeFull(const CityObjectContent& object, const CityContent& content,
                               const char* lod, bool upOnly) {
  const double own = boxOf(object, content).min.y;
  // What belongs to a building, such as a chimney, has its ground.
  const double base = isOfBuilding(object.key.kind) ? std::min(own, foot_) : own;
  Surfaces said;
  openGeometry("MultiSurface", lod);
  forEachLeafOf(object, content, [&](const Leaf& leaf, const Frame& world, const PlacedPart& p) {
    writeLeaf(leaf, world, p, base, upOnly, said);
  });
  text_ += ']';
  appendSurfaces(text_, said, 1);
  text_ += '}';
}

// The faces of a shell, between the brackets of a list.
void CityJsonWriter::writeShell(const BuildingShell& shell) {
  std::vector<uint32_t> numbers;
  for (const Vec3& p : shell.points) {
    work();
    numbers.push_back(vertices_.add(vertexAt(laid(p))));
  }
  for (size_t f = 0; f < shell.faces.size(); ++f) {
    text_ += f ? ",[" : "[";
    for (size_t r = 0; r < shell.faces[f].rings.size(); ++r) {
      text_ += r ? ",[" : "[";
      for (size_t i = 0; i < shell.faces[f].rings[r].size(); ++i) {
        work();
        if (i > 0) text_ += ',';
        appendNumber(text_, numbers[shell.faces[f].rings[r][i]]);
      }
      text_ += ']';
    }
    text_ += ']';
  }
}

// A Solid, or a MultiSolid of several, where all of them close; else one MultiSurface.
void CityJsonWriter::writeShells(const std::vector<BuildingShell>& shells, const char* lod) {
  if (shells.empty()) return;
  const auto closes = [](const BuildingShell& s) { return s.closed; };
  const bool solid = std::all_of(shells.begin(), shells.end(), closes);
  const bool several = solid && shells.size() > 1;
  CitySurfaces said;
  said.semantics = {{"RoofSurface", {}}, {"WallSurface", {}}, {"GroundSurface", {}}};
  openGeometry(several ? "MultiSolid" : solid ? "Solid" : "MultiSurface", lod);
  // A shell is a list of faces in a Solid, and a Solid one in a list of them.
  const std::string open = several ? "[["
                           : solid ? "["
                                   : "",
                    close = several ? "]]"
                            : solid ? "]"
                                    : "";
  for (size_t s = 0; s < shells.size(); ++s) {
    if (s > 0) text_ += ',';
    text_ += open;
    writeShell(shells[s]);
    text_ += close;
    for (const ShellFace& f : shells[s].faces) {
      said.semanticOf.push_back(f.kind == CityKind::Roof ? 0 : f.kind == CityKind::Wall ? 1 : 2);
    }
    if (several) said.listEnds.push_back(said.semanticOf.size());
  }
  text_ += ']';
  appendSurfaces(text_, said, several ? 3 : solid ? 2 : 1);
  text_ += '}';
  flush();
  openBuildings_ += solid ? 0 : 1;
}

// The bodies of all buildings and their parts.
CityJsonWriter::Bodies CityJsonWriter::bodiesOf(const CityContent& content) {
  Bodies out;
  foot_ = std::numeric_limits<double>::infinity();
  for (const CityObjectContent& object : content.objects) {
    if (!isBuildingKey(object.key)) continue;
    Body& body = out[&object];
    body.box = boxOf(object, content);
    foot_ = std::min(foot_, body.box.min.y);
    std::vector<TopFace> roofs;
    forEachLeafOf(object, content, [&](const Leaf& leaf, const Frame& world, const PlacedPart& p) {
      if (isOpening(p.kind) || p.kind == CityKind::Closure) return;
      faces_.forEach(leaf, world, [&](CityFace& face) {
        if (!(face.normal.y > 2 * kLeastFace)) return;
        TopFace& roof = roofs.emplace_back();
        for (const std::vector<Vec3>& ring : face.rings) {
          std::vector<Vec3>& to = roof.rings.emplace_back();
          for (const Vec3& point : ring) to.push_back(upright(point));
        }
      });
    });
    const Status status = guarded([&] {
      body.shells = shellsOf(roofs, body.box.min.y);
      return Status();
    });
    unwindIfStopped(status);
    if (!status.ok()) ++failedBuildings_;
  }
  return out;
}

void CityJsonWriter::writeBlocks(const Body& body) {
  if (wants(Detail::One)) {
    std::vector<BuildingShell> blocks;
    for (const BuildingShell& s : body.shells) blocks.push_back(blockOf(s));
    writeShells(blocks, "1.2");
  }
  if (wants(Detail::Two)) writeShells(body.shells, "2.2");
}

// ---- Objects ------------------------------------------------------------------------------------

void writePlain(JsonWriter& w, const PlainValue& v) {
  switch (v.kind) {
    case PlainValue::Kind::Number: w.value(v.number); break;
    case PlainValue::Kind::Bool: w.value(v.number != 0); break;
    case PlainValue::Kind::Text: w.value(v.text); break;
  }
}

void CityJsonWriter::openObject(const std::string& id, const std::string& type,
                                const Attributes& attributes, const std::string& parent,
                                const std::vector<std::string>& children) {
  if (!firstObject_) text_ += ',';
  firstObject_ = false;
  JsonWriter w(text_);
  w.value(id);
  text_ += ':';
  JsonWriter o(text_);
  o.beginObject().field("type", type);
  if (!parent.empty()) o.key("parents").beginArray().value(parent).endArray();
  if (!children.empty()) {
    o.key("children").beginArray();
    for (const std::string& c : children) o.value(c);
    o.endArray();
  }
  o.key("attributes").beginObject();
  std::set<std::string> said;
  for (const AttributeValue& a : attributes) {
    work();
    if (a.values.empty() || !said.insert(a.name).second) continue;
    o.key(a.name);
    const bool list = a.rows > 0 || a.columns > 0;
    if (list) o.beginArray();
    for (const PlainValue& v : a.values) {
      work();
      writePlain(o, v);
      if (!list) break;
    }
    if (list) o.endArray();
  }
  o.endObject().key("geometry").beginArray();
  firstGeometry_ = true;
}

void CityJsonWriter::closeObject() {
  text_ += "]}";
  flush();
}

// The geometries of a building, or of a part of one.
void CityJsonWriter::writeBody(const CityObjectContent* object, const CityContent& content,
                               const Bodies& bodies) {
  if (!object) return;
  writeBlocks(bodies.at(object));
  if (wants(Detail::Three)) writeFull(*object, content, "3", false);
}

void CityJsonWriter::writeBuilding(const std::string& id, const CityContent& content,
                                   const Bodies& bodies, const Attributes& known) {
  const CityObjectContent* own = nullptr;
  std::vector<std::pair<std::string, const CityObjectContent*>> parts, things;
  std::vector<std::string> children;
  Box3 box;
  for (const CityObjectContent& o : content.objects) {
    const CityObjectKey& key = o.key;
    if (!isOfBuilding(key.kind)) continue;
    std::string name = id;
    if (key.object) name += "/" + kinds_.text(key.object);
    if (!isBuildingKey(key)) name += std::string("/") + specOf(key.kind).name;
    if (isBuildingKey(key)) box.include(bodies.at(&o).box);
    if (isBuildingKey(key) && key.object == 0) {
      own = &o;
    } else {
      (isBuildingKey(key) ? parts : things).emplace_back(uniqueId(name), &o);
      children.push_back((isBuildingKey(key) ? parts : things).back().first);
    }
  }
  Attributes all = known;
  const double height = box.empty() ? 0 : std::round(box.size().y * 1000) / 1000;
  if (height > 0) all.push_back({"measuredHeight", {{PlainValue::Kind::Number, height, {}}}, 0, 0});
  openObject(id, "Building", all, {}, children);
  writeBody(own, content, bodies);
  closeObject();
  for (const auto& [name, object] : parts) {
    openObject(name, "BuildingPart", {}, id, {});
    writeBody(object, content, bodies);
    closeObject();
  }
  for (const auto& [name, object] : things) writeThing(name, *object, content, {}, id);
}

// Streets, water and the like have a surface seen from above in every level of detail; trees,
// furniture and parts of buildings only as they are.
void CityJsonWriter::writeThing(const std::string& id, const CityObjectContent& object,
                                const CityContent& content, const Attributes& known,
                                const std::string& parent) {
  const CityKind kind = object.key.kind;
  const bool alone = parent.empty() && isOfBuilding(kind);
  const bool flat = parent.empty() && !alone && !isSolitary(kind);
  openObject(id, specOf(alone ? CityKind::Construction : kind).object, known, parent, {});
  if (wants(Detail::Three)) {
    writeFull(object, content, "3", false);
  } else if (flat) {
    writeFull(object, content, options_.detail == Detail::One ? "1" : "2", true);
  }
  closeObject();
}

// The leaves of a prototype between the brackets of a list, and what is said of them.
void CityJsonWriter::writeWhole(const CityInstance& whole, const Frame& world, std::string& out) {
  Surfaces said;
  PlacedPart part;
  part.kind = whole.part.kind;
  out += "\"boundaries\":[";
  forEachLeaf(
      scene_, scene_.prototypes[whole.prototype], world,
      [&](const Leaf& leaf, const Frame& at) { writeLeaf(leaf, at, part, 0, false, said); });
  out += ']';
  appendSurfaces(out, said, 1);
  out += '}';
}

const CityJsonWriter::Template& CityJsonWriter::templateOf(const CityInstance& whole) {
  const auto [at, isNew] = templates_.try_emplace(whole.prototype);
  Template& t = at->second;
  if (!isNew) return t;
  t.number = static_cast<uint32_t>(templates_.size() - 1);
  const uint64_t before = report_.triangles;
  inTemplate_ = true;
  templateText_ += t.number > 0 ? ",{" : "{";
  templateText_ += "\"type\":\"MultiSurface\",\"lod\":\"3\",";
  writeWhole(whole, Frame{}, templateText_);
  inTemplate_ = false;
  workMemory(templateText_.size());
  t.triangles = report_.triangles - before;
  report_.triangles = before;
  return t;
}

// A template where several stand, else its own leaves.
void CityJsonWriter::writeInstance(const std::string& id, const CityInstance& whole) {
  openObject(id, specOf(whole.part.kind).object, {}, {}, {});
  if (lines_ || kinds_.uses(whole.prototype) < 2) {
    text_ += "{\"type\":\"MultiSurface\",\"lod\":\"3\",";
    writeWhole(whole, whole.world, text_);
    return closeObject();
  }
  const Template& t = templateOf(whole);
  report_.triangles += t.triangles;
  text_ += "{\"type\":\"GeometryInstance\",\"template\":";
  appendNumber(text_, t.number);
  text_ += ",\"boundaries\":[";
  appendNumber(text_, vertices_.add(vertexAt(whole.world.origin)));
  text_ += "],\"transformationMatrix\":[";
  Vec3 east, north;
  place_.axesAt(whole.world.origin, east, north);
  // Columns: where x, y and z of the template, which stands upright, lead to.
  std::array<Vec3, 3> columns;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 d = i == 0 ? whole.world.x : i == 1 ? -whole.world.z : whole.world.y;
    columns[i] = east * d.x + north * -d.z + Vec3{0, 0, d.y};
  }
  for (size_t row = 0; row < 3; ++row) {
    for (const Vec3& c : columns) {
      appendShortest(text_, std::round(c[row] * 1e9) / 1e9);
      text_ += ',';
    }
    text_ += "0,";
  }
  text_ += "0,0,0,1]}";
  closeObject();
}

// ---- The file -----------------------------------------------------------------------------------

void CityJsonWriter::writeMetadata() {
  JsonWriter w(text_);
  w.beginObject();
  if (!lines_ && !extent_.empty()) {
    w.key("geographicalExtent").beginArray();
    for (const Vec3& corner : {extent_.min, extent_.max}) {
      for (size_t a = 0; a < 3; ++a) w.value(std::round(corner[a] * 1000) / 1000);
    }
    w.endArray();
  }
  if (place_.system() > 0) {
    w.field("referenceSystem",
            "https://www.opengis.net/def/crs/EPSG/0/" + std::to_string(place_.system()));
  }
  w.endObject();
}

void CityJsonWriter::writeHead() {
  text_ = R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],)";
  text_ += "\"translate\":[";
  for (size_t a = 0; a < 3; ++a) {
    if (a > 0) text_ += ',';
    appendShortest(text_, origin_[a]);
  }
  text_ += "]},";
  if (lines_) {
    text_ += "\"metadata\":";
    writeMetadata();
    text_ += ",\"CityObjects\":{},\"vertices\":[]}\n";
  } else {
    text_ += "\"CityObjects\":{";
  }
}

void CityJsonWriter::writeTail() {
  if (lines_) return;
  text_ += "},\"vertices\":";
  vertices_.write(text_, [&] { flush(); });
  if (!materials_.empty()) {
    text_ += ",\"appearance\":";
    materials_.write(text_);
  }
  if (!templates_.empty()) {
    text_ += ",\"geometry-templates\":{\"templates\":[";
    flush(true);
    out_.append(templateText_);
    text_ += "],\"vertices-templates\":[";
    bool first = true;
    for (const CityVertices::Vertex& v : templateVertices_.all()) {
      work();
      text_ += first ? "[" : ",[";
      first = false;
      for (size_t a = 0; a < 3; ++a) {
        if (a > 0) text_ += ',';
        char number[kNumberRoom];
        const char* end = writeFixed(number, static_cast<double>(v[a]) * kCityScale, 3);
        text_.append(number, static_cast<size_t>(end - number));
      }
      text_ += ']';
      flush();
    }
    text_ += "]}";
  }
  text_ += ",\"metadata\":";
  writeMetadata();
  text_ += "}\n";
}

void CityJsonWriter::openLine(const std::string& id) {
  if (!lines_) return;
  vertices_.clear();
  materials_.clear();
  firstObject_ = true;
  JsonWriter w(text_);
  w.beginObject().field("type", "CityJSONFeature").field("id", id);
  text_ += ",\"CityObjects\":{";
}

void CityJsonWriter::closeLine() {
  if (!lines_) return;
  text_ += "},\"vertices\":";
  vertices_.write(text_, [&] { flush(); });
  if (!materials_.empty()) {
    text_ += ",\"appearance\":";
    materials_.write(text_);
  }
  text_ += "}\n";
  flush();
}

void CityJsonWriter::writeRoot(uint32_t number) {
  const Root& root = scene_.roots[number];
  const std::string& name = root.name < scene_.names.size() ? scene_.names[root.name] : path_;
  const Attributes known = options_.attributesOf ? options_.attributesOf(number) : Attributes{};
  parts_.open(options_.labelsOf ? options_.labelsOf(number) : std::vector<LabelledLeaves>{});
  const CityContent content = cityContentOf(scene_, parts_, faces_, root, kindOfShape(name, known));
  // What has no roof, such as a street with its cars, and railings without a building are
  // constructions of their own.
  const Bodies bodies = bodiesOf(content);
  const bool builds = std::any_of(bodies.begin(), bodies.end(),
                                  [](const auto& b) { return !b.second.shells.empty(); });
  const std::string id = uniqueId(titleOfShape(name, known));
  if (builds) {
    openLine(id);
    writeBuilding(id, content, bodies, known);
    closeLine();
  }
  bool first = !builds;
  for (const CityObjectContent& o : content.objects) {
    const bool alone = isOfBuilding(o.key.kind);
    if (alone && builds) continue;
    if (!wants(Detail::Three) && (alone || isSolitary(o.key.kind))) continue;
    std::string own =
        o.key.object ? id + "/" + kinds_.text(o.key.object) : id + "/" + specOf(o.key.kind).name;
    if (!first || o.key.object) own = uniqueId(own);
    const std::string& thing = first && !o.key.object ? id : own;
    openLine(thing);
    writeThing(thing, o, content, builds || isSolitary(o.key.kind) ? Attributes{} : known, {});
    closeLine();
    first = false;
  }
  for (const CityInstance& i : content.instances) {
    if (out_.failed() || !wants(Detail::Three)) break;
    const std::string named = i.part.object ? kinds_.text(i.part.object) : specOf(i.part.kind).name;
    const bool alone = first && content.instances.size() == 1;
    const std::string thing = alone ? id : uniqueId(id + "/" + named);
    openLine(thing);
    writeInstance(thing, i);
    closeLine();
  }
}

Result<WriteReport> CityJsonWriter::write() {
  writeHead();
  for (uint32_t r = 0; r < scene_.roots.size() && !out_.failed(); ++r) {
    work();
    if (!scene_.prototypes[scene_.roots[r].instance.prototype].empty) writeRoot(r);
  }
  writeTail();
  flush(true);
  const auto warn = [&](uint64_t count, const std::string& what) {
    if (count > 0) report_.warnings.push_back(std::to_string(count) + what);
  };
  for (const std::string& word : kinds_.unknownWords()) {
    report_.warnings.push_back("'" + word +
                               "' is no cityPart: the parts that say so are taken for " +
                               "what their names say; docs/guide/city-models.md lists the words");
  }
  warn(faces_.leftOut(), " faces are farther than a million kilometres and are left out");
  warn(failedBuildings_, " buildings have no LoD 1 and 2: their roofs cannot be joined");
  warn(openBuildings_, " times LoD 1 or 2 of a building does not close and is a MultiSurface");
  if (materials_.hasTextures()) {
    report_.warnings.push_back("pictures are not written to CityJSON: surfaces have their colours");
  }
  const Result<uint64_t> bytes = out_.finish();
  if (!bytes.ok()) return bytes.error();
  report_.bytes = bytes.value();
  report_.files = {path_};
  return report_;
}

}  // namespace

Result<WriteReport> writeCityJson(const Scene& scene, const std::string& path,
                                  const WriteOptions& options) {
  return CityJsonWriter(scene, path, options).write();
}

}  // namespace gable
