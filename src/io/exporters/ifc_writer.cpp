// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// IFC4 (ISO 16739-1:2018, Reference View) as STEP text. An initial shape is a building; its leaves
// are taken in path order, and those that follow each other, are of one kind and touch are one
// element. What nothing says and looks one way is a roof, a wall or a ceiling. A prototype that is
// of one kind and stands several times is an element for each place of it, of one mapped shape. An
// element lies in the frame of its first leaf, and those that are equal there share their shape. In
// memory are one element, the numbers of those of a building, and a number for each shape.
//
// Elements lie in the storeys of ifc_storeys.h.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "base/hash.h"
#include "base/number.h"
#include "base/work.h"
#include "io/exporters/city_content.h"
#include "io/exporters/city_place.h"
#include "io/exporters/ifc_elements.h"
#include "io/exporters/ifc_storeys.h"
#include "io/exporters/root_parts.h"
#include "io/exporters/step_text.h"
#include "io/exporters/write_model.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// An element of more is several.
constexpr uint64_t kMostTriangles = 50'000;
constexpr size_t kMostLabel = 255;
// Names that a message lists.
constexpr size_t kMostTold = 8;

struct Storey {
  StepId id = 0, placement = 0;
  std::vector<StepId> elements;
};

class IfcWriter {
 public:
  IfcWriter(const Scene& scene, const std::string& path, const WriteOptions& options)
      : scene_(scene),
        options_(options),
        path_(path),
        file_(path),
        axes_(file_),
        kinds_(scene),
        parts_(kinds_),
        faces_(scene),
        triangles_(scene),
        place_(options.geo, scene.geoOrigin),
        levels_(faces_, kinds_),
        shape_(scene, triangles_) {}

  Result<WriteReport> write();

 private:
  using Attributes = std::vector<AttributeValue>;
  struct Mapped {
    StepId map = 0;
    Box3 box;
    uint64_t triangles = 0;
    uint32_t material = kNoMaterial;
  };

  std::string guid() { return "'" + stepGuid(rootNumber_, ++guids_) + "'"; }
  void writeHead();
  void writeContext();
  void writePlaceOnEarth(StepId context);
  void writeSite();
  void writeRoot(uint32_t root);
  void measure(const Root& root);
  void openBuilding();
  void closeBuilding(const Attributes& known);
  void look(const Leaf& leaf, const Frame& world);
  void tellProxies();
  void addLeaf(uint32_t leaf, const Frame& around);
  void addInstance(const Instance& in, const Frame& world, const CityPart& part);
  void endElement();
  const Mapped& mappedOf(uint32_t prototype);
  struct Element {
    CityPart part;
    uint32_t name = 0, material = kNoMaterial;
    /// In the world.
    Box3 box;
    /// Along its own axes: y along the one that is nearest to the vertical.
    Vec3 size;
  };
  /// `definition`: an IfcProductDefinitionShape in `frame`.
  void putElement(const Element& e, StepId definition, const Frame& frame);
  std::string tailOf(const CityPart& part, const Vec3& size) const;
  void relate(const char* relation, StepId parent, const std::vector<StepId>& children);
  std::string nameOf(uint32_t number) const {
    return stepText(number < scene_.names.size() ? scene_.names[number] : "", kMostLabel);
  }

  const Scene& scene_;
  const WriteOptions& options_;
  std::string path_;
  StepFile file_;
  IfcAxesWriter axes_;
  CityParts kinds_;
  RootParts parts_;
  CityFaces faces_;
  TriangleCache triangles_;
  CityPlace place_;
  WriteReport report_;
  StepId project_ = 0, body_ = 0, site_ = 0, sitePlacement_ = 0, identity_ = 0, same_ = 0;
  std::unique_ptr<IfcShapeWriter> shapes_;
  std::map<uint32_t, Mapped> mapped_;
  std::vector<StepId> buildings_, siteElements_;
  // By material of the scene.
  std::map<uint32_t, std::vector<StepId>> elementsOf_;
  uint64_t rootNumber_ = 0, guids_ = 0;
  // How many shapes of a title were written.
  std::map<std::string, uint64_t> titles_;
  // Of the building at hand.
  StepId building_ = 0, buildingPlacement_ = 0;
  std::string buildingName_;
  bool builds_ = false;
  IfcStoreys levels_;
  // By index into levels_.all().
  std::vector<Storey> storeys_;
  // The element at hand.
  IfcShape shape_;
  Element open_;
  bool nameIsTrim_ = false;
  // Where the element lies, the way there from the world, and that to its first leaf.
  Frame frame_, toFrame_, ownAxes_;
  Box3 ownBox_;
  // Of an element whose kind nothing says.
  CitySights sights_;
  // By name, the elements that stay without a kind.
  std::map<std::string, uint64_t> proxies_;
};

void IfcWriter::relate(const char* relation, StepId parent, const std::vector<StepId>& children) {
  if (children.empty()) return;
  const bool aggregates = std::string_view(relation) == "IFCRELAGGREGATES";
  const std::string head = std::string(relation) + "(" + guid() + ",$,$,$,";
  file_.add(aggregates ? head + stepRef(parent) + "," + stepList(children) + ")"
                       : head + stepList(children) + "," + stepRef(parent) + ")");
}

// ---- Head ---------------------------------------------------------------------------------------

void IfcWriter::writeHead() {
  // The time is part of the form; files of equal models are equal.
  file_.raw(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [ReferenceView_V1.2]'),"
      "'2;1');\nFILE_NAME(" +
      stepText(fileNameOf(path_)) +
      ",'2000-01-01T00:00:00',(''),(''),'Gable','Gable','');\nFILE_SCHEMA(('IFC4'));\n"
      "ENDSEC;\nDATA;\n");
  writeContext();
  writeSite();
}

void IfcWriter::writeContext() {
  identity_ = axes_.axes(Frame{});
  const StepId context = file_.add("IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05," +
                                   stepRef(identity_) + ",$)");
  body_ = file_.add("IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*," +
                    stepRef(context) + ",$,.MODEL_VIEW.,$)");
  std::vector<StepId> units;
  for (const char* unit : {".LENGTHUNIT.,$,.METRE.", ".AREAUNIT.,$,.SQUARE_METRE.",
                           ".VOLUMEUNIT.,$,.CUBIC_METRE.", ".PLANEANGLEUNIT.,$,.RADIAN."}) {
    units.push_back(file_.add(std::string("IFCSIUNIT(*,") + unit + ")"));
  }
  const StepId assigned = file_.add("IFCUNITASSIGNMENT(" + stepList(units) + ")");
  std::string name = fileNameOf(path_);
  name.resize(std::min(name.rfind('.'), name.size()));
  project_ = file_.add("IFCPROJECT(" + guid() + ",$," + stepText(name, kMostLabel) + ",$,$,$,$,(" +
                       stepRef(context) + ")," + stepRef(assigned) + ")");
  shapes_ = std::make_unique<IfcShapeWriter>(scene_, file_, body_);
  writePlaceOnEarth(context);
}

void IfcWriter::writePlaceOnEarth(StepId context) {
  if (place_.system() == 0) return;
  const Vec3 at = place_.at({0, 0, 0});
  Vec3 east, north;
  place_.axesAt({0, 0, 0}, east, north);
  const StepId system =
      file_.add("IFCPROJECTEDCRS('EPSG:" + std::to_string(place_.system()) + "',$,$,$,$,$,$)");
  const double scale = length(east);
  file_.add("IFCMAPCONVERSION(" + stepRef(context) + "," + stepRef(system) + "," +
            stepReal(std::round(at.x * 1000) / 1000) + "," +
            stepReal(std::round(at.y * 1000) / 1000) + ",0.," + stepReal(east.x / scale) + "," +
            stepReal(east.y / scale) + "," + stepReal(scale) + ")");
}

// Degrees, minutes, seconds and millionths of a second, all of one sign.
std::string angleText(double degrees) {
  const auto all = static_cast<int64_t>(std::llround(degrees * 3600e6));
  const int64_t parts[] = {all / 3600000000, all / 60000000 % 60, all / 1000000 % 60,
                           all % 1000000};
  std::string out;
  for (const int64_t p : parts) out += (out.empty() ? "(" : ",") + std::to_string(p);
  return out + ")";
}

void IfcWriter::writeSite() {
  sitePlacement_ = file_.add("IFCLOCALPLACEMENT($," + stepRef(identity_) + ")");
  std::string where = "$,$,$";
  if (place_.degrees()) {
    where = angleText(place_.degrees()->latitude) + "," + angleText(place_.degrees()->longitude) +
            ",0.";
  }
  site_ = file_.add("IFCSITE(" + guid() + ",$,'Site',$,$," + stepRef(sitePlacement_) +
                    ",$,$,.ELEMENT.," + where + ",$,$)");
  relate("IFCRELAGGREGATES", project_, {site_});
}

// ---- Buildings ----------------------------------------------------------------------------------

void IfcWriter::measure(const Root& root) {
  levels_.clear();
  builds_ = false;
  parts_.begin();
  forEachLeaf(scene_, scene_.prototypes[root.instance.prototype], root.instance.frame,
              [&](const Leaf& leaf, const Frame& world) {
                const CityPart part = parts_.next(leaf);
                if (!isOfBuilding(part.kind)) return;
                builds_ = true;
                levels_.add(leaf, world, part);
              });
}

void IfcWriter::openBuilding() {
  building_ = file_.reserve();
  buildingPlacement_ =
      file_.add("IFCLOCALPLACEMENT(" + stepRef(sitePlacement_) + "," + stepRef(identity_) + ")");
  file_.put(building_, "IFCBUILDING(" + guid() + ",$," + buildingName_ + ",$,$," +
                           stepRef(buildingPlacement_) + ",$,$,.ELEMENT.,$,$,$)");
  buildings_.push_back(building_);
  storeys_.resize(levels_.all().size());
  for (Storey& s : storeys_) {
    work();
    s.id = file_.reserve();
    s.placement = file_.add("IFCLOCALPLACEMENT(" + stepRef(buildingPlacement_) + "," +
                            stepRef(identity_) + ")");
  }
}

void IfcWriter::closeBuilding(const Attributes& known) {
  std::vector<StepId> ids;
  for (size_t i = 0; i < storeys_.size(); ++i) {
    const Storey& s = storeys_[i];
    const IfcStorey& level = levels_.all()[i];
    file_.put(s.id, "IFCBUILDINGSTOREY(" + guid() + ",$," + stepText(level.name, kMostLabel) +
                        ",$,$," + stepRef(s.placement) + ",$,$,.ELEMENT.," +
                        stepReal(std::round(level.elevation * 1e5) / 1e5) + ")");
    relate("IFCRELCONTAINEDINSPATIALSTRUCTURE", s.id, s.elements);
    ids.push_back(s.id);
  }
  relate("IFCRELAGGREGATES", building_, ids);
  storeys_.clear();
  const StepId set = ifcProperties(file_, stepGuid(rootNumber_, ++guids_), known);
  if (set) {
    file_.add("IFCRELDEFINESBYPROPERTIES(" + guid() + ",$,$,$,(" + stepRef(building_) + ")," +
              stepRef(set) + ")");
  }
}

// ---- Elements -----------------------------------------------------------------------------------

// A size along the axes of a frame, as Element has it.
Vec3 upright(Vec3 size, const Frame& frame) {
  const double x = std::fabs(frame.x.y), y = std::fabs(frame.y.y), z = std::fabs(frame.z.y);
  if (x > y && x > z) std::swap(size.x, size.y);
  if (z > y && z >= x) std::swap(size.z, size.y);
  return size;
}

// What follows the tag in the lines of a class.
std::string IfcWriter::tailOf(const CityPart& part, const Vec3& size) const {
  switch (part.kind) {
    case CityKind::Window:
    case CityKind::Door: {
      const std::string tall = stepReal(std::round(size.y * 1e5) / 1e5);
      const std::string wide = stepReal(std::round(std::max(size.x, size.z) * 1e5) / 1e5);
      return "," + tall + "," + wide + ",.NOTDEFINED.,.NOTDEFINED.,$)";
    }
    case CityKind::Floor:
    case CityKind::Balcony: return ",.FLOOR.)";
    case CityKind::Ground: return ",.BASESLAB.)";
    case CityKind::Ceiling: return ",.CEILING.)";
    case CityKind::Covering: return part.trim ? ",.MOLDING.)" : ",.CLADDING.)";
    case CityKind::Bridge:
    case CityKind::Tunnel: return ")";
    default: break;
  }
  return std::string_view(specOf(part.kind).ifc) == "IfcGeographicElement" ? ",.USERDEFINED.)"
                                                                           : ",.NOTDEFINED.)";
}

std::string upperCase(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return text;
}

void IfcWriter::putElement(const Element& e, StepId definition, const Frame& frame) {
  CityPart part = e.part;
  Storey* storey = nullptr;
  if (isOfBuilding(part.kind) && !storeys_.empty()) storey = &storeys_[levels_.of(part, e.box)];
  if (part.kind == CityKind::Unknown) part.kind = sights_.oneWay();
  const StepId around = storey ? storey->placement : sitePlacement_;
  const StepId axes = frame == Frame{} ? identity_ : axes_.axes(frame);
  const StepId placement =
      file_.add("IFCLOCALPLACEMENT(" + stepRef(around) + "," + stepRef(axes) + ")");
  const CityKindSpec& spec = specOf(part.kind);
  const std::string type = part.object ? stepText(kinds_.text(part.object), kMostLabel)
                           : part.kind == CityKind::Unknown ? "$"
                                                            : std::string("'") + spec.name + "'";
  const StepId id =
      file_.add(upperCase(spec.ifc) + "(" + guid() + ",$," + nameOf(e.name) + ",$," + type + "," +
                stepRef(placement) + "," + stepRef(definition) + ",$" + tailOf(part, e.size));
  (storey ? storey->elements : siteElements_).push_back(id);
  if (part.kind == CityKind::Unknown) {
    ++proxies_[e.name < scene_.names.size() ? scene_.names[e.name] : ""];
  }
  if (e.material < scene_.materials.size()) elementsOf_[e.material].push_back(id);
}

void IfcWriter::endElement() {
  if (shape_.triangleCount() > 0) {
    report_.triangles += shape_.triangleCount();
    open_.material = shape_.parts().begin()->first;
    open_.size = upright(ownBox_.size(), inverse(ownAxes_));
    putElement(open_, shapes_->definition(shape_), frame_);
  }
  shape_.clear();
  sights_.clear();
}

void IfcWriter::look(const Leaf& leaf, const Frame& world) {
  const double foot = levels_.bounds().min.y;
  faces_.forEach(leaf, world, [&](const CityFace& face) { sights_.add(face, foot); });
}

void IfcWriter::tellProxies() {
  uint64_t count = 0;
  std::vector<std::pair<uint64_t, std::string>> names;
  for (const auto& [name, n] : proxies_) {
    work();
    count += n;
    names.emplace_back(n, name.empty() ? "without a name" : name);
  }
  if (count == 0) return;
  std::sort(names.begin(), names.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  std::string told;
  for (size_t i = 0; i < std::min(names.size(), kMostTold); ++i) {
    told += (i ? ", " : "") + names[i].second + " (" + std::to_string(names[i].first) + ")";
  }
  if (names.size() > kMostTold) told += " and others";
  report_.warnings.push_back(
      "nothing says what " + std::to_string(count) + (count == 1 ? " part is" : " parts are") +
      ", so the class is IfcBuildingElementProxy: " + told +
      "; set(cityPart, \"Wall\") in a rule says it; docs/guide/city-models.md lists the words");
}

// Whether a place can be written.
bool isNear(const Vec3& p) {
  for (size_t a = 0; a < 3; ++a) {
    if (!(std::fabs(p[a]) < kFarthestCity)) return false;
  }
  return true;
}

void IfcWriter::addLeaf(uint32_t index, const Frame& around) {
  const Leaf& leaf = scene_.leaves[index];
  const Frame world = around * leaf.frame;
  const CityPart part = parts_.next(leaf);
  const Box3 box = faces_.boxOf(leaf, world);
  const bool isTrim = kinds_.of(leaf).trim;
  if (parts_.begins() || shape_.triangleCount() > kMostTriangles) {
    endElement();
    open_.part = part;
    open_.box = Box3{};
    open_.name = leaf.name;
    nameIsTrim_ = isTrim;
    frame_ = isNear(world.origin) ? world : Frame{};
    ownAxes_ = inverse(world);
    toFrame_ = inverse(frame_);
    ownBox_ = Box3{};
  } else if (nameIsTrim_ && !isTrim) {
    // A window has the name of its pane, not of its sill.
    open_.name = leaf.name;
    nameIsTrim_ = false;
  }
  open_.box.include(box);
  if (part.kind == CityKind::Unknown) look(leaf, world);
  ownBox_.include(faces_.boxOf(leaf, ownAxes_ * world));
  shape_.add(leaf, toFrame_ * world);
}

const IfcWriter::Mapped& IfcWriter::mappedOf(uint32_t prototype) {
  const auto [at, isNew] = mapped_.try_emplace(prototype);
  Mapped& m = at->second;
  if (!isNew) return m;
  IfcShape shape(scene_, triangles_);
  forEachLeaf(scene_, scene_.prototypes[prototype], Frame{},
              [&](const Leaf& leaf, const Frame& world) {
                shape.add(leaf, world);
                m.box.include(faces_.boxOf(leaf, world));
              });
  m.triangles = shape.triangleCount();
  if (m.triangles == 0) return m;
  m.material = shape.parts().begin()->first;
  m.map = file_.add("IFCREPRESENTATIONMAP(" + stepRef(identity_) + "," +
                    stepRef(shapes_->representation(shape)) + ")");
  return m;
}

void IfcWriter::addInstance(const Instance& in, const Frame& world, const CityPart& part) {
  endElement();
  const Mapped& mapped = mappedOf(in.prototype);
  if (mapped.triangles == 0) return;
  report_.triangles += mapped.triangles;
  if (!same_) {
    const StepId at = file_.add("IFCCARTESIANPOINT((0.,0.,0.))");
    same_ = file_.add("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$," + stepRef(at) + ",1.,$)");
  }
  const StepId item =
      file_.add("IFCMAPPEDITEM(" + stepRef(mapped.map) + "," + stepRef(same_) + ")");
  const StepId shown = file_.add("IFCSHAPEREPRESENTATION(" + stepRef(body_) +
                                 ",'Body','MappedRepresentation',(" + stepRef(item) + "))");
  const StepId definition = file_.add("IFCPRODUCTDEFINITIONSHAPE($,$,(" + stepRef(shown) + "))");
  putElement({part, scene_.prototypes[in.prototype].name, mapped.material,
              boundsAt(mapped.box, world, {1, 1, 1}), upright(mapped.box.size(), world)},
             definition, world);
}

void IfcWriter::writeRoot(uint32_t number) {
  const Root& root = scene_.roots[number];
  guids_ = 0;
  const Attributes known = options_.attributesOf ? options_.attributesOf(number) : Attributes{};
  const std::string& name = root.name < scene_.names.size() ? scene_.names[root.name] : path_;
  parts_.open(options_.labelsOf ? options_.labelsOf(number) : std::vector<LabelledLeaves>{});
  const CityKind kind = kindOrLand(scene_, parts_, root, kindOfShape(name, known));
  parts_.settle(scene_, root, faces_, kind);
  measure(root);
  levels_.divide(storeyCountOf(known));
  const std::string title = titleOfShape(name, known);
  buildingName_ = stepText(title, kMostLabel);
  // Ids stay as they are where other shapes come and go.
  rootNumber_ = hashBytes(title, ++titles_[title]);
  if (builds_) openBuilding();
  const auto enter = [&](const Instance& in, const Frame& world) {
    const std::optional<CityPart> part = parts_.element(in.prototype);
    if (!part || (kinds_.uses(in.prototype) < 2 && !isSolitary(part->kind))) return true;
    addInstance(in, world, *part);
    parts_.skip(in.prototype);
    return false;
  };
  parts_.begin();
  if (enter(root.instance, root.instance.frame)) {
    walk(
        scene_, scene_.prototypes[root.instance.prototype], root.instance.frame,
        [&](uint32_t leaf, const Frame& at, size_t) {
          if (!file_.failed()) addLeaf(leaf, at);
        },
        [&](const Instance& in, const Frame& at, size_t) {
          return !file_.failed() && enter(in, at);
        });
  }
  endElement();
  if (builds_) closeBuilding(known);
}

Result<WriteReport> IfcWriter::write() {
  writeHead();
  for (uint32_t r = 0; r < scene_.roots.size() && !file_.failed(); ++r) {
    work();
    if (!scene_.prototypes[scene_.roots[r].instance.prototype].empty) writeRoot(r);
  }
  // Numbers of no shape.
  rootNumber_ = ~uint64_t{0};
  guids_ = 0;
  relate("IFCRELAGGREGATES", site_, buildings_);
  relate("IFCRELCONTAINEDINSPATIALSTRUCTURE", site_, siteElements_);
  for (const auto& [material, elements] : elementsOf_) {
    const StepId of = shapes_->material(material);
    if (!of) continue;
    file_.add("IFCRELASSOCIATESMATERIAL(" + guid() + ",$,$,$," + stepList(elements) + "," +
              stepRef(of) + ")");
  }
  file_.raw("ENDSEC;\nEND-ISO-10303-21;\n");
  tellProxies();
  for (const std::string& word : kinds_.unknownWords()) {
    report_.warnings.push_back("'" + word +
                               "' is no cityPart: the parts that say so are taken for " +
                               "what their names say; docs/guide/city-models.md lists the words");
  }
  const Result<uint64_t> bytes = file_.finish();
  if (!bytes.ok()) return bytes.error();
  report_.bytes = bytes.value();
  report_.files = {path_};
  return report_;
}

}  // namespace

Result<WriteReport> writeIfc(const Scene& scene, const std::string& path,
                             const WriteOptions& options) {
  return IfcWriter(scene, path, options).write();
}

}  // namespace gable
