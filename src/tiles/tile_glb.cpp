// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pieces of a tile's buffer are made first, so that the JSON before them knows all offsets:
// vertices and indices of each primitive, the columns of the table of features, pictures. Each
// begins at a multiple of eight bytes, as EXT_structural_metadata wants it.
//
// Compressed, the first two kinds lie in views of a second buffer that no file holds
// (EXT_meshopt_compression calls it a fallback), and their extension says where the bytes are.
// Integers for positions (KHR_mesh_quantization) count steps of one size from a corner of the tile.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/bytes.h"
#include "base/files.h"
#include "base/work.h"
#include "io/gltf_format.h"
#include "tiles/compress.h"
#include "tiles/tile_mesh.h"

namespace gable {
namespace {

using namespace gltf;

// Stands in the table where a number is not known.
constexpr float kNoNumber = -1;

constexpr double kMostSteps = 65535;

// How the vertices of a primitive lie in its view.
struct Layout {
  struct Field {
    uint32_t offset = 0;
    int component = kFloat;
    bool normalized = false;
  };
  Field position, normal, color, feature, uv;
  uint32_t stride = 0;
};

struct Piece {
  std::string bytes;
  uint64_t offset = 0;
  uint32_t stride = 0;
  int target = 0;
  // Of what is compressed: what it becomes, and where that lies in the second buffer.
  const char* mode = nullptr;
  uint64_t count = 0, rawBytes = 0, rawOffset = 0;
};

class TileWriter {
 public:
  TileWriter(const TileMesh& mesh, const std::string& name, bool compressed)
      : mesh_(mesh), name_(name), compressed_(compressed) {}

  /// The whole file.
  Result<std::string> bytes() {
    layOut();
    const std::string json = text();
    const uint64_t jsonBytes = (json.size() + 3) / 4 * 4;
    const uint64_t all = kGlbHead + jsonBytes + kGlbChunkHead + bytes_;
    if (all > kGlbLimit) {
      return Error{"model-too-large",
                   "the tile '" + name_ + "' would hold " + std::to_string(all >> 20) +
                       " MiB, but a .glb file ends at 4096 MiB",
                   "make rules that build less on one shape"};
    }
    workMemory(all);
    std::string out;
    out.reserve(all);
    const auto word = [](uint64_t v) { return static_cast<uint32_t>(v); };
    const uint32_t head[5] = {kGlbMagic, kGlbVersion, word(all), word(jsonBytes), kJsonChunk};
    out.append(reinterpret_cast<const char*>(head), sizeof head);
    out += json;
    out.resize(kGlbHead + jsonBytes, ' ');
    const uint32_t chunk[2] = {word(bytes_), kBinaryChunk};
    out.append(reinterpret_cast<const char*>(chunk), sizeof chunk);
    const uint64_t begin = out.size();
    for (const Piece& p : pieces_) {
      out.resize(begin + p.offset, '\0');
      out += p.bytes;
    }
    out.resize(all, '\0');
    return out;
  }

 private:
  Piece& add(std::string bytes, int target = 0, uint32_t stride = 0) {
    Piece piece;
    piece.offset = (bytes_ + 7) / 8 * 8;
    piece.bytes = std::move(bytes);
    piece.target = target;
    piece.stride = stride;
    bytes_ = piece.offset + piece.bytes.size();
    pieces_.push_back(std::move(piece));
    return pieces_.back();
  }

  // Of something that is `raw` bytes when it has been read.
  void addCompressed(std::string bytes, int target, uint32_t stride, const char* mode,
                     uint64_t count) {
    Piece& piece = add(std::move(bytes), target, stride);
    piece.mode = mode;
    piece.count = count;
    piece.rawBytes = count * stride;
    piece.rawOffset = (rawBytes_ + 7) / 8 * 8;
    rawBytes_ = piece.rawOffset + piece.rawBytes;
  }

  template <class T>
  static std::string bytesOf(const std::vector<T>& list) {
    return std::string(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
  }

  // Whether positions are integers: where that moves none by more than it may.
  void chooseSteps() {
    std::array<float, 3> most;
    low_.fill(std::numeric_limits<float>::infinity());
    most.fill(-std::numeric_limits<float>::infinity());
    for (const TilePrimitive& p : mesh_.primitives) {
      for (size_t i = 0; i < 3; ++i) {
        low_[i] = std::min(low_[i], p.min[i]);
        most[i] = std::max(most[i], p.max[i]);
      }
    }
    double side = 0;
    for (size_t i = 0; i < 3; ++i) side = std::max(side, double{most[i]} - double{low_[i]});
    step_ = side / kMostSteps;
    quantized_ = compressed_ && step_ > 0 && step_ <= 2 * kMostQuantized;
  }

  Layout layoutOf(const TilePrimitive& p) const {
    Layout l;
    const auto field = [&l](int component, uint32_t bytes, bool normalized) {
      const Layout::Field f{l.stride, component, normalized};
      l.stride += (bytes + 3) / 4 * 4;
      return f;
    };
    const bool fewFeatures = mesh_.features.size() <= 65536;
    l.position = quantized_ ? field(kUnsignedShort, 6, false) : field(kFloat, 12, false);
    l.normal = compressed_ ? field(kByte, 3, true) : field(kFloat, 12, false);
    l.color = field(kUnsignedShort, 8, true);
    l.feature =
        compressed_ && fewFeatures ? field(kUnsignedShort, 2, false) : field(kFloat, 4, false);
    l.uv = field(kFloat, 8 * p.uvCount, false);
    return l;
  }

  std::string packed(const TilePrimitive& p, const Layout& l) const {
    std::string out(uint64_t{p.vertexCount()} * l.stride, '\0');
    for (uint32_t v = 0; v < p.vertexCount(); ++v) {
      const uint32_t* from = p.words.data() + size_t{v} * p.floats();
      char* to = out.data() + size_t{v} * l.stride;
      const auto real = [from](size_t i) { return double{std::bit_cast<float>(from[i])}; };
      for (size_t i = 0; i < 3; ++i) {
        if (quantized_) {
          const double steps = std::round((real(i) - double{low_[i]}) / step_);
          const auto q = static_cast<uint16_t>(std::clamp(steps, 0.0, kMostSteps));
          std::memcpy(to + 2 * i, &q, 2);
        }
        const auto n = static_cast<int8_t>(std::lround(std::clamp(real(3 + i), -1.0, 1.0) * 127));
        to[l.normal.offset + i] = static_cast<char>(n);
      }
      if (!quantized_) std::memcpy(to, from, 12);
      std::memcpy(to + l.color.offset, from + 6, 8);
      if (l.feature.component == kFloat) {
        std::memcpy(to + l.feature.offset, from + 8, 4);
      } else {
        const auto feature = static_cast<uint16_t>(real(8));
        std::memcpy(to + l.feature.offset, &feature, 2);
      }
      std::memcpy(to + l.uv.offset, from + 9, size_t{8} * p.uvCount);
    }
    return out;
  }

  void addPrimitive(const TilePrimitive& p) {
    const Layout l = layoutOf(p);
    layouts_.push_back(l);
    if (!compressed_) {
      counts_.push_back(p.vertexCount());
      add(bytesOf(p.words), kArrayBuffer, l.stride);
      add(bytesOf(p.indices), kElementArrayBuffer);
      return;
    }
    std::string vertices = packed(p, l);
    std::vector<uint32_t> indices = p.indices;
    settleOrder(vertices, l.stride, indices);
    addBounds(vertices, l.stride);
    const auto count = static_cast<uint32_t>(vertices.size() / l.stride);
    counts_.push_back(count);
    addCompressed(compressedVertices(vertices, l.stride), kArrayBuffer, l.stride, "ATTRIBUTES",
                  count);
    addCompressed(compressedTriangles(indices, count), kElementArrayBuffer, 4, "TRIANGLES",
                  indices.size());
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
    add(std::move(values));
    add(std::move(offsets));
  }

  template <class Get>
  void addNumbers(Get get) {
    std::string values;
    for (size_t i = 0; i < mesh_.features.size(); ++i) {
      const double v = get(i);
      const float f = std::isfinite(v) ? static_cast<float>(v) : kNoNumber;
      values.append(reinterpret_cast<const char*>(&f), 4);
    }
    add(std::move(values));
  }

  void layOut() {
    chooseSteps();
    for (const TilePrimitive& p : mesh_.primitives) addPrimitive(p);
    firstColumn_ = pieces_.size();
    if (!mesh_.features.empty()) {
      addTexts([](const TileFeature& f) { return f.id; });
      addTexts([](const TileFeature& f) { return f.shape; });
      addTexts([](const TileFeature& f) { return f.name; });
      addTexts([](const TileFeature& f) { return f.type; });
      addTexts([](const TileFeature& f) { return f.attributes; });
      addNumbers([&](size_t i) { return mesh_.features[i].levels; });
      addNumbers([&](size_t i) { return mesh_.features[i].height; });
    }
    firstImage_ = pieces_.size();
    for (const ModelTexture& t : mesh_.materials->images()) add(t.bytes);
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

  // Of positions, as they are written: vertices that no triangle uses are gone when compressed.
  void writeBounds(JsonWriter& w, size_t primitive) const {
    const TilePrimitive& p = mesh_.primitives[primitive];
    std::array<float, 3> low = p.min, high = p.max;
    if (compressed_) low = bounds_[2 * primitive], high = bounds_[2 * primitive + 1];
    for (const auto& [name, v] : {std::pair{"min", low}, std::pair{"max", high}}) {
      w.key(name).beginArray().value(v[0]).value(v[1]).value(v[2]).endArray();
    }
  }

  void addBounds(const std::string& vertices, uint32_t stride) {
    std::array<float, 3> low, high;
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
    for (size_t at = 0; at < vertices.size(); at += stride) {
      std::array<float, 3> v{};
      std::array<uint16_t, 3> q{};
      if (quantized_) {
        std::memcpy(q.data(), vertices.data() + at, sizeof q);
        for (size_t i = 0; i < 3; ++i) v[i] = static_cast<float>(q[i]);
      } else {
        std::memcpy(v.data(), vertices.data() + at, sizeof v);
      }
      for (size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], v[i]);
        high[i] = std::max(high[i], v[i]);
      }
    }
    bounds_.push_back(low);
    bounds_.push_back(high);
  }

  void writeAccessors(JsonWriter& w) const {
    w.key("accessors").beginArray();
    for (size_t at = 0; at < mesh_.primitives.size(); ++at) {
      const TilePrimitive& p = mesh_.primitives[at];
      const Layout& l = layouts_[at];
      const auto accessor = [&](const Layout::Field& f, const char* type) {
        w.beginObject().field("bufferView", uint64_t{2 * at});
        if (f.offset) w.field("byteOffset", f.offset);
        w.field("componentType", f.component).field("count", counts_[at]).field("type", type);
        if (f.normalized) w.field("normalized", true);
        if (f.offset == 0) writeBounds(w, at);
        w.endObject();
      };
      accessor(l.position, "VEC3");
      accessor(l.normal, "VEC3");
      accessor(l.color, "VEC4");
      accessor(l.feature, "SCALAR");
      for (uint32_t i = 0; i < p.uvCount; ++i) {
        Layout::Field uv = l.uv;
        uv.offset += 8 * i;
        accessor(uv, "VEC2");
      }
      w.beginObject().field("bufferView", uint64_t{2 * at + 1});
      w.field("componentType", kUnsignedInt);
      w.field("count", uint64_t{p.indices.size()}).field("type", "SCALAR").endObject();
    }
    w.endArray();
  }

  void writeViews(JsonWriter& w) const {
    w.key("bufferViews").beginArray();
    for (const Piece& p : pieces_) {
      w.beginObject().field("buffer", p.mode ? 1 : 0);
      w.field("byteOffset", p.mode ? p.rawOffset : p.offset);
      w.field("byteLength", p.mode ? p.rawBytes : uint64_t{p.bytes.size()});
      if (p.target == kArrayBuffer) w.field("byteStride", p.stride);
      if (p.target) w.field("target", p.target);
      if (p.mode) {
        w.key("extensions").beginObject().key("EXT_meshopt_compression").beginObject();
        w.field("buffer", 0).field("byteOffset", p.offset);
        w.field("byteLength", uint64_t{p.bytes.size()}).field("byteStride", p.stride);
        w.field("mode", p.mode).field("count", p.count).endObject().endObject();
      }
      w.endObject();
    }
    w.endArray();
    w.key("buffers").beginArray();
    w.beginObject().field("byteLength", bytes_).endObject();
    if (compressed_) {
      w.beginObject().field("byteLength", (rawBytes_ + 7) / 8 * 8).key("extensions").beginObject();
      w.key("EXT_meshopt_compression").beginObject().field("fallback", true).endObject();
      w.endObject().endObject();
    }
    w.endArray();
  }

  void writeExtensions(JsonWriter& w) const {
    w.key("extensionsUsed").beginArray();
    w.value("EXT_mesh_features").value("EXT_structural_metadata");
    if (mesh_.materials->usesTransforms()) w.value("KHR_texture_transform");
    if (compressed_) w.value("EXT_meshopt_compression").value("KHR_mesh_quantization");
    w.endArray();
    if (!compressed_) return;
    w.key("extensionsRequired").beginArray();
    w.value("EXT_meshopt_compression").value("KHR_mesh_quantization").endArray();
  }

  // Steps of integers become metres from the middle of the tile.
  void writeNode(JsonWriter& w) const {
    Vec3 at = mesh_.center;
    if (quantized_) at += Vec3{double{low_[0]}, double{low_[1]}, double{low_[2]}};
    w.key("nodes").beginArray().beginObject().field("mesh", 0).key("translation").beginArray();
    w.value(at.x).value(at.y).value(at.z).endArray();
    if (quantized_) {
      w.key("scale").beginArray().value(step_).value(step_).value(step_).endArray();
    }
    w.endObject().endArray();
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
    writeExtensions(w);
    writeTable(w);
    w.field("scene", 0).key("scenes").beginArray().beginObject().key("nodes").beginArray();
    w.value(0).endArray().endObject().endArray();
    writeNode(w);
    writeMesh(w);
    mesh_.materials->write(w);
    writeImages(w);
    writeAccessors(w);
    writeViews(w);
    w.endObject();
    return out;
  }

  const TileMesh& mesh_;
  const std::string& name_;
  const bool compressed_;
  std::vector<Piece> pieces_;
  // By primitive.
  std::vector<Layout> layouts_;
  std::vector<uint32_t> counts_;
  // Two by primitive, of what is compressed.
  std::vector<std::array<float, 3>> bounds_;
  std::array<float, 3> low_{};
  double step_ = 0;
  bool quantized_ = false;
  size_t firstColumn_ = 0, firstImage_ = 0;
  uint64_t bytes_ = 0, rawBytes_ = 0;
};

}  // namespace

Result<TileFile> writeTile(const TileMesh& mesh, const std::string& folder, const std::string& name,
                           bool compressed) {
  const Result<std::string> bytes = TileWriter(mesh, name, compressed).bytes();
  if (!bytes.ok()) return bytes.error();
  const Result<uint64_t> written = writeFile(folder + name, bytes.value());
  if (!written.ok()) return written.error();
  return TileFile{name, written.value(), checksum(bytes.value())};
}

}  // namespace gable
