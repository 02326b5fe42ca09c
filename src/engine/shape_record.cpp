// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/shape_record.h"

#include <algorithm>

#include "math/frame_bytes.h"

namespace gable {
namespace {

// A number in memory has room behind it that may hold anything, so fields go one by one.
void write(ByteWriter& w, const Mesh& mesh) {
  w.list(mesh.positions);
  w.list(mesh.corners);
  w.value(uint64_t{mesh.loops.size()});
  for (const MeshLoop& l : mesh.loops) {
    w.value(l.firstCorner);
    w.value(l.cornerCount);
  }
  w.value(uint64_t{mesh.faces.size()});
  for (const MeshFace& f : mesh.faces) {
    w.value(f.firstLoop);
    w.value(f.loopCount);
    w.value(f.materialSlot);
    w.value(static_cast<uint8_t>(f.smooth));
    w.value(f.tags);
  }
  for (const std::vector<Vec2>& uv : mesh.uvs) w.list(uv);
  w.list(mesh.normals);
  w.list(mesh.edgeTags);
  w.list(mesh.vertexTags);
}

void read(ByteReader& r, Mesh& mesh) {
  mesh.positions = r.list<Vec3>();
  mesh.corners = r.list<uint32_t>();
  mesh.loops.resize(r.count(2 * sizeof(uint32_t)));
  for (MeshLoop& l : mesh.loops) {
    l.firstCorner = r.value<uint32_t>();
    l.cornerCount = r.value<uint32_t>();
  }
  mesh.faces.resize(r.count(3 * sizeof(uint32_t)));
  for (MeshFace& f : mesh.faces) {
    f.firstLoop = r.value<uint32_t>();
    f.loopCount = r.value<uint32_t>();
    f.materialSlot = r.value<uint16_t>();
    f.smooth = r.value<uint8_t>() != 0;
    f.tags = r.value<uint32_t>();
  }
  for (std::vector<Vec2>& uv : mesh.uvs) uv = r.list<Vec2>();
  mesh.normals = r.list<Vec3>();
  mesh.edgeTags = r.list<uint32_t>();
  mesh.vertexTags = r.list<uint32_t>();
}

void write(ByteWriter& w, const std::vector<std::string>& texts) {
  w.value(uint64_t{texts.size()});
  for (const std::string& text : texts) w.text(text);
}

std::vector<std::string> readTexts(ByteReader& r) {
  std::vector<std::string> out(r.count(sizeof(uint64_t)));
  for (std::string& text : out) text = r.text();
  return out;
}

void write(ByteWriter& w, const AttributeValue& a) {
  w.text(a.name);
  w.value(a.rows);
  w.value(a.columns);
  w.value(uint64_t{a.values.size()});
  for (const PlainValue& v : a.values) {
    w.value(static_cast<uint8_t>(v.kind));
    w.value(v.number);
    w.text(v.text);
  }
}

AttributeValue readAttribute(ByteReader& r) {
  AttributeValue a;
  a.name = r.text();
  a.rows = r.value<uint32_t>();
  a.columns = r.value<uint32_t>();
  a.values.resize(r.count(2 * sizeof(uint64_t)));
  for (PlainValue& v : a.values) {
    v.kind = static_cast<PlainValue::Kind>(std::min<uint8_t>(r.value<uint8_t>(), 2));
    v.number = r.value<double>();
    v.text = r.text();
  }
  return a;
}

void write(ByteWriter& w, const Material& m) {
  w.text(m.name);
  for (const Vec3& color : {m.color, m.ambient, m.specular, m.emissive}) w.value(color);
  for (const double v : {m.opacity, m.reflectivity, m.shininess, m.bumpValue, m.metallic,
                         m.roughness, m.opacityCutoff}) {
    w.value(v);
  }
  w.value(static_cast<uint8_t>(m.doubleSided));
  w.value(static_cast<uint8_t>(m.opacityMode));
  w.text(m.shader);
  for (const TextureMap& map : m.maps) {
    w.text(map.path);
    for (const double v : {map.su, map.sv, map.tu, map.tv, map.rw}) w.value(v);
  }
}

Material readMaterial(ByteReader& r) {
  Material m;
  m.name = r.text();
  for (Vec3* color : {&m.color, &m.ambient, &m.specular, &m.emissive}) *color = r.value<Vec3>();
  for (double* v : {&m.opacity, &m.reflectivity, &m.shininess, &m.bumpValue, &m.metallic,
                    &m.roughness, &m.opacityCutoff}) {
    *v = r.value<double>();
  }
  m.doubleSided = r.value<uint8_t>() != 0;
  m.opacityMode = static_cast<OpacityMode>(std::min<uint8_t>(r.value<uint8_t>(), 2));
  m.shader = r.text();
  for (TextureMap& map : m.maps) {
    map.path = r.text();
    for (double* v : {&map.su, &map.sv, &map.tu, &map.tv, &map.rw}) *v = r.value<double>();
  }
  return m;
}

}  // namespace

void appendRecord(const ShapeFootprint& f, std::string& out) {
  ByteWriter w(out);
  w.text(f.name);
  w.text(f.id);
  write(w, f.mesh);
  writeFrame(w, f.origin);
  w.value(uint64_t{f.attributes.size()});
  for (const AttributeValue& a : f.attributes) write(w, a);
  write(w, f.faceTags);
  w.value(uint64_t{f.streetWidths.size()});
  for (const double width : f.streetWidths) w.value(width);
  w.value(uint64_t{f.materials.size()});
  for (const Material& m : f.materials) write(w, m);
  write(w, f.groups);
  w.value(f.index);
  w.value(static_cast<uint8_t>(f.reachesImports));
}

// Of what the record says beside the mesh: lists of the size they tell, slots that there are.
bool isSound(const ShapeFootprint& f) {
  const Frame& o = f.origin;
  bool sound = isFinite(o.origin) && isFinite(o.x) && isFinite(o.y) && isFinite(o.z);
  for (const AttributeValue& a : f.attributes) {
    const bool isList = a.rows > 0 || a.columns > 0;
    sound = sound && (!isList || uint64_t{a.rows} * a.columns == a.values.size());
  }
  for (const MeshFace& face : f.mesh.faces) {
    sound = sound && face.materialSlot <= f.materials.size();
  }
  return sound;
}

bool readRecord(ByteReader& r, ShapeFootprint& f) {
  f.name = r.text();
  f.id = r.text();
  read(r, f.mesh);
  f.origin = readFrame(r);
  f.attributes.resize(r.count(sizeof(uint64_t)));
  for (AttributeValue& a : f.attributes) a = readAttribute(r);
  f.faceTags = readTexts(r);
  f.streetWidths.resize(r.count(sizeof(double)));
  for (double& width : f.streetWidths) width = r.value<double>();
  f.materials.resize(r.count(sizeof(Vec3)));
  for (Material& m : f.materials) m = readMaterial(r);
  f.groups = readTexts(r);
  f.index = r.value<int64_t>();
  f.reachesImports = r.value<uint8_t>() != 0;
  return r.ok() && f.mesh.valid() && isSound(f);
}

}  // namespace gable
