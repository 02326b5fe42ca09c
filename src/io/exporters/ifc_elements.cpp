// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/ifc_elements.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/hash.h"
#include "base/number.h"
#include "base/work.h"
#include "io/exporters/city_faces.h"
#include "io/exporters/step_text.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// Points of a shape, a metre.
constexpr double kSteps = 1e5;
constexpr int kDecimals = 5;
// What IFC allows of a label.
constexpr size_t kMostLabel = 255;

Vec3 upright(const Vec3& p) { return {p.x, -p.z, p.y}; }

double part(double v) { return std::isfinite(v) ? std::clamp(v, 0.0, 1.0) : 0.0; }

std::string tripleText(const Vec3& v, int decimals) {
  std::string out = "(";
  for (size_t a = 0; a < 3; ++a) {
    if (a > 0) out += ',';
    appendStepReal(out, v[a], decimals);
  }
  return out + ")";
}

std::string valueText(const PlainValue& v) {
  switch (v.kind) {
    case PlainValue::Kind::Number: return "IFCREAL(" + stepReal(v.number) + ")";
    case PlainValue::Kind::Bool: return v.number != 0 ? "IFCBOOLEAN(.T.)" : "IFCBOOLEAN(.F.)";
    case PlainValue::Kind::Text: break;
  }
  return (v.text.size() > kMostLabel ? "IFCTEXT(" : "IFCLABEL(") + stepText(v.text) + ")";
}

bool hasArea(const std::array<int64_t, 3>& a, const std::array<int64_t, 3>& b,
             const std::array<int64_t, 3>& c) {
  const auto between = [](const std::array<int64_t, 3>& p, const std::array<int64_t, 3>& q) {
    return Vec3{static_cast<double>(q[0] - p[0]), static_cast<double>(q[1] - p[1]),
                static_cast<double>(q[2] - p[2])};
  };
  const Vec3 normal = cross(between(a, b), between(a, c));
  return dot(normal, normal) > 0;
}

}  // namespace

StepId StepFile::add(const std::string& text) {
  const StepId id = reserve();
  put(id, text);
  return id;
}

void StepFile::put(StepId id, const std::string& text) {
  char number[kNumberRoom];
  const char* end = writeInteger(number, id);
  out_.append("#", 1);
  out_.append(number, static_cast<size_t>(end - number));
  out_.append("=", 1);
  out_.append(text);
  out_.append(";\n", 2);
}

std::string stepRef(StepId id) { return "#" + std::to_string(id); }

std::string stepList(const std::vector<StepId>& ids) {
  std::string out = "(";
  for (const StepId id : ids) {
    work();
    out += (out.size() > 1 ? ",#" : "#") + std::to_string(id);
  }
  return out + ")";
}

void IfcShape::add(const Leaf& leaf, const Frame& world) {
  const Mesh& m = *scene_.meshes[leaf.mesh];
  work(m.corners.size() + 1);
  placed_.resize(m.positions.size());
  for (size_t i = 0; i < placed_.size(); ++i) {
    placed_[i] = upright(world.point(scaled(m.positions[i], leaf.scale)));
  }
  const bool turn = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
  const MeshTriangles& t = triangles_.of(leaf.mesh);
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const size_t first = f ? t.faceEnds[f - 1] : 0;
    if (first == t.faceEnds[f]) continue;
    Part& to = parts_[materialIndexOf(scene_, leaf, m.faces[f].materialSlot)];
    for (size_t i = first; i < t.faceEnds[f]; ++i) {
      std::array<std::array<int64_t, 3>, 3> at{};
      bool near = true;
      for (size_t k = 0; k < 3; ++k) {
        const Vec3& p = placed_[m.corners[t.triangles[i][turn ? 2 - k : k]]];
        for (size_t a = 0; a < 3; ++a) {
          near = near && std::fabs(p[a]) < kFarthestCity;
          at[k][a] = near ? std::llround(p[a] * kSteps) : 0;
        }
      }
      if (!near || !hasArea(at[0], at[1], at[2])) continue;
      std::array<uint32_t, 3> corners{};
      for (size_t k = 0; k < 3; ++k) {
        const auto [known, isNew] =
            to.known.try_emplace(at[k], static_cast<uint32_t>(to.points.size()));
        if (isNew) to.points.push_back(at[k]);
        corners[k] = known->second;
        box_.include(Vec3{static_cast<double>(at[k][0]), static_cast<double>(at[k][1]),
                          static_cast<double>(at[k][2])} *
                     (1 / kSteps));
      }
      to.triangles.push_back(corners);
      ++count_;
    }
  }
}

std::array<uint64_t, 2> IfcShape::hash() const {
  std::array<uint64_t, 2> h{1, 2};
  const auto fold = [&](uint64_t value) {
    for (uint64_t& each : h) each = hashCombine(each, value);
  };
  for (const auto& [material, part] : parts_) {
    if (part.triangles.empty()) continue;
    work(part.points.size() + part.triangles.size());
    fold(material);
    fold(part.points.size());
    for (const auto& p : part.points) {
      for (const int64_t c : p) fold(static_cast<uint64_t>(c));
    }
    fold(part.triangles.size());
    for (const auto& t : part.triangles) {
      for (const uint32_t c : t) fold(c);
    }
  }
  return h;
}

void IfcShape::clear() {
  parts_.clear();
  box_ = Box3{};
  count_ = 0;
}

StepId IfcShapeWriter::faceSet(const IfcShape::Part& shape) {
  std::string text = "IFCCARTESIANPOINTLIST3D((";
  for (size_t i = 0; i < shape.points.size(); ++i) {
    work();
    text += i ? ",(" : "(";
    for (size_t a = 0; a < 3; ++a) {
      if (a > 0) text += ',';
      appendStepReal(text, static_cast<double>(shape.points[i][a]) / kSteps, kDecimals);
    }
    text += ')';
  }
  const StepId points = file_.add(text + "))");
  text = "IFCTRIANGULATEDFACESET(" + stepRef(points) + ",$,$,(";
  for (size_t i = 0; i < shape.triangles.size(); ++i) {
    work();
    text += i ? ",(" : "(";
    for (size_t k = 0; k < 3; ++k) {
      if (k > 0) text += ',';
      text += std::to_string(shape.triangles[i][k] + 1);
    }
    text += ')';
  }
  return file_.add(text + "),$)");
}

StepId IfcShapeWriter::style(uint32_t number) {
  StepId& known = styles_[number];
  if (known || number >= scene_.materials.size()) return known;
  const Material& m = scene_.materials[number];
  std::string color = "IFCCOLOURRGB($";
  for (size_t i = 0; i < 3; ++i) color += "," + stepReal(part(m.color[i]));
  const StepId rgb = file_.add(color + ")");
  const StepId shading = file_.add("IFCSURFACESTYLESHADING(" + stepRef(rgb) + "," +
                                   stepReal(part(1 - m.opacity)) + ")");
  const std::string name = m.name.empty() ? "material " + std::to_string(number) : m.name;
  return known = file_.add("IFCSURFACESTYLE(" + stepText(name, kMostLabel) + ",.BOTH.,(" +
                           stepRef(shading) + "))");
}

StepId IfcShapeWriter::material(uint32_t number) {
  StepId& known = materials_[number];
  if (known || number >= scene_.materials.size()) return known;
  const Material& m = scene_.materials[number];
  const std::string name = m.name.empty() ? "material " + std::to_string(number) : m.name;
  return known = file_.add("IFCMATERIAL(" + stepText(name, kMostLabel) + ",$,$)");
}

StepId IfcShapeWriter::representation(const IfcShape& shape) {
  std::vector<StepId> sets;
  for (const auto& [material, triangles] : shape.parts()) {
    if (triangles.triangles.empty()) continue;
    sets.push_back(faceSet(triangles));
    const StepId look = style(material);
    if (look) {
      file_.add("IFCSTYLEDITEM(" + stepRef(sets.back()) + ",(" + stepRef(look) + "),$)");
    }
  }
  return file_.add("IFCSHAPEREPRESENTATION(" + stepRef(body_) + ",'Body','Tessellation'," +
                   stepList(sets) + ")");
}

StepId IfcShapeWriter::definition(const IfcShape& shape) {
  StepId& known = definitions_[shape.hash()];
  if (!known) {
    known = file_.add("IFCPRODUCTDEFINITIONSHAPE($,$,(" + stepRef(representation(shape)) + "))");
  }
  return known;
}

StepId IfcAxesWriter::direction(const Vec3& v) {
  constexpr int kOfDirections = 9;
  constexpr size_t kMostKept = 4096;
  const std::string text = tripleText(upright(v), kOfDirections);
  if (directions_.size() >= kMostKept) directions_.clear();
  StepId& known = directions_[text];
  if (!known) known = file_.add("IFCDIRECTION(" + text + ")");
  return known;
}

StepId IfcAxesWriter::axes(const Frame& frame) {
  const StepId at =
      file_.add("IFCCARTESIANPOINT(" + tripleText(upright(frame.origin), kDecimals) + ")");
  if (!frame.turned) return file_.add("IFCAXIS2PLACEMENT3D(" + stepRef(at) + ",$,$)");
  // The z axis of what stands upright is y here.
  const StepId z = direction(frame.y), x = direction(frame.x);
  return file_.add("IFCAXIS2PLACEMENT3D(" + stepRef(at) + "," + stepRef(z) + "," + stepRef(x) +
                   ")");
}

StepId ifcProperties(StepFile& file, const std::string& guid,
                     const std::vector<AttributeValue>& attributes) {
  std::vector<StepId> all;
  std::set<std::string> said;
  for (const AttributeValue& a : attributes) {
    if (a.values.empty() || a.name.empty() || !said.insert(a.name).second) continue;
    const std::string name = stepText(a.name, kMostLabel);
    if (a.rows == 0 && a.columns == 0) {
      all.push_back(
          file.add("IFCPROPERTYSINGLEVALUE(" + name + ",$," + valueText(a.values[0]) + ",$)"));
      continue;
    }
    std::string list;
    for (const PlainValue& v : a.values) {
      work();
      list += (list.empty() ? "" : ",") + valueText(v);
    }
    all.push_back(file.add("IFCPROPERTYLISTVALUE(" + name + ",$,(" + list + "),$)"));
  }
  if (all.empty()) return 0;
  return file.add("IFCPROPERTYSET('" + guid + "',$,'Gable',$," + stepList(all) + ")");
}

}  // namespace gable
