// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <string>

#include "builtins/lists.h"
#include "builtins/ops/shared/insert.h"
#include "builtins/shared/materials.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Where the model's unit cube has to lie for the scope to be filled, and the model with it. A face
// has its model behind it, a metre deep.
void placeUnitCube(Shape& s, const Box3& box) {
  const double behind = s.size.z == 0 ? -1 : 0;
  Vec3 unit = s.size;
  for (size_t i = 0; i < 3; ++i) {
    if (unit[i] == 0) unit[i] = 1;
  }
  s.scope.origin = s.scope.point(scaled(box.min, unit) + Vec3{0, 0, behind});
  s.size = scaled(box.size(), unit);
}

enum class UpAxis : uint8_t { Y, Z };
enum class InsertMode : uint8_t {
  AlignSizeAndPosition,
  KeepSizeAndPosition,
  KeepSizeAlignPosition,
  UnitCube,
};

}  // namespace

template <>
struct WordsOf<UpAxis> {
  static constexpr const char* text = "yUp zUp";
};
template <>
struct WordsOf<InsertMode> {
  static constexpr const char* text =
      "alignSizeAndPosition keepSizeAndPosition keepSizeAlignPosition unitCube";
};

namespace {

struct Insert {
  std::string_view path;
  UpAxis up;
  InsertMode mode;
  Word cleanup;
};

// Makes the scope ready for a model with a bounding box.
void placeScope(Shape& s, const Box3& box, InsertMode mode) {
  switch (mode) {
    case InsertMode::KeepSizeAlignPosition: centerOnGround(s, box.size()); return;
    case InsertMode::UnitCube: placeUnitCube(s, box); return;
    case InsertMode::KeepSizeAndPosition: s.size = {}; break;
    case InsertMode::AlignSizeAndPosition: break;
  }
  fillZeroSizes(s, box);
}

Status insertBuiltin(OpCall& call, std::string_view path, InsertMode mode) {
  Shape& s = call.shape();
  if (path == "builtin:cube" || path == "builtin:cube:notex") {
    placeScope(s, kUnitBox, mode);
    insertBox(s, path == "builtin:cube");
    return {};
  }
  Mesh mesh = builtinModel(path);
  if (mesh.empty()) {
    insertPlaceholder(call, path, "there is no built-in model of that name", kBuiltinModelNames);
    return {};
  }
  const Box3 box = mesh.bounds();
  placeScope(s, box, mode);
  insertMesh(s, std::move(mesh), box);
  return {};
}

Status applyI(OpCall& call, const Insert& args) {
  const std::string_view path = args.path;
  if (path.starts_with("builtin:")) return insertBuiltin(call, path, args.mode);
  std::string why;
  const Ref<AssetModel> model =
      call.services().assets().model(path, call.file(), args.up == UpAxis::Z, why);
  if (!model) {
    insertPlaceholder(call, path, why, kWherePathsStart);
    return {};
  }
  tellLosses(call, path, *model);
  Shape& s = call.shape();
  placeScope(s, model->bounds, args.mode);
  insertMesh(s, fittedMesh(*model), model->bounds.size());
  setModelMaterials(s, *model, call.services());
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Insert::path>("filePath", "The model, by its path in the project."),
    param<&Insert::up>("upAxisOfGeometry", "The axis that is up in the file.", "yUp"),
    param<&Insert::mode>(
        "insertMode",
        "Fit the model to the scope; keep its size and place; keep its size and stand it in the "
        "middle "
        "of the scope's ground; or fit its unit cube, beyond which a prepared model may reach.",
        "alignSizeAndPosition"),
    param<&Insert::cleanup>(
        "cleanupMode",
        "Whether readers may mend tiny edges; models are taken as they are in both cases.",
        "numericalCleanup", "numericalCleanup noCleanup"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"i", "asset", "Replaces the geometry by a model from a file, fitted to the scope.",
     kSignatures, typed<applyI>, BlockKind::None, kUsesTrim | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_insert;
const OpList kOps_insert = kSpecs;

}  // namespace gable
