// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The one table of options that written models take, and the one of profiles.
#include "gable/writing.h"

#include <algorithm>
#include <charconv>

#include "base/files.h"
#include "engine/game_scene.h"
#include "engine/impl.h"
#include "gable/names.h"
#include "io/exporters/write_model.h"

namespace gable {
namespace {

constexpr const char* kUnknown = "write-option-unknown";
constexpr const char* kClash = "write-options-clash";

struct OptionRow {
  const char* name;
  const char* help;
  std::vector<std::string> words;
  int most;
  std::vector<std::string> formats;
  void (*set)(WriteSettings& settings, int value);
  /// Of the numbers besides 0.
  int least = 1;
};

// An atlas of fewer pixels a side has no room for two plain colours with their borders.
constexpr int kLeastAtlas = 64;

// Values are places in the words, or numbers.
const std::vector<OptionRow>& optionRows() {
  static const std::vector<std::string> gltf{"glb", "gltf"}, gltfAndTiles{"glb", "gltf", "tiles"},
      instanced{"glb", "gltf", "tiles", "usda", "usdz"}, cityJson{"city.json", "city.jsonl"},
      withPictures{"glb", "gltf", "obj", "usda", "usdz"};
  static const std::vector<OptionRow> rows{
      {"instancing",
       "glTF, USD: how parts that occur several times are shown: auto (by nodes, at most\n"
       "20000; what saves least is merged), nodes (by a node each), none (written out);\n"
       "glTF: gpu (by EXT_mesh_gpu_instancing), shapes (a mesh for each initial shape,\n"
       "which equal ones share)",
       instancingNames(), 0, instanced,
       [](WriteSettings& s, int v) { s.instancing = static_cast<Instancing>(v); }},
      {"vertices",
       "glTF: what a vertex takes: auto (compact in large files), float (single\n"
       "precision), compact (half of that, by KHR_mesh_quantization, no vertex moved by\n"
       "more than half a millimetre), bare (compact, flat surfaces without normals)",
       verticesNames(), 0, gltfAndTiles,
       [](WriteSettings& s, int v) { s.vertices = static_cast<Vertices>(v); }},
      {"lod",
       "CityJSON: which levels of detail: 1 (blocks), 2 (roofs and walls), 3 (all that\n"
       "rules made), all",
       detailNames(), 0, cityJson,
       [](WriteSettings& s, int v) { s.detail = static_cast<Detail>(v); }},
      {"names",
       "glTF: what things are called: rules (as rules call them), unique (a name of its own\n"
       "for each initial shape and mesh), godot and unreal (unique, collision shapes as that\n"
       "engine marks them)",
       {"rules", "unique", "godot", "unreal"},
       0,
       gltf,
       [](WriteSettings& s, int v) { s.names = static_cast<Names>(v); }},
      {"collision",
       "glTF: collision shapes, an initial shape each: none, box (the smallest upright box),\n"
       "hull (the convex hull, 98 corners at most), mesh (triangles without small parts)",
       {"none", "box", "hull", "mesh"},
       0,
       gltf,
       [](WriteSettings& s, int v) { s.collision = static_cast<Collision>(v); }},
      {"lods",
       "glTF: how many coarser levels of detail each initial shape has",
       {},
       3,
       gltf,
       [](WriteSettings& s, int v) { s.levels = v; }},
      {"lod-form",
       "glTF: how --lods are kept: names (in the file, as House_LOD0, House_LOD1), msft (in\n"
       "the file, by MSFT_lod), files (beside it, as model_LOD1.glb)",
       {"names", "msft", "files"},
       0,
       gltf,
       [](WriteSettings& s, int v) { s.levelForm = static_cast<LevelForm>(v); }},
      {"uv",
       "glTF: how materials scale, turn and move textures: extension (KHR_texture_transform),\n"
       "baked (in the texture coordinates, where all textures of a material want the same)",
       {"extension", "baked"},
       0,
       gltf,
       [](WriteSettings& s, int v) { s.bakedUv = v == 1; }},
      {"texture-size",
       "glTF, OBJ and USD: halve pictures until no side has more pixels; 0: as they are",
       {},
       16384,
       withPictures,
       [](WriteSettings& s, int v) { s.textureSize = static_cast<uint32_t>(v); }},
      {"atlas",
       "glTF, OBJ and USD: put plain colours and pictures that do not repeat into one\n"
       "picture of so many pixels a side at most, and merge their materials; 0: no atlas",
       {},
       8192,
       withPictures,
       [](WriteSettings& s, int v) { s.atlas = static_cast<uint32_t>(v); },
       kLeastAtlas},
  };
  return rows;
}

std::string listOf(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

void say(DiagnosticList& out, Severity severity, const std::string& code,
         const std::string& message, const std::string& hint) {
  out.push_back(diagnosticOf({severity, code, Span{}, message, hint, {}, {}}, Sources{}));
}

void wrong(DiagnosticList& out, const std::string& message, const std::string& given,
           const std::vector<std::string>& known) {
  const std::string near = suggestion(given, known);
  say(out, Severity::Error, kUnknown, message,
      near.empty() ? "there are " + listOf(known) : near + " there are " + listOf(known));
}

void setNumber(const OptionRow& row, const std::string& value, ChosenWriting& out) {
  int number = -1;
  const char* end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, number);
  const bool whole = read.ec == std::errc() && read.ptr == end;
  if (whole && (number == 0 || (number >= row.least && number <= row.most))) {
    row.set(out.settings, number);
    return;
  }
  say(out.diagnostics, Severity::Error, kUnknown,
      "the option '" + std::string(row.name) + "' takes no '" + value + "'",
      (row.least > 1 ? "it takes 0, or a whole number from " + std::to_string(row.least)
                     : std::string("it takes a whole number from 0")) +
          " to " + std::to_string(row.most));
}

void set(const std::string& name, const std::string& value, ChosenWriting& out) {
  const auto& rows = optionRows();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const OptionRow& r) { return name == r.name; });
  if (row == rows.end()) {
    std::vector<std::string> known;
    for (const OptionRow& r : rows) known.emplace_back(r.name);
    wrong(out.diagnostics, "written models have no option '" + name + "'", name, known);
  } else if (row->words.empty()) {
    setNumber(*row, value, out);
  } else {
    const auto word = std::find(row->words.begin(), row->words.end(), value);
    if (word == row->words.end()) {
      wrong(out.diagnostics, "the option '" + name + "' takes no '" + value + "'", value,
            row->words);
    } else {
      row->set(out.settings, static_cast<int>(word - row->words.begin()));
    }
  }
}

const WriteProfile* profileNamed(const std::string& name) {
  for (const WriteProfile& p : writeProfiles()) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

const std::string* valueOf(const WriteChoices& choices, const std::string& name) {
  for (const auto& [option, value] : choices) {
    if (option == name) return &value;
  }
  return nullptr;
}

}  // namespace

const std::vector<WriteOption>& writeOptions() {
  static const std::vector<WriteOption> all = [] {
    std::vector<WriteOption> out;
    for (const OptionRow& r : optionRows())
      out.push_back({r.name, r.help, r.words, r.most, r.formats});
    return out;
  }();
  return all;
}

const std::vector<WriteProfile>& writeProfiles() {
  static const std::vector<WriteProfile> all{
      {"blender",
       "Blender 3.4 and newer",
       {{"instancing", "nodes"}, {"vertices", "float"}, {"names", "rules"}}},
      {"cesium",
       "CesiumJS, for a single model on the globe",
       {{"instancing", "gpu"}, {"vertices", "compact"}, {"texture-size", "1024"}}},
      {"godot",
       "Godot 3 and 4",
       {{"instancing", "shapes"},
        {"vertices", "float"},
        {"names", "godot"},
        {"collision", "mesh"},
        {"lod-form", "files"},
        {"uv", "baked"},
        {"texture-size", "2048"},
        {"atlas", "2048"}}},
      {"unity",
       "Unity, by its package glTFast",
       {{"instancing", "shapes"},
        {"vertices", "float"},
        {"names", "unique"},
        {"collision", "mesh"},
        {"lods", "2"},
        {"lod-form", "names"},
        {"texture-size", "2048"},
        {"atlas", "2048"}}},
      {"unreal",
       "Unreal Engine 5, by Interchange",
       {{"instancing", "shapes"},
        {"vertices", "float"},
        {"names", "unreal"},
        {"collision", "hull"},
        {"lods", "2"},
        {"lod-form", "files"},
        {"texture-size", "2048"},
        {"atlas", "2048"}}},
  };
  return all;
}

ChosenWriting chosenWriting(const std::string& profile, const WriteChoices& choices) {
  ChosenWriting out;
  const WriteProfile* chosen = profile.empty() ? nullptr : profileNamed(profile);
  if (!profile.empty() && !chosen) {
    std::vector<std::string> known;
    for (const WriteProfile& p : writeProfiles()) known.push_back(p.name);
    wrong(out.diagnostics, "there is no profile '" + profile + "'", profile, known);
  }
  if (chosen) {
    for (const auto& [name, value] : chosen->choices) set(name, value, out);
  }
  for (const auto& [name, value] : choices) {
    set(name, value, out);
    const std::string* of = chosen ? valueOf(chosen->choices, name) : nullptr;
    if (!of || *of == value) continue;
    say(out.diagnostics, Severity::Note, "profile-overridden",
        "'--" + name + " " + value + "' holds in place of '" + *of + "', the choice for " + profile,
        "");
  }
  out.ok = !hasErrors(out.diagnostics);
  return out;
}

DiagnosticList unfitChoices(const std::string& path, const WriteChoices& choices) {
  DiagnosticList out;
  const bool tiles = path.ends_with('/');
  const std::string format = tiles ? "tiles" : modelFormatOf(path);
  if (format.empty()) return out;
  for (const auto& [name, value] : choices) {
    for (const OptionRow& row : optionRows()) {
      const auto& fit = row.formats;
      if (name != row.name || std::find(fit.begin(), fit.end(), format) != fit.end()) continue;
      std::string list;
      for (const std::string& f : fit) {
        if (f != "tiles") list += (list.empty() ? "." : " .") + f;
      }
      say(out, Severity::Error, kClash,
          "'--" + name + "' says nothing about " + (tiles ? "tiles" : "'" + path + "'"),
          "leave it out, or write " + list);
    }
  }
  return out;
}

DiagnosticList writeClashes(const std::string& path, const WriteSettings& s) {
  DiagnosticList out;
  const std::string format = modelFormatOf(path);
  const bool known = !format.empty() || extensionOf(path) == "png";
  const auto clash = [&](const std::string& message, const std::string& hint) {
    say(out, Severity::Error, kClash, message, hint);
  };
  const bool isOfGltf = s.instancing == Instancing::Gpu || s.instancing == Instancing::Shapes;
  if (isOfGltf && (format == "usda" || format == "usdz")) {
    clash("'" + path + "' has no instancing '" +
              instancingNames()[static_cast<size_t>(s.instancing)] + "'",
          "write the instancing auto, nodes or none, or a .glb");
  }
  if (!asksForGameScene(s) || !known) return out;
  if (format != "glb" && format != "gltf") {
    clash("'" + path + "' cannot have collision shapes, levels of detail or names of engines",
          "write .glb or .gltf, or leave these options out");
  } else if (s.instancing == Instancing::None && (s.collision != Collision::None || s.levels > 0)) {
    clash("one mesh for everything has no collision shapes or levels of its initial shapes",
          "use the instancing 'shapes'");
  } else if (s.names == Names::Unreal && s.collision == Collision::Mesh) {
    clash("Unreal Engine takes convex collision shapes only",
          "use the collision 'hull', or the names 'unique'");
  }
  return out;
}

}  // namespace gable
