// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "io/image/image.h"
#include "io/importers/base64.h"
#include "io/uri.h"
#include "material/linear_light.h"
#include "math/trig.h"

namespace gable {
namespace {

double unit(double v) { return v >= 0 ? std::min(v, 1.0) : 0; }

Vec3 colorOf(const JsonValue& v, const Vec3& fallback) {
  if (v.size() < 3) return fallback;
  return srgbOf(Vec3{v.at(0).number(0), v.at(1).number(0), v.at(2).number(0)});
}

class Reader {
 public:
  Reader(const GltfFile& file, const AssetOptions& options, Asset& asset)
      : file_(file), options_(options), asset_(asset) {
    for (size_t i = 0; i < file.json()["images"].size(); ++i) images_.push_back(pathOfImage(i));
  }

  GltfMaterial read(const JsonValue& m) {
    work();
    GltfMaterial out;
    out.texcoords.fill(-1);
    Material& to = out.material;
    to.name = m["name"].text();
    const JsonValue& pbr = m["pbrMetallicRoughness"];
    to.color = colorOf(pbr["baseColorFactor"], {1, 1, 1});
    const double alpha = unit(pbr["baseColorFactor"].at(3).number(1));
    to.metallic = unit(pbr["metallicFactor"].number(1));
    to.roughness = unit(pbr["roughnessFactor"].number(1));
    to.emissive = colorOf(m["emissiveFactor"], {});
    to.doubleSided = m["doubleSided"].boolean(false);
    to.shader = "CityEnginePBRShader";
    map(out, TextureLayer::Color, pbr["baseColorTexture"]);
    map(out, TextureLayer::Roughness, pbr["metallicRoughnessTexture"]);
    map(out, TextureLayer::Metallic, pbr["metallicRoughnessTexture"]);
    map(out, TextureLayer::Normal, m["normalTexture"]);
    map(out, TextureLayer::Occlusion, m["occlusionTexture"]);
    map(out, TextureLayer::Emissive, m["emissiveTexture"]);
    const std::string& mode = m["alphaMode"].text();
    if (mode == "BLEND" || mode == "MASK") {
      to.opacityMode = mode == "MASK" ? OpacityMode::Mask : OpacityMode::Blend;
      to.opacityCutoff = unit(m["alphaCutoff"].number(0.5));
      to.opacity = alpha;
      map(out, TextureLayer::Opacity, pbr["baseColorTexture"]);
    } else {
      to.opacityMode = OpacityMode::Opaque;
    }
    return out;
  }

 private:
  // Where the picture lies: a project path, or a name of ours for one inside the file.
  std::string pathOfImage(size_t i) {
    work();
    const JsonValue& image = file_.json()["images"].at(i);
    const JsonValue* uri = image.find("uri");
    std::string mime, bytes;
    if (uri && !readDataUri(uri->text(), mime, bytes)) {
      return relativeTo(options_.path, pathOf(uri->text()));
    }
    if (!uri) bytes = file_.view(GltfFile::index(image["bufferView"]));
    const ImageFormat format = imageFormat(bytes);
    if (format == ImageFormat::Unknown) {
      asset_.warnings.push_back("picture " + std::to_string(i) +
                                " is of no format that can be read");
      return {};
    }
    held_ += bytes.size();
    if (held_ > kMostHeld) {
      asset_.warnings.push_back("picture " + std::to_string(i) +
                                " is left out: there are too many");
      return {};
    }
    const std::string name = options_.path + "#" + std::to_string(i) + extensionOf(format);
    asset_.textures[name] = std::move(bytes);
    return name;
  }

  void map(GltfMaterial& out, TextureLayer layer, const JsonValue& info) {
    const size_t texture = GltfFile::index(info["index"]);
    const JsonValue& entry = file_.json()["textures"].at(texture);
    size_t image = GltfFile::index(entry["source"]);
    const JsonValue& webp = entry["extensions"]["EXT_texture_webp"];
    if (image >= images_.size()) image = GltfFile::index(webp["source"]);
    if (image >= images_.size() || images_[image].empty()) return;
    TextureMap& t = out.material.map(layer);
    t.path = images_[image];
    size_t set = info.find("texCoord") ? GltfFile::index(info["texCoord"]) : 0;
    const JsonValue& transform = info["extensions"]["KHR_texture_transform"];
    if (transform.isObject()) {
      if (transform.find("texCoord")) set = GltfFile::index(transform["texCoord"]);
      t.su = transform["scale"].at(0).number(1);
      t.sv = transform["scale"].at(1).number(1);
      t.rw = toDegrees(transform["rotation"].number(0));
      // The exporter's substitution, solved for our shift.
      t.tu = transform["offset"].at(0).number(0) + sinDeg(t.rw) * t.sv;
      t.tv = 1 - transform["offset"].at(1).number(0) - cosDeg(t.rw) * t.sv;
    }
    out.texcoords[static_cast<size_t>(layer)] = static_cast<int>(std::min<size_t>(set, 100));
  }

  const GltfFile& file_;
  const AssetOptions& options_;
  Asset& asset_;
  std::vector<std::string> images_;
  // A small file can name the same bytes as a picture many times.
  static constexpr uint64_t kMostHeld = 1ULL << 29;
  uint64_t held_ = 0;
};

}  // namespace

std::vector<GltfMaterial> readGltfMaterials(const GltfFile& file, const AssetOptions& options,
                                            Asset& asset) {
  Reader reader(file, options, asset);
  std::vector<GltfMaterial> all;
  for (const JsonValue& m : file.json()["materials"].items()) all.push_back(reader.read(m));
  return all;
}

}  // namespace gable
