// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/gltf_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/work.h"
#include "io/gltf_format.h"
#include "io/importers/base64.h"
#include "io/importers/stand_ins.h"
#include "io/uri.h"

namespace gable {
namespace {

// Accessors without a buffer are zeros and cost the file nothing, so they are bounded.
constexpr size_t kMostZeros = 1'000'000;
constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kMeshopt = "EXT_meshopt_compression";
/// In all buffers together, the last one excepted.
constexpr uint64_t kMostBytes = uint64_t{1} << 31;

uint32_t wordAt(std::string_view bytes, size_t at) {
  uint32_t v = 0;
  std::memcpy(&v, bytes.data() + at, 4);
  return v;
}

int bytesOf(int component) {
  switch (component) {
    case 5120:
    case 5121: return 1;
    case 5122:
    case 5123: return 2;
    case 5125:
    case 5126: return 4;
    default: return 0;
  }
}

int componentsOf(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

// What a normalised component is divided by.
double scaleOf(int component) {
  switch (component) {
    case 5120: return 127;
    case 5121: return 255;
    case 5122: return 32767;
    case 5123: return 65535;
    case 5125: return 4294967295.0;
    default: return 1;
  }
}

template <class T>
double numberAt(const char* p, double scale) {
  T v;
  std::memcpy(&v, p, sizeof v);
  return std::max(static_cast<double>(v) / scale, -1.0);
}

double componentAt(const char* p, int component, bool normalized) {
  if (component == 5126) {
    float f = 0;
    std::memcpy(&f, p, 4);
    return f;
  }
  if (!normalized) {
    switch (component) {
      case 5120: return static_cast<signed char>(*p);
      case 5121: return static_cast<unsigned char>(*p);
      case 5122: {
        int16_t v;
        std::memcpy(&v, p, 2);
        return v;
      }
      case 5123: {
        uint16_t v;
        std::memcpy(&v, p, 2);
        return v;
      }
      default: {
        uint32_t v;
        std::memcpy(&v, p, 4);
        return v;
      }
    }
  }
  switch (component) {
    case 5120: return numberAt<int8_t>(p, scaleOf(component));
    case 5121: return numberAt<uint8_t>(p, scaleOf(component));
    case 5122: return numberAt<int16_t>(p, scaleOf(component));
    case 5123: return numberAt<uint16_t>(p, scaleOf(component));
    default: return numberAt<uint32_t>(p, scaleOf(component));
  }
}

Vec3 vecOf(const JsonValue& v, const Vec3& fallback) {
  if (v.size() != 3) return fallback;
  return {v.at(0).number(fallback.x), v.at(1).number(fallback.y), v.at(2).number(fallback.z)};
}

bool isKnownExtension(std::string_view name) {
  constexpr std::string_view kKnown[] = {kDraco, kMeshopt, "KHR_texture_transform",
                                         "KHR_mesh_quantization", "EXT_texture_webp"};
  return std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown) ||
         name.starts_with("KHR_materials_");
}

Error broken(const AssetOptions& options, const std::string& why) {
  return {"asset-broken", "'" + options.path + "' is not a glTF file that can be read: " + why, {}};
}

}  // namespace

size_t GltfFile::index(const JsonValue& v) {
  const double n = v.number(-1);
  return n >= 0 && n < 9e15 && n == std::floor(n) ? static_cast<size_t>(n) : kNone;
}

Result<GltfFile> GltfFile::open(std::string_view bytes, const AssetOptions& options) {
  std::string_view text = bytes, chunk;
  if (bytes.substr(0, 4) == "glTF") {
    if (bytes.size() < gltf::kGlbHead || wordAt(bytes, 4) != gltf::kGlbVersion)
      return broken(options, "the head is wrong");
    const size_t size = wordAt(bytes, 12);
    if (wordAt(bytes, 16) != gltf::kJsonChunk || size > bytes.size() - gltf::kGlbHead) {
      return broken(options, "the JSON chunk is cut off");
    }
    text = bytes.substr(gltf::kGlbHead, size);
    const size_t next = gltf::kGlbHead + (size + 3) / 4 * 4;
    if (next + gltf::kGlbChunkHead <= bytes.size() &&
        wordAt(bytes, next + 4) == gltf::kBinaryChunk) {
      chunk = bytes.substr(next + gltf::kGlbChunkHead, wordAt(bytes, next));
    }
  }
  GltfFile file;
  Result<JsonValue> json = parseJson(text);
  if (!json.ok()) return broken(options, json.error().message);
  file.json_ = std::move(*json);
  if (!file.json_.isObject()) return broken(options, "the JSON is no object");
  const std::string& version = file.json_["asset"]["version"].text();
  if (version.empty() || version[0] != '2') return broken(options, "it is not of version 2");
  for (const JsonValue& e : file.json_["extensionsRequired"].items()) {
    const std::string& name = e.text();
    if (isKnownExtension(name)) continue;
    return Error{"asset-broken", "'" + options.path + "' needs the extension '" + name + "'",
                 "save it without that extension"};
  }
  file.loadBuffers(chunk, options);
  if (std::optional<Error> error = file.unpack(options)) return *error;
  return file;
}

void GltfFile::loadBuffers(std::string_view chunk, const AssetOptions& options) {
  uint64_t held = 0;
  for (const JsonValue& b : json_["buffers"].items()) {
    work();
    buffers_.emplace_back();
    // Many buffers may name one large file.
    if (held > kMostBytes) continue;
    const JsonValue* uri = b.find("uri");
    std::string mime;
    if (!uri) {
      if (buffers_.size() == 1) buffers_.back() = chunk;
    } else if (!readDataUri(uri->text(), mime, buffers_.back())) {
      const std::string path = relativeTo(options.path, pathOf(uri->text()));
      Result<std::string> bytes =
          options.readFile ? options.readFile(path)
                           : Result<std::string>(Error{"file-missing", "nothing may be read", {}});
      if (bytes.ok()) {
        buffers_.back() = std::move(*bytes);
      } else {
        warnings_.push_back("the buffer '" + path + "' is left out: " + bytes.error().message);
      }
    }
    held += buffers_.back().size();
  }
}

namespace {

// False where the file says what there is not.
bool describePacked(const JsonValue& e, PackedBuffer& out) {
  const std::string& mode = e["mode"].text();
  const std::string& filter = e["filter"].text();
  if (mode == "ATTRIBUTES")
    out.kind = PackedBuffer::Vertices;
  else if (mode == "TRIANGLES")
    out.kind = PackedBuffer::Triangles;
  else if (mode == "INDICES")
    out.kind = PackedBuffer::Indices;
  else
    return false;
  if (filter == "OCTAHEDRAL")
    out.filter = PackedBuffer::Octahedral;
  else if (filter == "QUATERNION")
    out.filter = PackedBuffer::Quaternion;
  else if (filter == "EXPONENTIAL")
    out.filter = PackedBuffer::Exponential;
  else if (!filter.empty() && filter != "NONE")
    return false;
  const size_t count = GltfFile::index(e["count"]), stride = GltfFile::index(e["byteStride"]);
  if (count > 0xffffffff || stride > 256) return false;
  out.count = static_cast<uint32_t>(count);
  out.stride = static_cast<uint32_t>(stride);
  return true;
}

}  // namespace

// All that is compressed goes to gable-convert at once.
std::optional<Error> GltfFile::unpack(const AssetOptions& options) {
  std::vector<PackedBuffer> jobs;
  std::vector<size_t> views;
  const auto& allViews = json_["bufferViews"].items();
  uint64_t bytes = 0;
  const auto add = [&](PackedBuffer job, size_t view) {
    bytes += job.bytes.size();
    if (job.bytes.empty() || bytes > kMostBytes) return false;
    jobs.push_back(job);
    views.push_back(view);
    return true;
  };
  uint64_t broken = 0;
  for (size_t i = 0; i < allViews.size(); ++i) {
    work();
    const JsonValue& e = allViews[i]["extensions"][kMeshopt];
    PackedBuffer job;
    if (!e.isObject()) continue;
    job.bytes = rangeOf(e);
    if (!describePacked(e, job) || !add(job, i)) ++broken;
  }
  const size_t ofMeshopt = jobs.size();
  std::map<size_t, std::vector<const JsonValue*>> primitives;
  for (const JsonValue& mesh : json_["meshes"].items()) {
    for (const JsonValue& p : mesh["primitives"].items()) {
      work();
      const JsonValue& e = p["extensions"][kDraco];
      if (!e.isObject()) continue;
      const size_t number = index(e["bufferView"]);
      auto& users = primitives[number];
      if (users.empty() &&
          !add({PackedBuffer::Draco, 0, 0, PackedBuffer::None, view(number)}, number)) {
        ++broken;
      }
      users.push_back(&p);
    }
  }
  Result<std::vector<std::string>> made = unpackBuffers(jobs, options.path);
  if (!made.ok()) {
    const auto& required = json_["extensionsRequired"].items();
    const bool needed = std::any_of(required.begin(), required.end(), [](const JsonValue& e) {
      return e.text() == kDraco || e.text() == kMeshopt;
    });
    if (needed) return made.error();
    warnings_.push_back("what is compressed is left out: " + made.error().message);
    return {};
  }
  for (size_t i = 0; i < jobs.size(); ++i) {
    DracoMesh mesh;
    if ((*made)[i].empty()) {
      ++broken;
    } else if (i < ofMeshopt) {
      unpackedViews_[views[i]] = std::move((*made)[i]);
    } else if (readDracoMesh((*made)[i], mesh)) {
      for (const JsonValue* p : primitives[views[i]]) takeDraco(*p, mesh);
    } else {
      ++broken;
    }
  }
  if (broken > 0) {
    warnings_.push_back(std::to_string(broken) + " compressed buffers cannot be read");
  }
  return {};
}

// The accessors of the primitive that the mesh has the numbers of.
void GltfFile::takeDraco(const JsonValue& p, const DracoMesh& mesh) {
  const JsonValue& own = p["attributes"];
  for (const auto& [name, id] : p["extensions"][kDraco]["attributes"].members()) {
    const size_t number = index(id);
    const JsonValue* accessor = own.find(name);
    const auto at =
        mesh.attributes.find(static_cast<uint32_t>(std::min<size_t>(number, kNone >> 32)));
    if (!accessor || at == mesh.attributes.end()) continue;
    workMemory(at->second.numbers.size() * sizeof(float));
    unpackedAttributes_[index(*accessor)] = at->second;
  }
  if (const JsonValue* indices = p.find("indices")) {
    workMemory(mesh.indices.size() * sizeof(uint32_t));
    unpackedIndices_[index(*indices)] = mesh.indices;
  }
}

bool GltfFile::readUnpacked(const JsonValue& accessor, const DracoMesh::Attribute& from,
                            int components, std::vector<double>& out) const {
  if (from.components != static_cast<uint32_t>(components)) return false;
  const int type = static_cast<int>(std::min<size_t>(index(accessor["componentType"]), 100000));
  const double scale = accessor["normalized"].boolean(false) ? scaleOf(type) : 1;
  reserveWork(out, static_cast<double>(from.numbers.size()));
  out.clear();
  for (const float v : from.numbers) {
    work();
    const double n = static_cast<double>(v) / scale;
    out.push_back(scale == 1 ? n : std::max(n, -1.0));
  }
  return true;
}

std::string_view GltfFile::view(size_t i) const {
  const auto unpacked = unpackedViews_.find(i);
  if (unpacked != unpackedViews_.end()) return unpacked->second;
  return rangeOf(json_["bufferViews"].at(i));
}

std::string_view GltfFile::rangeOf(const JsonValue& v) const {
  const size_t buffer = index(v["buffer"]);
  if (!v.isObject() || buffer >= buffers_.size()) return {};
  const std::string_view all = buffers_[buffer];
  const size_t offset = v.find("byteOffset") ? index(v["byteOffset"]) : 0;
  const size_t length = index(v["byteLength"]);
  if (offset > all.size() || length > all.size() - offset) return {};
  return all.substr(offset, length);
}

bool GltfFile::describe(const JsonValue& a, Elements& out) const {
  out.component = static_cast<int>(std::min<size_t>(index(a["componentType"]), 100000));
  out.components = componentsOf(a["type"].text());
  out.count = index(a["count"]);
  out.normalized = a["normalized"].boolean(false);
  const size_t bytes = static_cast<size_t>(bytesOf(out.component) * out.components);
  if (bytes == 0 || out.count == kNone) return false;
  if (!a.find("bufferView")) return out.count <= kMostZeros;
  const size_t viewIndex = index(a["bufferView"]);
  const std::string_view all = view(viewIndex);
  const size_t offset = a.find("byteOffset") ? index(a["byteOffset"]) : 0;
  const JsonValue& stride = json_["bufferViews"].at(viewIndex)["byteStride"];
  out.stride = stride.isNumber() ? index(stride) : bytes;
  if (out.stride < bytes || out.stride > 4096) return false;
  if (out.count == 0) return true;
  if (offset > all.size() || all.size() - offset < bytes) return false;
  if ((all.size() - offset - bytes) / out.stride < out.count - 1) return false;
  out.data = all.data() + offset;
  return true;
}

bool GltfFile::applySparse(const JsonValue& accessor, const Elements& e,
                           std::vector<double>& out) const {
  const JsonValue* sparse = accessor.find("sparse");
  if (!sparse) return true;
  const size_t count = index((*sparse)["count"]);
  const JsonValue &indices = (*sparse)["indices"], &values = (*sparse)["values"];
  const int type = static_cast<int>(std::min<size_t>(index(indices["componentType"]), 100000));
  const size_t size = static_cast<size_t>(bytesOf(type));
  const size_t width = static_cast<size_t>(e.components);
  const size_t valueSize = static_cast<size_t>(bytesOf(e.component));
  const auto range = [&](const JsonValue& v) {
    const std::string_view all = view(index(v["bufferView"]));
    const size_t offset = v.find("byteOffset") ? index(v["byteOffset"]) : 0;
    return offset > all.size() ? std::string_view{} : all.substr(offset);
  };
  const std::string_view at = range(indices), numbers = range(values);
  if (count > e.count || size == 0 || type == 5126 || at.size() / size < count ||
      numbers.size() / (valueSize * width) < count) {
    return false;
  }
  for (size_t i = 0; i < count; ++i) {
    work();
    const auto element = static_cast<size_t>(componentAt(at.data() + i * size, type, false));
    if (element >= e.count) return false;
    for (size_t c = 0; c < width; ++c) {
      out[element * width + c] =
          componentAt(numbers.data() + (i * width + c) * valueSize, e.component, e.normalized);
    }
  }
  return true;
}

bool GltfFile::read(size_t number, int components, std::vector<double>& out) const {
  const JsonValue& accessor = json_["accessors"].at(number);
  const auto unpacked = unpackedAttributes_.find(number);
  if (unpacked != unpackedAttributes_.end()) {
    return readUnpacked(accessor, unpacked->second, components, out);
  }
  Elements e;
  if (!describe(accessor, e) || e.components != components) return false;
  const auto width = static_cast<size_t>(components);
  const auto size = static_cast<size_t>(bytesOf(e.component));
  reserveWork(out, static_cast<double>(e.count * width));
  out.assign(e.count * width, 0);
  for (size_t i = 0; e.data && i < e.count; ++i) {
    work();
    for (size_t c = 0; c < width; ++c) {
      out[i * width + c] = componentAt(e.data + i * e.stride + c * size, e.component, e.normalized);
    }
  }
  return applySparse(accessor, e, out);
}

bool GltfFile::readIndices(const JsonValue& primitive, size_t vertexCount,
                           std::vector<uint32_t>& out) const {
  out.clear();
  const JsonValue* number = primitive.find("indices");
  if (!number) {
    for (size_t i = 0; i < vertexCount; ++i) out.push_back(static_cast<uint32_t>(i));
    return true;
  }
  const auto unpacked = unpackedIndices_.find(index(*number));
  if (unpacked != unpackedIndices_.end()) {
    out = unpacked->second;
    return std::all_of(out.begin(), out.end(), [&](uint32_t v) { return v < vertexCount; });
  }
  std::vector<double> numbers;
  const JsonValue& accessor = json_["accessors"].at(index(*number));
  if (accessor["normalized"].boolean(false) || index(accessor["componentType"]) == 5126 ||
      !read(index(*number), 1, numbers)) {
    return false;
  }
  for (const double v : numbers) {
    work();
    if (!(v >= 0 && v < static_cast<double>(vertexCount))) return false;
    out.push_back(static_cast<uint32_t>(v));
  }
  return true;
}

Affine GltfFile::localOf(const JsonValue& node) {
  const JsonValue& m = node["matrix"];
  Affine a;
  if (m.size() == 16) {
    const auto column = [&](size_t c) {
      return Vec3{m.at(4 * c).number(0), m.at(4 * c + 1).number(0), m.at(4 * c + 2).number(0)};
    };
    return {column(0), column(1), column(2), column(3)};
  }
  const JsonValue& r = node["rotation"];
  if (r.size() == 4) {
    const double x = r.at(0).number(0), y = r.at(1).number(0), z = r.at(2).number(0),
                 w = r.at(3).number(1);
    const double n = x * x + y * y + z * z + w * w;
    const double s = n > 0 ? 2 / n : 0;
    a.x = {1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)};
    a.y = {s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)};
    a.z = {s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)};
  }
  const Vec3 scale = vecOf(node["scale"], {1, 1, 1});
  a.x = a.x * scale.x;
  a.y = a.y * scale.y;
  a.z = a.z * scale.z;
  a.origin = vecOf(node["translation"], {});
  return a;
}

std::vector<size_t> GltfFile::roots() const {
  std::vector<size_t> out;
  const JsonValue& scenes = json_["scenes"];
  const size_t scene = json_.find("scene") ? index(json_["scene"]) : 0;
  if (scene < scenes.size()) {
    for (const JsonValue& root : scenes.at(scene)["nodes"].items()) out.push_back(index(root));
    return out;
  }
  // A library of nodes: all that are no child.
  const std::vector<JsonValue>& nodes = json_["nodes"].items();
  std::vector<bool> isChild(nodes.size());
  for (const JsonValue& n : nodes) {
    for (const JsonValue& c : n["children"].items()) {
      if (index(c) < nodes.size()) isChild[index(c)] = true;
    }
  }
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (!isChild[n]) out.push_back(n);
  }
  return out;
}

std::vector<bool> GltfFile::coarserLevels() const {
  const std::vector<JsonValue>& nodes = json_["nodes"].items();
  std::vector<bool> out(nodes.size());
  for (size_t n = 0; n < nodes.size(); ++n) {
    for (const JsonValue& id : nodes[n]["extensions"]["MSFT_lod"]["ids"].items()) {
      if (index(id) < nodes.size() && index(id) != n) out[index(id)] = true;
    }
  }
  return out;
}

std::vector<GltfFile::Visit> GltfFile::visits() const {
  const std::vector<JsonValue>& nodes = json_["nodes"].items();
  std::vector<Visit> stack, out;
  const std::vector<size_t> first = roots();
  for (auto r = first.rbegin(); r != first.rend(); ++r) stack.push_back({*r, kNone, {}});
  std::vector<bool> seen(nodes.size());
  while (!stack.empty()) {
    work();
    Visit visit = stack.back();
    stack.pop_back();
    if (visit.node >= nodes.size() || seen[visit.node]) continue;
    seen[visit.node] = true;
    const JsonValue& n = nodes[visit.node];
    visit.world = visit.world * localOf(n);
    out.push_back(visit);
    const auto& children = n["children"].items();
    work(children.size());
    for (auto c = children.rbegin(); c != children.rend(); ++c) {
      stack.push_back({index(*c), out.size() - 1, visit.world});
    }
  }
  return out;
}

const std::string& GltfFile::nameOf(size_t node) const {
  const JsonValue& n = json_["nodes"].at(node);
  const std::string& own = n["name"].text();
  return own.empty() ? json_["meshes"].at(index(n["mesh"]))["name"].text() : own;
}

GltfShown GltfFile::shown() const {
  const std::vector<Visit> all = visits();
  std::vector<std::string_view> names;
  for (const Visit& v : all) names.push_back(nameOf(v.node));
  const StandIns standIns(names);
  const std::vector<bool> coarser = coarserLevels();
  std::vector<bool> isCoarse(all.size());
  GltfShown out;
  for (size_t i = 0; i < all.size(); ++i) {
    const Visit& v = all[i];
    isCoarse[i] =
        coarser[v.node] || standIns.isCoarse(names[i]) || (v.parent != kNone && isCoarse[v.parent]);
    const JsonValue& n = json_["nodes"].at(v.node);
    const size_t mesh = index(n["mesh"]);
    if (mesh >= json_["meshes"].size() || !v.world.finite()) continue;
    if (isCoarse[i] || isCollisionName(names[i])) {
      ++out.left;
    } else {
      out.placements.push_back({mesh, v.world, nameOf(v.node), n.find("extras")});
    }
  }
  return out;
}

}  // namespace gable
