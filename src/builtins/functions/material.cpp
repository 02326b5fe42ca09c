// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The attributes material.*, one for each field of a material, and materials as arrays of names and
// values.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/files.h"
#include "builtins/lists.h"
#include "builtins/shared/materials.h"
#include "builtins/shared/text_files.h"
#include "shape/op_call.h"

namespace gable {

namespace {

template <size_t index>
Value getField(FunctionCall& call) {
  const Services& services = call.services();
  const Material& m = services.materials().get(usedMaterial(call.shape(), services));
  return readField(materialFields()[index], m, services.pool());
}

template <size_t index>
Status setField(OpCall& call, const Value& v) {
  return writeField(materialFields()[index], v, call.shape(), call.services(), call.file());
}

template <size_t... index>
std::array<AttributeSpec, sizeof...(index)> makeAttributes(std::index_sequence<index...>) {
  return {AttributeSpec{materialFields()[index].name, materialFields()[index].type,
                        materialFields()[index].doc, getField<index>, setField<index>,
                        kTakesDeformed}...};
}

// How many fields there are; a test compares it with the table.
constexpr size_t kFieldCount = 103;
const auto kAttributes = makeAttributes(std::make_index_sequence<kFieldCount>());

// The groups in which the original lists a material, each in the order of its names: truth values,
// numbers, colours, texts, images, the shader.
int groupOf(const MaterialField& f) {
  const std::string_view name = shortName(f);
  if (f.flag) return 0;
  if (f.number) {
    return name.ends_with(".r") || name.ends_with(".g") || name.ends_with(".b") ? 2 : 1;
  }
  if (name == "shader") return 5;
  return name.ends_with("map") ? 4 : 3;
}

std::vector<const MaterialField*> fieldsInOrder() {
  std::vector<const MaterialField*> fields;
  for (const MaterialField& f : materialFields()) fields.push_back(&f);
  std::sort(fields.begin(), fields.end(), [](const MaterialField* a, const MaterialField* b) {
    return std::pair(groupOf(*a), shortName(*a)) < std::pair(groupOf(*b), shortName(*b));
  });
  return fields;
}

// A table of names and values.
Value tableOf(const Material& m, bool changedOnly, ValuePool& pool) {
  static const std::vector<const MaterialField*> kInOrder = fieldsInOrder();
  const Material plain;
  Array out;
  out.element = ValueType::String;
  out.columns = 2;
  for (const MaterialField* f : kInOrder) {
    // Fields that show what another one holds already.
    const std::string_view name = shortName(*f);
    if (name == "color.rgb" || isOldName(*f)) continue;
    const Value v = readField(*f, m, pool);
    if (changedOnly && v == readField(*f, plain, pool)) continue;
    out.strings.push_back(pool.intern(name));
    out.strings.push_back(pool.intern(pool.str(v)));
    ++out.rows;
  }
  return pool.intern(std::move(out));
}

struct GetMaterial {
  Word source, mode;
};

Value getMaterial(FunctionCall& call, const GetMaterial& args) {
  const Services& services = call.services();
  const MaterialId id = args.source == "shape"      ? call.shape().material
                        : args.source == "geometry" ? geometryMaterial(call.shape(), services)
                                                    : usedMaterial(call.shape(), services);
  return tableOf(services.materials().get(id), args.mode == "changed", services.pool());
}

// A texture beside the material's file, by its path in the project; else the name as it is, which
// setMaterial looks up as any other.
std::string besideFile(const std::string& folder, const std::string& name, FunctionCall& call) {
  Assets& assets = call.services().assets();
  if (name.empty() || name[0] == '/' || name.starts_with("builtin:")) return name;
  const std::string beside = folder + name;
  return assets.exists(beside, call.file()) ? assets.resolve(beside, call.file()) : name;
}

// The rows of a .cgamat file, which is a CSV file of names and values.
Value readCgamat(FunctionCall& call, std::string_view path) {
  Assets& assets = call.services().assets();
  ValuePool& pool = call.services().pool();
  Array out;
  out.element = ValueType::String;
  out.columns = 2;
  std::string bytes;
  if (!assets.text(path, call.file(), bytes)) {
    return call.fail("missing-file", "there is no file '" + std::string(path) + "'",
                     kWherePathsStart, pool.intern(std::move(out)));
  }
  const std::string file = assets.resolve(path, call.file());
  const std::string folder = file.substr(0, file.rfind('/') + 1);
  const TextTable table = parseTable(decodedText(bytes));
  for (size_t row = 0; row < table.rows; ++row) {
    const std::string& name = table.cells[row * table.columns];
    if (name.empty()) continue;
    const MaterialField* field = materialField(name);
    if (!field || table.columns < 2) {
      call.fail("bad-material",
                "'" + std::string(path) + "' sets no property of a material in line " +
                    std::to_string(row + 1),
                "each line is a property and its value, as in 'roughness,0.5'", {});
      continue;
    }
    const std::string& value = table.cells[row * table.columns + 1];
    out.strings.push_back(pool.intern(name));
    out.strings.push_back(pool.intern(isTexture(*field) ? besideFile(folder, value, call) : value));
    ++out.rows;
  }
  return pool.intern(std::move(out));
}

struct ReadMaterial {
  std::string_view path;
};

Value readMaterial(FunctionCall& call, const ReadMaterial& args) {
  const std::string extension = extensionOf(std::string(args.path));
  if (extension == "cgamat") return readCgamat(call, args.path);
  Array none;
  none.element = ValueType::String;
  none.columns = 2;
  ValuePool& pool = call.services().pool();
  if (extension != "mtl") {
    return call.fail("bad-material", "'" + std::string(args.path) + "' is no file of a material",
                     "use a .cgamat or an .mtl file", pool.intern(std::move(none)));
  }
  const Result<Material> m = call.services().assets().material(args.path, call.file());
  if (m.ok()) return tableOf(m.value(), true, pool);
  return call.fail(m.error().code == "bad-material" ? "bad-material" : "missing-file",
                   m.error().message, m.error().hint, pool.intern(std::move(none)));
}

constexpr ParamSpec kReadMaterialParams[] = {
    param<&ReadMaterial::path>("filePath", "A .cgamat or .mtl file, by its path in the project."),
};
constexpr Signature kReadMaterialSignatures[] = {{kReadMaterialParams, ValueType::StringArray}};

constexpr ParamSpec kGetMaterialParams[] = {
    param<&GetMaterial::source>(
        "source",
        "The material in use, the shape's own changes, or the one that an inserted model brought.",
        nullptr, "used shape geometry"),
    param<&GetMaterial::mode>("mode", "Only what differs from the default material, or everything.",
                              nullptr, "changed all"),
};
constexpr Signature kGetMaterialSignatures[] = {{kGetMaterialParams, ValueType::StringArray}};

constexpr FunctionSpec kFunctions[] = {
    {"getMaterial", "material",
     "A material as a table of two columns, names and values, that setMaterial understands.",
     kGetMaterialSignatures, typed<getMaterial>},
    {"readMaterial", "material",
     "The material of a file as a table of two columns, as getMaterial gives it.",
     kReadMaterialSignatures, typed<readMaterial>},
};

}  // namespace

extern const FunctionList kFunctions_material;
const FunctionList kFunctions_material = {kFunctions, kAttributes};

}  // namespace gable
