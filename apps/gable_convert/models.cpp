// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Models that Assimp reads, as OBJ with the size of its materials (MTL) and these before it.
// Polygons stay as they are. Each node is a group; coordinates are metres, y is up.
#include "jobs.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

// A name as one line of a text.
std::string lineOf(const char* text) {
  std::string out = text ? text : "";
  for (char& c : out) {
    if (c == '\n' || c == '\r' || c == '\0') c = ' ';
  }
  if (!out.empty() && out.back() == '\\') out.back() = '/';
  return out;
}

void put(std::string& out, const char* word, std::initializer_list<double> numbers) {
  out += word;
  char text[40];
  for (const double v : numbers) {
    std::snprintf(text, sizeof text, " %.9g", std::isfinite(v) ? v : 0.0);
    out += text;
  }
  out += '\n';
}

// Where a picture may lie: what was an absolute path on another machine is the name alone.
std::string pictureOf(const aiString& path) {
  std::string name = lineOf(path.C_Str());
  for (char& c : name) {
    if (c == '\\') c = '/';
  }
  if (name.rfind("file://", 0) == 0) name.erase(0, 7);
  if (name.rfind("./", 0) == 0) name.erase(0, 2);
  const bool absolute = !name.empty() && (name[0] == '/' || (name.size() > 1 && name[1] == ':'));
  return absolute ? name.substr(name.rfind('/') + 1) : name;
}

// Empty for the one that Assimp adds where the file has none.
std::string nameOf(const aiMaterial& m, unsigned number) {
  aiString name;
  const std::string own = m.Get(AI_MATKEY_NAME, name) == AI_SUCCESS ? lineOf(name.C_Str()) : "";
  if (own == AI_DEFAULT_MATERIAL_NAME) return {};
  return own.empty() ? "material" + std::to_string(number) : own;
}

std::string materialsOf(const aiScene& scene) {
  std::string out;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& m = *scene.mMaterials[i];
    const std::string name = nameOf(m, i);
    if (name.empty()) continue;
    out += "newmtl " + name + "\n";
    const auto color = [&](const char* word, const char* key, unsigned type, unsigned index) {
      aiColor4D c;
      if (m.Get(key, type, index, c) == AI_SUCCESS) put(out, word, {c.r, c.g, c.b});
    };
    color("Kd", AI_MATKEY_COLOR_DIFFUSE);
    color("Ka", AI_MATKEY_COLOR_AMBIENT);
    color("Ks", AI_MATKEY_COLOR_SPECULAR);
    color("Ke", AI_MATKEY_COLOR_EMISSIVE);
    float v = 0;
    if (m.Get(AI_MATKEY_OPACITY, v) == AI_SUCCESS && v > 0) put(out, "d", {v});
    if (m.Get(AI_MATKEY_SHININESS, v) == AI_SUCCESS) put(out, "Ns", {v});
    const std::pair<aiTextureType, const char*> maps[] = {
        {aiTextureType_DIFFUSE, "map_Kd"},  {aiTextureType_HEIGHT, "map_bump"},
        {aiTextureType_NORMALS, "norm"},    {aiTextureType_OPACITY, "map_d"},
        {aiTextureType_SPECULAR, "map_Ks"}, {aiTextureType_EMISSIVE, "map_Ke"}};
    for (const auto& [type, word] : maps) {
      aiString path;
      // "*0" is a picture inside the file.
      if (m.GetTexture(type, 0, &path) != AI_SUCCESS || path.length == 0) continue;
      if (path.C_Str()[0] != '*') out += std::string(word) + " " + pictureOf(path) + "\n";
    }
  }
  return out;
}

// An FBX file tells its axes and its unit (1 is a centimetre); Assimp leaves them to us. A COLLADA
// file has been turned and scaled by the reader.
aiMatrix4x4 toMetres(const aiScene& scene, bool fbx) {
  aiMatrix4x4 out;
  if (!fbx || !scene.mMetaData) return out;
  const auto axis = [&](const char* name, int otherwise, aiVector3D& row) {
    int which = otherwise, sign = 1;
    scene.mMetaData->Get(name, which);
    scene.mMetaData->Get(std::string(name) + "Sign", sign);
    row[static_cast<unsigned>(which < 0 || which > 2 ? otherwise : which)] = sign < 0 ? -1.f : 1.f;
  };
  aiVector3D x, y, z;
  axis("CoordAxis", 0, x);
  axis("UpAxis", 1, y);
  axis("FrontAxis", 2, z);
  double unit = 1;
  if (!scene.mMetaData->Get("UnitScaleFactor", unit)) {
    float single = 1;
    if (scene.mMetaData->Get("UnitScaleFactor", single)) unit = single;
  }
  if (!(unit > 0) || !std::isfinite(unit)) unit = 1;
  const float s = static_cast<float>(unit * 0.01);
  return {x.x * s, x.y * s, x.z * s, 0, y.x * s, y.y * s, y.z * s, 0,
          z.x * s, z.y * s, z.z * s, 0, 0,       0,       0,       1};
}

class ObjWriter {
 public:
  explicit ObjWriter(const aiScene& scene) : scene_(scene) {}

  std::string write(const aiMatrix4x4& root) {
    out_ = "mtllib model.mtl\n";
    struct Visit {
      const aiNode* node;
      aiMatrix4x4 around;
    };
    std::vector<Visit> stack{{scene_.mRootNode, root}};
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const aiMatrix4x4 world = visit.around * visit.node->mTransformation;
      const aiNode& n = *visit.node;
      if (n.mNumMeshes > 0) out_ += "g " + groupOf(n) + "\n";
      for (unsigned i = 0; i < n.mNumMeshes; ++i) mesh(*scene_.mMeshes[n.mMeshes[i]], world);
      for (unsigned i = n.mNumChildren; i-- > 0;) stack.push_back({n.mChildren[i], world});
    }
    return std::move(out_);
  }

 private:
  // OBJ ends the name of a group at a blank.
  static std::string groupOf(const aiNode& n) {
    std::string name = lineOf(n.mName.C_Str());
    for (char& c : name) {
      if (c == ' ' || c == '\t') c = '_';
    }
    return name;
  }

  void mesh(const aiMesh& m, const aiMatrix4x4& world) {
    aiMatrix3x3 direction(world);
    const bool mirrors = direction.Determinant() < 0;
    direction.Inverse().Transpose();
    if (m.mMaterialIndex < scene_.mNumMaterials) {
      const std::string name = nameOf(*scene_.mMaterials[m.mMaterialIndex], m.mMaterialIndex);
      if (!name.empty()) out_ += "usemtl " + name + "\n";
    }
    const bool uv = m.HasTextureCoords(0), normals = m.HasNormals();
    for (unsigned i = 0; i < m.mNumVertices; ++i) {
      const aiVector3D p = world * m.mVertices[i];
      put(out_, "v", {p.x, p.y, p.z});
      if (uv) put(out_, "vt", {m.mTextureCoords[0][i].x, m.mTextureCoords[0][i].y});
      if (!normals) continue;
      const aiVector3D n = direction * m.mNormals[i];
      put(out_, "vn", {n.x, n.y, n.z});
    }
    for (unsigned f = 0; f < m.mNumFaces; ++f) {
      const aiFace& face = m.mFaces[f];
      if (face.mNumIndices < 3) continue;
      out_ += 'f';
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned i = face.mIndices[mirrors ? face.mNumIndices - 1 - k : k];
        if (i >= m.mNumVertices) continue;
        // Counted from the last vertex, so that no count of our own is needed.
        const std::string number = std::to_string(static_cast<long>(i) - m.mNumVertices);
        out_ += ' ' + number;
        if (uv || normals) out_ += '/' + (uv ? number : std::string());
        if (normals) out_ += '/' + number;
      }
      out_ += '\n';
    }
  }

  const aiScene& scene_;
  std::string out_;
};

}  // namespace

std::string modelAsObj(const std::string& format, const std::string& bytes) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, format.c_str());
  if (!scene || !scene->mRootNode) throw std::runtime_error(importer.GetErrorString());
  const std::string materials = materialsOf(*scene);
  const std::string model = ObjWriter(*scene).write(toMetres(*scene, format == "fbx"));
  return std::to_string(materials.size()) + "\n" + materials + model;
}
