// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cmath>

#include "gable/names.h"
#include "gable/writing.h"
#include "watched.h"

namespace gable::python {

namespace {

const char* endName(End end) {
  switch (end) {
    case End::LimitReached: return "limit";
    case End::Cancelled: return "cancelled";
    case End::Done: break;
  }
  return "done";
}

py::dict materialOf(const MaterialInfo& m) {
  py::dict d;
  d["name"] = m.name;
  d["color"] = m.color;
  d["opacity"] = m.opacity;
  d["roughness"] = m.roughness;
  d["metallic"] = m.metallic;
  d["emissive"] = m.emissive;
  py::dict textures;
  for (const auto& [layer, path] : m.textures) textures[py::str(layer)] = path;
  d["textures"] = textures;
  return d;
}

py::list materialsOf(const std::vector<MaterialInfo>& materials) {
  py::list out;
  for (const MaterialInfo& m : materials) out.append(materialOf(m));
  return out;
}

// Vertices of a leaf in the world, added to the arrays of the whole model.
struct Flat {
  std::vector<double> positions;
  std::vector<float> normals, uvs;
  std::vector<uint32_t> triangles, material, leaf;

  void add(const TriangleMesh& mesh, const PlacedMesh& placed, uint32_t number) {
    const auto first = static_cast<uint32_t>(positions.size() / 3);
    const auto& t = placed.transform;
    for (size_t v = 0; v + 2 < mesh.positions.size(); v += 3) {
      const double* p = &mesh.positions[v];
      for (size_t k = 0; k < 3; ++k)
        positions.push_back(t[k] + t[3 + k] * p[0] + t[6 + k] * p[1] + t[9 + k] * p[2]);
    }
    addNormals(mesh, t);
    uvs.resize(positions.size() / 3 * 2, 0);
    std::copy(mesh.uvs.begin(), mesh.uvs.end(), uvs.begin() + first * size_t{2});
    const bool mirrors = determinant(t) < 0;
    for (const TriangleMesh::Part& part : mesh.parts) {
      const uint32_t slot = part.slot < placed.materials.size() ? part.slot : 0;
      for (uint32_t i = 0; i < part.triangleCount; ++i) {
        const uint32_t* corner = &mesh.triangles[size_t{3} * (part.firstTriangle + i)];
        triangles.push_back(first + corner[0]);
        triangles.push_back(first + corner[mirrors ? 2 : 1]);
        triangles.push_back(first + corner[mirrors ? 1 : 2]);
        material.push_back(placed.materials.empty() ? 0 : placed.materials[slot]);
        leaf.push_back(number);
      }
    }
  }

 private:
  static double determinant(const std::array<double, 12>& t) {
    return t[3] * (t[7] * t[11] - t[8] * t[10]) - t[4] * (t[6] * t[11] - t[8] * t[9]) +
           t[5] * (t[6] * t[10] - t[7] * t[9]);
  }
  // By the cofactors, which are the inverse transposed but for a factor.
  void addNormals(const TriangleMesh& mesh, const std::array<double, 12>& t) {
    const double* c[3] = {&t[3], &t[6], &t[9]};
    const double sign = determinant(t) < 0 ? -1 : 1;
    double m[3][3];
    for (int i = 0; i < 3; ++i) {
      const double* a = c[(i + 1) % 3];
      const double* b = c[(i + 2) % 3];
      m[i][0] = sign * (a[1] * b[2] - a[2] * b[1]);
      m[i][1] = sign * (a[2] * b[0] - a[0] * b[2]);
      m[i][2] = sign * (a[0] * b[1] - a[1] * b[0]);
    }
    for (size_t v = 0; v + 2 < mesh.normals.size(); v += 3) {
      const float* n = &mesh.normals[v];
      double out[3];
      for (int k = 0; k < 3; ++k) out[k] = m[0][k] * n[0] + m[1][k] * n[1] + m[2][k] * n[2];
      const double length = std::sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
      for (double k : out) normals.push_back(static_cast<float>(length > 0 ? k / length : 0));
    }
  }
};

py::dict flatOf(const Model& model, uint64_t mostLeaves) {
  Flat flat;
  ModelGeometry g;
  {
    const py::gil_scoped_release released;
    g = model.geometry(mostLeaves);
    for (size_t i = 0; i < g.leaves.size(); ++i)
      flat.add(g.meshes[g.leaves[i].mesh], g.leaves[i], static_cast<uint32_t>(i));
  }
  py::dict d;
  d["positions"] = arrayOf(std::move(flat.positions), 3);
  d["normals"] = arrayOf(std::move(flat.normals), 3);
  d["uvs"] = arrayOf(std::move(flat.uvs), 2);
  d["triangles"] = arrayOf(std::move(flat.triangles), 3);
  d["material"] = arrayOf(std::move(flat.material));
  d["leaf"] = arrayOf(std::move(flat.leaf));
  d["materials"] = materialsOf(g.materials);
  return d;
}

py::dict partsOf(const Model& model, uint64_t mostLeaves) {
  ModelGeometry g;
  {
    const py::gil_scoped_release released;
    g = model.geometry(mostLeaves);
  }
  py::list meshes;
  for (TriangleMesh& mesh : g.meshes) {
    std::vector<uint32_t> slots;
    for (const TriangleMesh::Part& part : mesh.parts)
      slots.insert(slots.end(), part.triangleCount, part.slot);
    py::dict one;
    one["positions"] = arrayOf(std::move(mesh.positions), 3);
    one["normals"] = arrayOf(std::move(mesh.normals), 3);
    one["uvs"] = arrayOf(std::move(mesh.uvs), 2);
    one["triangles"] = arrayOf(std::move(mesh.triangles), 3);
    one["slot"] = arrayOf(std::move(slots));
    meshes.append(std::move(one));
  }
  std::vector<double> transforms;
  std::vector<uint32_t> mesh, name, material;
  for (const PlacedMesh& leaf : g.leaves) {
    transforms.insert(transforms.end(), leaf.transform.begin(), leaf.transform.end());
    mesh.push_back(leaf.mesh);
    name.push_back(leaf.name);
    material.push_back(leaf.materials.empty() ? 0 : leaf.materials[0]);
  }
  py::dict d;
  d["meshes"] = meshes;
  d["materials"] = materialsOf(g.materials);
  d["names"] = g.names;
  d["mesh"] = arrayOf(std::move(mesh));
  d["name"] = arrayOf(std::move(name));
  d["material"] = arrayOf(std::move(material));
  d["transform"] = arrayOf(std::move(transforms), 12);
  return d;
}

py::object leafOf(const Model& model, uint64_t number) {
  const std::optional<LeafInfo> leaf = model.leaf(number);
  if (!leaf) return py::none();
  py::dict d;
  d["name"] = leaf->name;
  d["rule"] = leaf->source ? py::object(py::str(leaf->source->rule)) : py::none();
  d["file"] = leaf->source ? py::object(py::str(leaf->source->file)) : py::none();
  d["line"] = leaf->source ? py::object(py::int_(leaf->source->line)) : py::none();
  d["faces"] = leaf->faces;
  d["vertices"] = leaf->vertices;
  d["color"] = leaf->material.color;
  d["material"] = leaf->material.name;
  d["size"] = leaf->size;
  py::dict attributes;
  for (const NamedValue& a : leaf->attributes) attributes[py::str(a.name)] = objectOf(a.value);
  d["attributes"] = attributes;
  return d;
}

py::dict statisticsOf(const Model& model) {
  const Statistics s = model.statistics();
  py::dict d;
  d["shapes"] = s.shapes;
  d["leaves"] = s.leaves;
  d["faces"] = s.faces;
  d["vertices"] = s.vertices;
  d["triangles"] = s.triangles;
  d["instances"] = s.instances;
  d["prototypes"] = s.prototypes;
  d["materials"] = s.materials;
  d["seconds"] = model.deriveSeconds();
  if (s.bounds)
    d["bounds"] = py::make_tuple(py::cast(s.bounds->min), py::cast(s.bounds->max));
  else
    d["bounds"] = py::none();
  return d;
}

py::dict reportsOf(const std::vector<ReportSummary>& reports) {
  py::dict out;
  for (const ReportSummary& r : reports) {
    py::dict d;
    d["count"] = r.count;
    if (r.numbers) {
      uint64_t texts = 0;
      for (const auto& [text, count] : r.values) texts += count;
      d["sum"] = r.numbers->sum;
      d["min"] = r.numbers->min;
      d["max"] = r.numbers->max;
      d["mean"] = r.numbers->sum / static_cast<double>(r.count - texts);
    }
    py::dict values;
    for (const auto& [text, count] : r.values) values[py::str(text)] = count;
    d["values"] = values;
    out[py::str(r.key)] = d;
  }
  return out;
}

py::tuple resultOf(const WriteResult& r) {
  return py::make_tuple(r.ok, messagesOf(r.diagnostics), r.bytes);
}

// Throws a ValueError for what there is not.
WriteSettings settingsOf(const std::string& profile, const WriteChoices& options) {
  const ChosenWriting chosen = chosenWriting(profile, options);
  if (!chosen.ok) throw py::value_error(render(chosen.diagnostics));
  return chosen.settings;
}

py::tuple written(const Model& model, const std::string& path, const std::string& profile,
                  const WriteChoices& options) {
  Watched watched;
  WriteSettings settings = settingsOf(profile, options);
  settings.limits.cancel = &watched.cancel;
  return resultOf(watch(watched, py::none(), [&] { return model.write(path, settings); }));
}

py::tuple encoded(const Model& model, const std::string& format, const std::string& profile,
                  const WriteChoices& options) {
  Watched watched;
  WriteSettings settings = settingsOf(profile, options);
  settings.limits.cancel = &watched.cancel;
  const EncodeResult result =
      watch(watched, py::none(), [&] { return model.encode(format, settings); });
  return py::make_tuple(result.ok, messagesOf(result.diagnostics), py::bytes(result.bytes));
}

// Words have been checked. Ctrl-C ends it without a picture.
py::tuple pictured(const Model& model, const std::string& path, const std::string& view,
                   const std::string& style, const std::string& lighting, int width, int height,
                   int samples, std::optional<std::pair<double, double>> sun,
                   std::optional<std::pair<Triple, Triple>> camera,
                   std::optional<double> fieldOfView, const py::object& progress) {
  Watched watched;
  PictureSettings s;
  s.view = viewNamed(view).value_or(s.view);
  s.look = lookNamed(style).value_or(s.look);
  s.lighting = lightingNamed(lighting).value_or(s.lighting);
  s.width = width;
  s.height = height;
  s.samples = samples;
  if (sun) s.sun = PictureSettings::Sun{sun->first, sun->second};
  if (camera) s.camera = PictureSettings::Camera{camera->first, camera->second};
  s.fieldOfView = fieldOfView;
  s.limits.cancel = &watched.cancel;
  s.progress = [&](size_t done, size_t total) {
    watched.total = total;
    watched.done = done;
  };
  return resultOf(watch(watched, progress, [&] { return model.picture(path, s); }));
}

}  // namespace

void bindModel(py::module_& m) {
  py::class_<Model>(m, "Model")
      .def_static("load",
                  [](const std::string& path) {
                    const py::gil_scoped_release released;
                    return Model::load(path);
                  })
      .def("ok", &Model::ok)
      .def("end", [](const Model& model) { return endName(model.end()); })
      .def("messages", [](const Model& model) { return messagesOf(model.diagnostics()); })
      .def("statistics", &statisticsOf)
      .def("reports", [](const Model& model) { return reportsOf(model.statistics().reports); })
      .def("reports_by_shape",
           [](const Model& model) {
             py::list out;
             for (const ShapeReports& s : model.reportsByShape()) {
               out.append(py::make_tuple(s.name, s.id, reportsOf(s.reports)));
             }
             return out;
           })
      .def("attributes",
           [](const Model& model, size_t shape) {
             py::dict d;
             for (const NamedValue& a : model.attributes(shape))
               d[py::str(a.name)] = objectOf(a.value);
             return d;
           })
      .def("prints", &Model::prints)
      .def("dump", &Model::dump)
      .def("leaf_count", &Model::leafCount)
      .def("leaf", &leafOf)
      .def("flat", &flatOf)
      .def("parts", &partsOf)
      .def("write", &written)
      .def("encode", &encoded)
      .def("picture", &pictured);
}

}  // namespace gable::python
