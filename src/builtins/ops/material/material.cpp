// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <string>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/shared/materials.h"
#include "builtins/shared/text_forms.h"
#include "material/library.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr double kKeepOpacity = -1;

// By a text or by numbers.
struct Color {
  std::optional<std::string_view> hex;
  double red, green, blue;
  double opacity = kKeepOpacity;
};

// Numbers that are computed may lie beyond what is taken. A little more is not seen.
void tellBeyond(OpCall& call, const Color& args) {
  constexpr double kSeen = 0.1, kLeastOfParts = 10;
  const double most = std::max({args.red, args.green, args.blue});
  const double least = std::min({args.red, args.green, args.blue});
  if (!(most > 1 + kSeen || least < -kSeen)) return;
  const auto taken = [](double v) { return std::clamp(v, 0.0, 1.0); };
  call.services().warn("tint-capped",
                       "the colour (" + shortestText(args.red) + ", " + shortestText(args.green) +
                           ", " + shortestText(args.blue) + ") lies beyond 0 to 1: it becomes " +
                           colorText({taken(args.red), taken(args.green), taken(args.blue)}),
                       most < kLeastOfParts
                           ? "give red, green and blue from 0 to 1"
                           : "divide parts of 255 by 255, or give the colour as \"#rrggbb\"");
}

Status applyRgb(OpCall& call, const Color& args) {
  tellBeyond(call, args);
  setColor(call.shape(), {args.red, args.green, args.blue}, args.opacity, call.services());
  return {};
}

Status applyColor(OpCall& call, const Color& args) {
  if (!args.hex) return applyRgb(call, args);
  Vec3 rgb;
  double opacity = kKeepOpacity;
  parseColor(*args.hex, rgb, opacity);
  setColor(call.shape(), rgb, opacity, call.services());
  return {};
}

struct Texture {
  std::string_view path;
};

Status applyTexture(OpCall& call, const Texture& args) {
  setTexture(call.shape(), args.path, call.services(), call.file());
  return {};
}

struct LibraryCall {
  std::string_view name;
  std::optional<std::string_view> tint;
};

Status applyMaterial(OpCall& call, const LibraryCall& args) {
  Vec3 rgb;
  double opacity = kKeepOpacity;
  const bool tinted = args.tint && parseColor(*args.tint, rgb, opacity);
  if (const Status taken = tinted ? takesTint(args.name, rgb) : Status(); !taken) {
    call.services().warn(taken.code(), taken.message(), taken.hint());
  }
  return setLibraryMaterial(call.shape(), args.name, tinted ? &rgb : nullptr, call.services(),
                            call.file());
}

struct SetMaterial {
  Strings pairs;
};

Status applySetMaterial(OpCall& call, const SetMaterial& args) {
  ValuePool& pool = call.services().pool();
  const Array& pairs = *args.pairs.array;
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

enum class ResetTarget : uint8_t { Shape, Geometry, All };

}  // namespace

template <>
struct WordsOf<ResetTarget> {
  static constexpr const char* text = "shape geometry all";
};

namespace {

struct ResetMaterial {
  ResetTarget target;
};

Status applyResetMaterial(OpCall& call, const ResetMaterial& args) {
  resetMaterials(call.shape(), args.target != ResetTarget::Geometry,
                 args.target != ResetTarget::Shape, call.services());
  return {};
}

constexpr ParamSpec kHexParams[] = {
    param<&Color::hex>("hexValue", "\"#rrggbb\", or \"#rrggbboo\" with opacity.").of(kColourText),
};
// Values beyond 0 and 1 are taken as these, as rules of CityEngine expect. Many programs count
// colours to 255.
constexpr ParamSpec kRed =
    param<&Color::red>("red", "Red, 0 to 1. Of 255 parts, divide by 255, or write \"#rrggbb\".");
constexpr ParamSpec kGreen = param<&Color::green>(
    "green", "Green, 0 to 1. Of 255 parts, divide by 255, or write \"#rrggbb\".");
constexpr ParamSpec kBlue =
    param<&Color::blue>("blue", "Blue, 0 to 1. Of 255 parts, divide by 255, or write \"#rrggbb\".");
constexpr ParamSpec kRgbParams[] = {kRed, kGreen, kBlue};
constexpr ParamSpec kRgboParams[] = {
    kRed, kGreen, kBlue, param<&Color::opacity>("opacity", "From 0, invisible, to 1, opaque.")};
constexpr Signature kColorSignatures[] = {{kHexParams}, {kRgbParams}, {kRgboParams}};

constexpr ParamSpec kTextureParams[] = {
    param<&Texture::path>("filePath", "The image; an empty text takes the texture away."),
};
constexpr Signature kTextureSignatures[] = {{kTextureParams}};

constexpr ParamSpec kMaterialName =
    param<&LibraryCall::name>(
        "name", "A material of the library, or a folder in materials/ beside the rules.")
        .of(kMaterialText);
constexpr ParamSpec kOwnTintParams[] = {kMaterialName};
constexpr ParamSpec kTintParams[] = {
    kMaterialName,
    param<&LibraryCall::tint>("tint", "The colour that its main part gets, \"#rrggbb\".")
        .of(kColourText),
};
constexpr Signature kMaterialSignatures[] = {{kOwnTintParams}, {kTintParams}};

constexpr ParamSpec kSetMaterialParams[] = {
    param<&SetMaterial::pairs>(
        "material",
        "Names of material attributes, without \"material.\", and their values in turns."),
};
constexpr Signature kSetMaterialSignatures[] = {{kSetMaterialParams}};

constexpr ParamSpec kResetParams[] = {
    param<&ResetMaterial::target>(
        "target", "What rules have set on the shape, what an inserted model brought, or both.",
        "shape"),
};
constexpr Signature kResetSignatures[] = {{kResetParams}};

constexpr OpSpec kSpecs[] = {
    {"color", "material", "Sets the colour of the shape's material, and its opacity if given.",
     kColorSignatures, typed<applyColor>, BlockKind::None, kTakesDeformed | kIgnoresTags},
    {"texture", "material",
     "Sets the colour map, and the opacity map too when the image has an alpha channel.",
     kTextureSignatures, typed<applyTexture>, BlockKind::None, kTakesDeformed | kIgnoresTags},
    {"material", "material",
     "Gives the shape a material of the library, in its true size on any face.",
     kMaterialSignatures, typed<applyMaterial>, BlockKind::None, kTakesDeformed | kIgnoresTags},
    {"setMaterial", "material", "Sets many attributes of the material at once.",
     kSetMaterialSignatures, typed<applySetMaterial>, BlockKind::None,
     kTakesDeformed | kIgnoresTags},
    {"resetMaterial", "material", "Takes changes of the material back.", kResetSignatures,
     typed<applyResetMaterial>, BlockKind::None, kTakesDeformed | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_material;
const OpList kOps_material = kSpecs;

}  // namespace gable
