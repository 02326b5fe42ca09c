// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The attributes material.*, one for each field of a material, and materials as arrays of names and
// values.

#include <array>
#include <utility>

#include "builtins/lists.h"
#include "builtins/shared/materials.h"
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
constexpr size_t kFieldCount = 85;
const auto kAttributes = makeAttributes(std::make_index_sequence<kFieldCount>());

// A table of names and values in the order of the fields.
Value tableOf(const Material& m, bool changedOnly, ValuePool& pool) {
  const Material plain;
  Array out;
  out.element = ValueType::String;
  out.columns = 2;
  for (const MaterialField& f : materialFields()) {
    // Fields that show what another one holds already.
    const std::string_view name = shortName(f);
    if (name == "color.rgb" || name == "color.a") continue;
    const Value v = readField(f, m, pool);
    if (changedOnly && v == readField(f, plain, pool)) continue;
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
};

}  // namespace

extern const FunctionList kFunctions_material;
const FunctionList kFunctions_material = {kFunctions, kAttributes};

}  // namespace gable
