// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/shape_parts.h"

#include <algorithm>

#include "base/files.h"
#include "base/work.h"
#include "io/importers/face_filter.h"
#include "io/importers/geojson_edges.h"

namespace gable {

std::string stemOf(const std::string& path) {
  const std::string name = fileNameOf(path);
  return name.substr(0,
                     name.size() - (extensionOf(name).empty() ? 0 : extensionOf(name).size() + 1));
}

Error emptyShapes(const std::string& path) {
  return {"shapes-empty", "'" + path + "' has no polygon that could be an initial shape", {}};
}

void noteDropped(ShapeFile& out, uint64_t faces) {
  if (faces == 0) return;
  out.diagnostics.warning("shape-face-dropped", {},
                          std::to_string(faces) + " faces without area are left out");
}

void turnFootprintsUp(ShapeFile& out) {
  constexpr double kLevel = 0.99;
  size_t turned = 0;
  for (ShapeInput& shape : out.shapes) {
    bool down = shape.mesh.faceCount() > 0;
    for (size_t f = 0; down && f < shape.mesh.faceCount(); ++f) {
      down = shape.mesh.normal(f).y < -kLevel;
    }
    if (!down) continue;
    MeshBuilder builder;
    std::vector<uint32_t> map(shape.mesh.positions.size(), MeshBuilder::kNoPosition);
    for (size_t f = 0; f < shape.mesh.faceCount(); ++f) {
      work();
      builder.copyFace(shape.mesh, f, map, true);
    }
    shape.mesh = builder.take();
    ++turned;
  }
  if (turned == 0) return;
  out.diagnostics.warning("shape-turned", {},
                          std::to_string(turned) +
                              (turned == 1 ? " footprint faces" : " footprints face") +
                              " the ground and " + (turned == 1 ? "is" : "are") + " turned over",
                          "write the corners counter-clockwise as seen from above");
}

void takeMaterials(ShapeInput& shape, Asset part) {
  divideSlots(shape.mesh, part);
  const Material plain;
  const bool looks = std::any_of(part.materials.begin(), part.materials.end(),
                                 [&](const Material& m) { return m != plain; });
  if (!looks && part.slotGroups.empty()) {
    for (MeshFace& f : shape.mesh.faces) f.materialSlot = 0;
    return;
  }
  for (MeshFace& f : shape.mesh.faces) f.materialSlot = static_cast<uint16_t>(f.materialSlot + 1);
  shape.materials = std::move(part.materials);
  shape.groups = std::move(part.slotGroups);
}

void addAttribute(const JsonValue::Member& member, ShapeInput& shape) {
  const JsonValue& v = member.second;
  AttributeValue a;
  a.name = member.first;
  std::replace_if(
      a.name.begin(), a.name.end(), [](char c) { return c == ':' || c == '-' || c == ' '; }, '_');
  if (isPlainValue(v)) {
    a.values.push_back(plainValue(v));
  } else if (v.isArray() && v.size() > 0) {
    const JsonValue::Kind kind = v.at(0).kind();
    const bool alike = std::all_of(v.items().begin(), v.items().end(), [&](const JsonValue& e) {
      return isPlainValue(e) && e.kind() == kind;
    });
    if (!alike) return;
    for (const JsonValue& e : v.items()) a.values.push_back(plainValue(e));
    a.rows = 1;
    a.columns = static_cast<uint32_t>(v.size());
  } else {
    return;
  }
  shape.attributes.push_back(std::move(a));
}

}  // namespace gable
