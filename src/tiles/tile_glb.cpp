// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The buffer of a tile's file is laid out first, so that the JSON before it knows all offsets:
// vertices and indices of each primitive, the columns of the table of features, pictures. Columns
// begin at multiples of eight bytes, as EXT_structural_metadata wants it.
#include <cmath>
#include <cstring>
#include <utility>

#include "base/files.h"
#include "io/gltf_format.h"
#include "tiles/tile_mesh.h"

namespace gable {
namespace {

using namespace gltf;

// Stands in the table where a number is not known.
constexpr float kNoNumber = -1;

struct View {
  uint64_t offset = 0, bytes = 0;
  uint32_t stride = 0;
  int target = 0;
};

class TileWriter {
 public:
  TileWriter(const TileMesh& mesh, const std::string& path) : mesh_(mesh), path_(path) {}

  Result<uint64_t> write() {
    layOut();
    const std::string json = text();
    const uint64_t jsonBytes = (json.size() + 3) / 4 * 4;
    const uint64_t all = kGlbHead + jsonBytes + kGlbChunkHead + bytes_;
    if (all > kGlbLimit) {
      return Error{"model-too-large",
                   "the tile '" + path_ + "' would hold " + std::to_string(all >> 20) +
                       " MiB, but a .glb file ends at 4096 MiB",
                   "make rules that build less on one shape"};
    }
    FileWriter out(path_);
    const auto word = [](uint64_t v) { return static_cast<uint32_t>(v); };
    const uint32_t head[5] = {kGlbMagic, kGlbVersion, word(all), word(jsonBytes), kJsonChunk};
    out.append(head, sizeof head);
    out.append(json);
    out.fill(' ', jsonBytes - json.size());
    const uint32_t chunk[2] = {word(bytes_), kBinaryChunk};
    out.append(chunk, sizeof chunk);
    const uint64_t begin = out.offset();
    size_t view = 0;
    const auto put = [&](const void* data, size_t bytes) {
      out.fill(0, views_[view].offset - (out.offset() - begin));
      out.append(data, bytes);
      ++view;
    };
    for (const TilePrimitive& p : mesh_.primitives) {
      put(p.words.data(), p.words.size() * 4);
      put(p.indices.data(), p.indices.size() * 4);
    }
    for (const std::string& column : columns_) put(column.data(), column.size());
    for (const ModelTexture& t : mesh_.materials->images()) put(t.bytes.data(), t.bytes.size());
    out.fill(0, bytes_ - (out.offset() - begin));
    return out.finish();
  }

 private:
  size_t addView(uint64_t bytes, uint32_t stride, int target) {
    bytes_ = (bytes_ + 7) / 8 * 8;
    views_.push_back({bytes_, bytes, stride, target});
    bytes_ += bytes;
    return views_.size() - 1;
  }

  template <class Get>
  void addTexts(Get get) {
    std::string values, offsets;
    const auto addOffset = [&] {
      const auto at = static_cast<uint32_t>(values.size());
      offsets.append(reinterpret_cast<const char*>(&at), 4);
    };
    for (const TileFeature& f : mesh_.features) {
      addOffset();
      values += get(f);
    }
    addOffset();
    // A view must not be empty.
    if (values.empty()) values.push_back('\0');
    columns_.push_back(std::move(values));
    columns_.push_back(std::move(offsets));
  }

  template <class Get>
  void addNumbers(Get get) {
    std::string values;
    for (size_t i = 0; i < mesh_.features.size(); ++i) {
      const double v = get(i);
      const float f = std::isfinite(v) ? static_cast<float>(v) : kNoNumber;
      values.append(reinterpret_cast<const char*>(&f), 4);
    }
    columns_.push_back(std::move(values));
  }

  void layOut() {
    for (const TilePrimitive& p : mesh_.primitives) {
      addView(p.words.size() * 4, p.floats() * 4, kArrayBuffer);
      addView(p.indices.size() * 4, 0, kElementArrayBuffer);
    }
    firstColumn_ = views_.size();
    if (!mesh_.features.empty()) {
      addTexts([](const TileFeature& f) { return f.id; });
      addTexts([](const TileFeature& f) { return f.shape; });
      addTexts([](const TileFeature& f) { return f.name; });
      addTexts([](const TileFeature& f) { return f.type; });
      addTexts([](const TileFeature& f) { return f.attributes; });
      addNumbers([&](size_t i) { return mesh_.features[i].levels; });
      addNumbers([&](size_t i) { return mesh_.features[i].height; });
    }
    for (const std::string& c : columns_) addView(c.size(), 0, 0);
    firstImage_ = views_.size();
    for (const ModelTexture& t : mesh_.materials->images()) addView(t.bytes.size(), 0, 0);
    bytes_ = (bytes_ + 7) / 8 * 8;
  }

  void writeSchema(JsonWriter& w) const {
    w.key("schema").beginObject().field("id", "gable");
    w.key("classes").beginObject().key("feature").beginObject().key("properties").beginObject();
    const std::pair<const char*, const char*> texts[] = {{"id", "What identifies it in the map"},
                                                         {"shape", "What it is to the rules"},
                                                         {"name", "Its name"},
                                                         {"type", "Its kind, as the map has it"},
                                                         {"attributes", "All attributes, as JSON"}};
    for (const auto& [name, about] : texts) {
      w.key(name).beginObject().field("type", "STRING").field("description", about).endObject();
    }
    const std::pair<const char*, const char*> numbers[] = {
        {"levels", "Storeys"}, {"height", "Metres from its lowest to its highest point"}};
    for (const auto& [name, about] : numbers) {
      w.key(name).beginObject().field("type", "SCALAR").field("componentType", "FLOAT32");
      w.field("noData", kNoNumber).field("description", about).endObject();
    }
    w.endObject().endObject().endObject().endObject();
  }

  void writeTable(JsonWriter& w) const {
    w.key("extensions").beginObject().key("EXT_structural_metadata").beginObject();
    writeSchema(w);
    w.key("propertyTables").beginArray().beginObject().field("class", "feature");
    w.field("count", uint64_t{mesh_.features.size()}).key("properties").beginObject();
    uint64_t view = firstColumn_;
    for (const char* name : {"id", "shape", "name", "type", "attributes"}) {
      w.key(name).beginObject().field("values", view).field("stringOffsets", view + 1).endObject();
      view += 2;
    }
    for (const char* name : {"levels", "height"}) {
      w.key(name).beginObject().field("values", view++).endObject();
    }
    w.endObject().endObject().endArray().endObject().endObject();
  }

  void writeMesh(JsonWriter& w) const {
    w.key("meshes").beginArray().beginObject().key("primitives").beginArray();
    uint64_t accessor = 0;
    for (const TilePrimitive& p : mesh_.primitives) {
      w.beginObject().key("attributes").beginObject();
      w.field("POSITION", accessor).field("NORMAL", accessor + 1).field("COLOR_0", accessor + 2);
      w.field("_FEATURE_ID_0", accessor + 3);
      accessor += 4;
      for (uint32_t i = 0; i < p.uvCount; ++i) {
        w.field("TEXCOORD_" + std::to_string(i), accessor++);
      }
      w.endObject().field("indices", accessor++);
      w.field("material", mesh_.materials->materialOf(p.variant));
      w.key("extensions").beginObject().key("EXT_mesh_features").beginObject();
      w.key("featureIds").beginArray().beginObject();
      w.field("featureCount", uint64_t{mesh_.features.size()});
      w.field("attribute", 0).field("propertyTable", 0).endObject().endArray();
      w.endObject().endObject().endObject();
    }
    w.endArray().endObject().endArray();
  }

  void writeAccessors(JsonWriter& w) const {
    w.key("accessors").beginArray();
    uint64_t view = 0;
    for (const TilePrimitive& p : mesh_.primitives) {
      const auto accessor = [&](uint32_t offset, int component, const char* type) {
        w.beginObject().field("bufferView", view);
        if (offset) w.field("byteOffset", offset);
        w.field("componentType", component).field("count", p.vertexCount()).field("type", type);
        if (component == kUnsignedShort) w.field("normalized", true);
        if (offset == 0) {
          for (const auto& [name, v] : {std::pair{"min", p.min}, std::pair{"max", p.max}}) {
            w.key(name).beginArray().value(v[0]).value(v[1]).value(v[2]).endArray();
          }
        }
        w.endObject();
      };
      accessor(0, kFloat, "VEC3");
      accessor(12, kFloat, "VEC3");
      accessor(24, kUnsignedShort, "VEC4");
      accessor(32, kFloat, "SCALAR");
      for (uint32_t i = 0; i < p.uvCount; ++i) accessor(36 + 8 * i, kFloat, "VEC2");
      w.beginObject().field("bufferView", view + 1).field("componentType", kUnsignedInt);
      w.field("count", uint64_t{p.indices.size()}).field("type", "SCALAR").endObject();
      view += 2;
    }
    w.endArray();
  }

  void writeViews(JsonWriter& w) const {
    w.key("bufferViews").beginArray();
    for (const View& v : views_) {
      w.beginObject().field("buffer", 0).field("byteOffset", v.offset);
      w.field("byteLength", v.bytes);
      if (v.stride) w.field("byteStride", v.stride);
      if (v.target) w.field("target", v.target);
      w.endObject();
    }
    w.endArray();
  }

  void writeImages(JsonWriter& w) const {
    const std::vector<ModelTexture>& images = mesh_.materials->images();
    if (images.empty()) return;
    w.key("images").beginArray();
    for (size_t i = 0; i < images.size(); ++i) {
      w.beginObject().field("name", images[i].name);
      w.field("bufferView", uint64_t{firstImage_ + i}).field("mimeType", images[i].mime);
      w.endObject();
    }
    w.endArray();
  }

  std::string text() const {
    std::string out;
    JsonWriter w(out);
    w.beginObject();
    w.key("asset").beginObject().field("version", "2.0").field("generator", "Gable").endObject();
    w.key("extensionsUsed").beginArray();
    w.value("EXT_mesh_features").value("EXT_structural_metadata");
    if (mesh_.materials->usesTransforms()) w.value("KHR_texture_transform");
    w.endArray();
    writeTable(w);
    w.field("scene", 0).key("scenes").beginArray().beginObject().key("nodes").beginArray();
    w.value(0).endArray().endObject().endArray();
    w.key("nodes").beginArray().beginObject().field("mesh", 0).key("translation").beginArray();
    w.value(mesh_.center.x).value(mesh_.center.y).value(mesh_.center.z).endArray();
    w.endObject().endArray();
    writeMesh(w);
    mesh_.materials->write(w);
    writeImages(w);
    writeAccessors(w);
    writeViews(w);
    w.key("buffers").beginArray().beginObject().field("byteLength", bytes_).endObject().endArray();
    w.endObject();
    return out;
  }

  const TileMesh& mesh_;
  const std::string& path_;
  std::vector<std::string> columns_;
  std::vector<View> views_;
  size_t firstColumn_ = 0, firstImage_ = 0;
  uint64_t bytes_ = 0;
};

}  // namespace

Result<uint64_t> writeTile(const TileMesh& mesh, const std::string& path) {
  return TileWriter(mesh, path).write();
}

}  // namespace gable
