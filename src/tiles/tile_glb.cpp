// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pieces of a tile's buffer are made first, so that the JSON before them knows all offsets:
// vertices and indices of each primitive, the columns of the table of features, pictures. Each
// begins at a multiple of eight bytes, as EXT_structural_metadata wants it.
//
// Compressed, the first two kinds lie in views of a second buffer that no file holds
// (EXT_meshopt_compression calls it a fallback), and their extension says where the bytes are.
// Integers for positions (KHR_mesh_quantization) count steps of one size from a corner of the tile,
// or of a part that is placed several times: then the places scale the steps.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/bytes.h"
#include "base/files.h"
#include "base/work.h"
#include "io/exporters/quaternion.h"
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

// Of the tile's own mesh, or of instances.
struct Steps {
  bool on = false;
  std::array<float, 3> low{};
  double size = 0;

  Vec3 corner() const { return on ? Vec3{double{low[0]}, double{low[1]}, double{low[2]}} : Vec3{}; }
};

// A primitive of the file: of the mesh 0, the tile's own, or of that of instances `mesh` - 1.
struct Part {
  const TilePrimitive* primitive = nullptr;
  size_t mesh = 0;
  Layout layout;
  uint32_t vertices = 0;
  // As they are written: vertices that no triangle uses are gone when compressed.
  std::array<float, 3> low{}, high{};
  uint32_t accessors() const { return 4 + (mesh == 0 ? 1 : 0) + primitive->uvCount; }
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
  Steps stepsOf(const std::vector<TilePrimitive>& primitives) const {
    Steps out;
    std::array<float, 3> most;
    out.low.fill(std::numeric_limits<float>::infinity());
    most.fill(-std::numeric_limits<float>::infinity());
    for (const TilePrimitive& p : primitives) {
      for (size_t i = 0; i < 3; ++i) {
        out.low[i] = std::min(out.low[i], p.min[i]);
        most[i] = std::max(most[i], p.max[i]);
      }
    }
    double side = 0;
    for (size_t i = 0; i < 3; ++i) side = std::max(side, double{most[i]} - double{out.low[i]});
    out.size = side / kMostSteps;
    out.on = compressed_ && out.size > 0 && out.size <= 2 * kMostQuantized;
    return out;
  }

  Layout layoutOf(const TilePrimitive& p, size_t mesh) const {
    Layout l;
    const auto field = [&l](int component, uint32_t bytes, bool normalized) {
      const Layout::Field f{l.stride, component, normalized};
      l.stride += (bytes + 3) / 4 * 4;
      return f;
    };
    const bool fewFeatures = mesh_.features.size() <= 65536;
    l.position = steps_[mesh].on ? field(kUnsignedShort, 6, false) : field(kFloat, 12, false);
    l.normal = compressed_ ? field(kByte, 3, true) : field(kFloat, 12, false);
    l.color = field(kUnsignedShort, 8, true);
    // Instances have it once each; plain vertices are written as they are all the same.
    if (mesh == 0 || !compressed_) {
      l.feature =
          compressed_ && fewFeatures ? field(kUnsignedShort, 2, false) : field(kFloat, 4, false);
    }
    l.uv = field(kFloat, 8 * p.uvCount, false);
    return l;
  }

  std::string packed(const TilePrimitive& p, const Layout& l, const Steps& steps) const {
    std::string out(uint64_t{p.vertexCount()} * l.stride, '\0');
    for (uint32_t v = 0; v < p.vertexCount(); ++v) {
      const uint32_t* from = p.words.data() + size_t{v} * p.floats();
      char* to = out.data() + size_t{v} * l.stride;
      const auto real = [from](size_t i) { return double{std::bit_cast<float>(from[i])}; };
      for (size_t i = 0; i < 3; ++i) {
        if (steps.on) {
          const double step = std::round((real(i) - double{steps.low[i]}) / steps.size);
          const auto q = static_cast<uint16_t>(std::clamp(step, 0.0, kMostSteps));
          std::memcpy(to + 2 * i, &q, 2);
        }
        const auto n = static_cast<int8_t>(std::lround(std::clamp(real(3 + i), -1.0, 1.0) * 127));
        to[l.normal.offset + i] = static_cast<char>(n);
      }
      if (!steps.on) std::memcpy(to, from, 12);
      std::memcpy(to + l.color.offset, from + 6, 8);
      if (l.feature.offset > 0 && l.feature.component == kFloat) {
        std::memcpy(to + l.feature.offset, from + 8, 4);
      } else if (l.feature.offset > 0) {
        const auto feature = static_cast<uint16_t>(real(8));
        std::memcpy(to + l.feature.offset, &feature, 2);
      }
      std::memcpy(to + l.uv.offset, from + 9, size_t{8} * p.uvCount);
    }
    return out;
  }

  void addPrimitive(const TilePrimitive& p, size_t mesh) {
    if (p.indices.empty()) return;
    Part part{&p, mesh, layoutOf(p, mesh), p.vertexCount(), p.min, p.max};
    const Layout& l = part.layout;
    if (!compressed_) {
      add(bytesOf(p.words), kArrayBuffer, l.stride);
      add(bytesOf(p.indices), kElementArrayBuffer);
      parts_.push_back(part);
      return;
    }
    std::string vertices = packed(p, l, steps_[mesh]);
    std::vector<uint32_t> indices = p.indices;
    settleOrder(vertices, l.stride, indices);
    setBounds(part, vertices);
    part.vertices = static_cast<uint32_t>(vertices.size() / l.stride);
    addCompressed(compressedVertices(vertices, l.stride), kArrayBuffer, l.stride, "ATTRIBUTES",
                  part.vertices);
    addCompressed(compressedTriangles(indices, part.vertices), kElementArrayBuffer, 4, "TRIANGLES",
                  indices.size());
    parts_.push_back(part);
  }

  // Translations, rotations, scales and features, a column each.
  void addPlaces(const TileInstances& instances, const Steps& steps) {
    std::array<std::string, 4> columns;
    const auto put = [](std::string& to, double v) {
      const auto f = static_cast<float>(v);
      to.append(reinterpret_cast<const char*>(&f), 4);
    };
    for (const TileInstances::Place& p : instances.places) {
      const Vec3 at = p.frame.point(steps.corner());
      for (size_t i = 0; i < 3; ++i) put(columns[0], at[i]);
      for (const double q : quaternionOf(p.frame)) put(columns[1], q);
      for (size_t i = 0; i < 3; ++i) put(columns[2], steps.on ? steps.size : 1);
      put(columns[3], p.feature);
    }
    for (std::string& c : columns) add(std::move(c));
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
    steps_.push_back(stepsOf(mesh_.primitives));
    for (const TileInstances& i : mesh_.instances) steps_.push_back(stepsOf(i.primitives));
    for (const TilePrimitive& p : mesh_.primitives) addPrimitive(p, 0);
    for (size_t i = 0; i < mesh_.instances.size(); ++i) {
      for (const TilePrimitive& p : mesh_.instances[i].primitives) addPrimitive(p, i + 1);
    }
    firstPlaces_ = pieces_.size();
    for (size_t i = 0; i < mesh_.instances.size(); ++i) {
      addPlaces(mesh_.instances[i], steps_[i + 1]);
    }
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

  void writeMeshes(JsonWriter& w) const {
    w.key("meshes").beginArray();
    uint64_t accessor = 0;
    for (size_t at = 0; at < parts_.size(); ++at) {
      const Part& part = parts_[at];
      if (at == 0 || parts_[at - 1].mesh != part.mesh) {
        w.beginObject().key("primitives").beginArray();
      }
      w.beginObject().key("attributes").beginObject();
      w.field("POSITION", accessor).field("NORMAL", accessor + 1).field("COLOR_0", accessor + 2);
      accessor += 3;
      if (part.mesh == 0) w.field("_FEATURE_ID_0", accessor++);
      for (uint32_t i = 0; i < part.primitive->uvCount; ++i) {
        w.field("TEXCOORD_" + std::to_string(i), accessor++);
      }
      w.endObject().field("indices", accessor++);
      w.field("material", mesh_.materials->materialOf(part.primitive->variant));
      if (part.mesh == 0) {
        w.key("extensions").beginObject().key("EXT_mesh_features").beginObject();
        writeFeatureIds(w);
        w.endObject().endObject();
      }
      w.endObject();
      if (at + 1 == parts_.size() || parts_[at + 1].mesh != part.mesh) w.endArray().endObject();
    }
    w.endArray();
  }

  void writeFeatureIds(JsonWriter& w) const {
    w.key("featureIds").beginArray().beginObject();
    w.field("featureCount", uint64_t{mesh_.features.size()});
    w.field("attribute", 0).field("propertyTable", 0).endObject().endArray();
  }

  void setBounds(Part& part, const std::string& vertices) const {
    part.low.fill(std::numeric_limits<float>::infinity());
    part.high.fill(-std::numeric_limits<float>::infinity());
    for (size_t at = 0; at < vertices.size(); at += part.layout.stride) {
      std::array<float, 3> v{};
      std::array<uint16_t, 3> q{};
      if (steps_[part.mesh].on) {
        std::memcpy(q.data(), vertices.data() + at, sizeof q);
        for (size_t i = 0; i < 3; ++i) v[i] = static_cast<float>(q[i]);
      } else {
        std::memcpy(v.data(), vertices.data() + at, sizeof v);
      }
      for (size_t i = 0; i < 3; ++i) {
        part.low[i] = std::min(part.low[i], v[i]);
        part.high[i] = std::max(part.high[i], v[i]);
      }
    }
  }

  void writeAccessors(JsonWriter& w) const {
    w.key("accessors").beginArray();
    for (size_t at = 0; at < parts_.size(); ++at) {
      const Part& part = parts_[at];
      const Layout& l = part.layout;
      const auto accessor = [&](const Layout::Field& f, const char* type) {
        w.beginObject().field("bufferView", uint64_t{2 * at});
        if (f.offset) w.field("byteOffset", f.offset);
        w.field("componentType", f.component).field("count", part.vertices).field("type", type);
        if (f.normalized) w.field("normalized", true);
        if (f.offset == 0) {
          for (const auto& [name, v] : {std::pair{"min", part.low}, std::pair{"max", part.high}}) {
            w.key(name).beginArray().value(v[0]).value(v[1]).value(v[2]).endArray();
          }
        }
        w.endObject();
      };
      accessor(l.position, "VEC3");
      accessor(l.normal, "VEC3");
      accessor(l.color, "VEC4");
      if (part.mesh == 0) accessor(l.feature, "SCALAR");
      for (uint32_t i = 0; i < part.primitive->uvCount; ++i) {
        Layout::Field uv = l.uv;
        uv.offset += 8 * i;
        accessor(uv, "VEC2");
      }
      w.beginObject().field("bufferView", uint64_t{2 * at + 1});
      w.field("componentType", kUnsignedInt);
      w.field("count", uint64_t{part.primitive->indices.size()})
          .field("type", "SCALAR")
          .endObject();
    }
    uint64_t view = firstPlaces_;
    for (const TileInstances& i : mesh_.instances) {
      for (const char* type : {"VEC3", "VEC4", "VEC3", "SCALAR"}) {
        w.beginObject().field("bufferView", view++).field("componentType", kFloat);
        w.field("count", uint64_t{i.places.size()}).field("type", type).endObject();
      }
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
    const bool instanced = !mesh_.instances.empty();
    if (instanced) w.value("EXT_instance_features").value("EXT_mesh_gpu_instancing");
    if (mesh_.materials->usesTransforms()) w.value("KHR_texture_transform");
    if (compressed_) w.value("EXT_meshopt_compression").value("KHR_mesh_quantization");
    w.endArray();
    if (!compressed_ && !instanced) return;
    w.key("extensionsRequired").beginArray();
    if (instanced) w.value("EXT_mesh_gpu_instancing");
    if (compressed_) w.value("EXT_meshopt_compression").value("KHR_mesh_quantization");
    w.endArray();
  }

  // Steps of integers become metres from the middle of the tile.
  void writeNodes(JsonWriter& w) const {
    w.key("nodes").beginArray();
    uint64_t accessor = 0, number = 0;
    for (const Part& p : parts_) accessor += p.accessors();
    const auto begin = [&](const Vec3& at) {
      w.beginObject().field("mesh", number++);
      w.key("translation").beginArray().value(at.x).value(at.y).value(at.z).endArray();
    };
    if (ownMesh()) {
      begin(mesh_.center + steps_[0].corner());
      if (steps_[0].on) {
        const double step = steps_[0].size;
        w.key("scale").beginArray().value(step).value(step).value(step).endArray();
      }
      w.endObject();
    }
    for (size_t i = 0; i < mesh_.instances.size(); ++i) {
      begin(mesh_.center);
      w.key("extensions").beginObject();
      w.key("EXT_mesh_gpu_instancing").beginObject().key("attributes").beginObject();
      w.field("TRANSLATION", accessor).field("ROTATION", accessor + 1).field("SCALE", accessor + 2);
      w.field("_FEATURE_ID_0", accessor + 3).endObject().endObject();
      w.key("EXT_instance_features").beginObject();
      writeFeatureIds(w);
      w.endObject().endObject().endObject();
      accessor += 4;
    }
    w.endArray();
  }

  /// Whether the tile has a mesh beside those of instances.
  bool ownMesh() const { return !parts_.empty() && parts_[0].mesh == 0; }

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
    for (size_t n = 0; n < mesh_.instances.size() + (ownMesh() ? 1 : 0); ++n) w.value(uint64_t{n});
    w.endArray().endObject().endArray();
    writeNodes(w);
    writeMeshes(w);
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
  // By mesh.
  std::vector<Steps> steps_;
  std::vector<Part> parts_;
  size_t firstPlaces_ = 0, firstColumn_ = 0, firstImage_ = 0;
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
