// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <string>

#include "builtins/lists.h"
#include "builtins/shared/materials.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status applyColor(OpCall& call) {
  if (call.argCount() >= 3) {
    setColor(call.shape(), {call.number(0), call.number(1), call.number(2)}, call.number(3, -1),
             call.services());
    return {};
  }
  Vec3 rgb;
  double opacity = -1;
  if (!parseColor(call.text(0), rgb, opacity)) {
    return call.fail("bad-argument", "'" + std::string(call.text(0)) + "' is not a colour",
                     "write \"#rrggbb\" or \"#rrggbboo\"");
  }
  setColor(call.shape(), rgb, opacity, call.services());
  return {};
}

Status applyTexture(OpCall& call) {
  setTexture(call.shape(), call.text(0), call.services(), call.file());
  return {};
}

Status applySetMaterial(OpCall& call) {
  ValuePool& pool = call.services().pool();
  const Array& pairs = pool.array(call.arg(0));
  if (pairs.strings.size() % 2 != 0) {
    return call.fail("bad-argument", "setMaterial got a name without a value",
                     "write names and values in turns");
  }
  const Shape before = call.shape();
  for (size_t i = 0; i + 1 < pairs.strings.size(); i += 2) {
    const std::string_view name = pool.text(pairs.strings[i]);
    const MaterialField* field = materialField(name);
    Status status = field ? writeFieldText(*field, pool.text(pairs.strings[i + 1]), call.shape(),
                                           call.services(), call.file())
                          : call.fail("unknown-attribute",
                                      "a material has no attribute '" + std::string(name) + "'",
                                      "the names are those of material.*, without 'material.'");
    if (!status) {
      call.shape() = before;
      return status;
    }
  }
  return {};
}

Status applyResetMaterial(OpCall& call) {
  const std::string_view target = call.text(0, "shape");
  resetMaterials(call.shape(), target != "geometry", target != "shape", call.services());
  return {};
}

constexpr ParamSpec kHexParams[] = {
    {"hexValue", ParamType::String, "\"#rrggbb\", or \"#rrggbboo\" with opacity."},
};
constexpr ParamSpec kRed = {"red", ParamType::Float, "Red, 0 to 1."};
constexpr ParamSpec kGreen = {"green", ParamType::Float, "Green, 0 to 1."};
constexpr ParamSpec kBlue = {"blue", ParamType::Float, "Blue, 0 to 1."};
constexpr ParamSpec kRgbParams[] = {kRed, kGreen, kBlue};
constexpr ParamSpec kRgboParams[] = {
    kRed, kGreen, kBlue, {"opacity", ParamType::Float, "From 0, invisible, to 1, opaque."}};
constexpr Signature kColorSignatures[] = {{kHexParams}, {kRgbParams}, {kRgboParams}};

constexpr ParamSpec kTextureParams[] = {
    {"filePath", ParamType::String, "The image; an empty text takes the texture away."},
};
constexpr Signature kTextureSignatures[] = {{kTextureParams}};

constexpr ParamSpec kSetMaterialParams[] = {
    {"material", ParamType::StringArray,
     "Names of material attributes, without \"material.\", and their values in turns."},
};
constexpr Signature kSetMaterialSignatures[] = {{kSetMaterialParams}};

constexpr ParamSpec kResetParams[] = {
    {"target", ParamType::Selector,
     "What rules have set on the shape, what an inserted model brought, or both.", "shape",
     "shape geometry all"},
};
constexpr Signature kResetSignatures[] = {{kResetParams}};

constexpr OpSpec kSpecs[] = {
    {"color", "material", "Sets the colour of the shape's material, and its opacity if given.",
     kColorSignatures, applyColor},
    {"texture", "material",
     "Sets the colour map, and the opacity map too when the image has an alpha channel.",
     kTextureSignatures, applyTexture},
    {"setMaterial", "material", "Sets many attributes of the material at once.",
     kSetMaterialSignatures, applySetMaterial},
    {"resetMaterial", "material", "Takes changes of the material back.", kResetSignatures,
     applyResetMaterial},
};

}  // namespace

extern const OpList kOps_material;
const OpList kOps_material = kSpecs;

}  // namespace gable
