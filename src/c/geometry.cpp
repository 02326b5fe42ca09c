// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "c/object.h"

using namespace gable::c;

namespace {

using gable::MaterialInfo;
using gable::ModelGeometry;
using gable::PlacedMesh;
using gable::TriangleMesh;

template <class Work>
gable_status withMesh(const gable_geometry* geometry, size_t index, Work&& work) {
  return with<GeometryObject>(geometry, [&](const ModelGeometry& g) {
    const TriangleMesh* m = at(g.meshes, index);
    return m ? work(*m) : noSuchIndex();
  });
}

template <class Work>
gable_status withLeaf(const gable_geometry* geometry, size_t index, Work&& work) {
  return with<GeometryObject>(geometry, [&](const ModelGeometry& g) {
    const PlacedMesh* leaf = at(g.leaves, index);
    return leaf ? work(g, *leaf) : noSuchIndex();
  });
}

template <class Work>
gable_status withMaterial(const gable_geometry* geometry, size_t index, Work&& work) {
  return with<GeometryObject>(geometry, [&](const ModelGeometry& g) {
    const MaterialInfo* m = at(g.materials, index);
    return m ? work(*m) : noSuchIndex();
  });
}

}  // namespace

gable_status gable_model_geometry(const gable_model* model, uint64_t most_leaves,
                                  gable_geometry** geometry) {
  if (geometry) *geometry = nullptr;
  return with<ModelObject>(model, [&](const ModelValue& m) {
    if (!geometry) return nullArgument();
    *geometry = reinterpret_cast<gable_geometry*>(
        new GeometryObject{GeometryObject::kMark, m.model.geometry(most_leaves)});
    return GABLE_OK;
  });
}

gable_status gable_geometry_count(const gable_geometry* geometry, gable_geometry_counts* counts) {
  return with<GeometryObject>(geometry, [&](const ModelGeometry& g) {
    gable_geometry_counts out{};
    out.meshes = g.meshes.size();
    out.materials = g.materials.size();
    out.leaves = g.leaves.size();
    return giveStruct(out, counts);
  });
}

gable_status gable_geometry_mesh(const gable_geometry* geometry, size_t mesh, gable_mesh* info) {
  return withMesh(geometry, mesh, [&](const TriangleMesh& m) {
    gable_mesh out{};
    out.vertices = m.positions.size() / 3;
    out.triangles = m.triangles.size() / 3;
    out.parts = m.parts.size();
    out.has_uvs = m.uvs.empty() ? 0 : 1;
    return giveStruct(out, info);
  });
}

gable_status gable_mesh_positions(const gable_geometry* geometry, size_t mesh, double* buffer,
                                  size_t capacity, size_t* length) {
  return withMesh(geometry, mesh, [&](const TriangleMesh& m) {
    return giveArray(m.positions.data(), m.positions.size(), buffer, capacity, length);
  });
}

gable_status gable_mesh_normals(const gable_geometry* geometry, size_t mesh, float* buffer,
                                size_t capacity, size_t* length) {
  return withMesh(geometry, mesh, [&](const TriangleMesh& m) {
    return giveArray(m.normals.data(), m.normals.size(), buffer, capacity, length);
  });
}

gable_status gable_mesh_uvs(const gable_geometry* geometry, size_t mesh, float* buffer,
                            size_t capacity, size_t* length) {
  return withMesh(geometry, mesh, [&](const TriangleMesh& m) {
    return giveArray(m.uvs.data(), m.uvs.size(), buffer, capacity, length);
  });
}

gable_status gable_mesh_triangles(const gable_geometry* geometry, size_t mesh, uint32_t* buffer,
                                  size_t capacity, size_t* length) {
  return withMesh(geometry, mesh, [&](const TriangleMesh& m) {
    return giveArray(m.triangles.data(), m.triangles.size(), buffer, capacity, length);
  });
}

gable_status gable_mesh_parts(const gable_geometry* geometry, size_t mesh, uint32_t* buffer,
                              size_t capacity, size_t* length) {
  return withMesh(geometry, mesh, [&](const TriangleMesh& m) {
    std::vector<uint32_t> parts;
    for (const TriangleMesh::Part& p : m.parts) {
      parts.insert(parts.end(), {p.slot, p.firstTriangle, p.triangleCount});
    }
    return giveArray(parts.data(), parts.size(), buffer, capacity, length);
  });
}

gable_status gable_geometry_leaf(const gable_geometry* geometry, size_t leaf, gable_leaf* info) {
  return withLeaf(geometry, leaf, [&](const ModelGeometry&, const PlacedMesh& l) {
    gable_leaf out{};
    out.mesh = l.mesh;
    std::copy(l.transform.begin(), l.transform.end(), out.transform);
    return giveStruct(out, info);
  });
}

gable_status gable_leaf_name(const gable_geometry* geometry, size_t leaf, char* buffer,
                             size_t capacity, size_t* length) {
  return withLeaf(geometry, leaf, [&](const ModelGeometry& g, const PlacedMesh& l) {
    return giveText(g.names[l.name], buffer, capacity, length);
  });
}

gable_status gable_leaf_materials(const gable_geometry* geometry, size_t leaf, uint32_t* buffer,
                                  size_t capacity, size_t* length) {
  return withLeaf(geometry, leaf, [&](const ModelGeometry&, const PlacedMesh& l) {
    return giveArray(l.materials.data(), l.materials.size(), buffer, capacity, length);
  });
}

gable_status gable_geometry_material(const gable_geometry* geometry, size_t material,
                                     gable_material* info) {
  return withMaterial(geometry, material, [&](const MaterialInfo& m) {
    gable_material out{};
    out.opacity = m.opacity;
    out.roughness = m.roughness;
    out.metallic = m.metallic;
    out.textures = m.textures.size();
    return giveStruct(out, info);
  });
}

gable_status gable_material_name(const gable_geometry* geometry, size_t material, char* buffer,
                                 size_t capacity, size_t* length) {
  return withMaterial(geometry, material, [&](const MaterialInfo& m) {
    return giveText(m.name, buffer, capacity, length);
  });
}

gable_status gable_material_color(const gable_geometry* geometry, size_t material, char* buffer,
                                  size_t capacity, size_t* length) {
  return withMaterial(geometry, material, [&](const MaterialInfo& m) {
    return giveText(m.color, buffer, capacity, length);
  });
}

gable_status gable_material_texture_layer(const gable_geometry* geometry, size_t material,
                                          size_t texture, char* buffer, size_t capacity,
                                          size_t* length) {
  return withMaterial(geometry, material, [&](const MaterialInfo& m) {
    const auto* t = at(m.textures, texture);
    return t ? giveText(t->first, buffer, capacity, length) : noSuchIndex();
  });
}

gable_status gable_material_texture_path(const gable_geometry* geometry, size_t material,
                                         size_t texture, char* buffer, size_t capacity,
                                         size_t* length) {
  return withMaterial(geometry, material, [&](const MaterialInfo& m) {
    const auto* t = at(m.textures, texture);
    return t ? giveText(t->second, buffer, capacity, length) : noSuchIndex();
  });
}
