// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The fields of a material under the names of the language (material.color.r, material.colormap),
// and the materials of a shape: its own, and those of the slots of an inserted model. What rules
// set on a shape goes to all of them.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "material/material.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

struct MaterialField {
  /// As an attribute: "material.color.r".
  const char* name;
  ValueType type;
  const char* doc;
  /// Where the field lies; null for all but one. Fields without any are computed.
  double* (*number)(Material&) = nullptr;
  std::string* (*text)(Material&) = nullptr;
  bool* (*flag)(Material&) = nullptr;
};

std::span<const MaterialField> materialFields();
/// The name without "material.".
std::string_view shortName(const MaterialField& f);
/// Whether the field shows what another one holds, by a name of earlier versions of CGA.
bool isOldName(const MaterialField& f);
/// Whether the field is a path of an image.
bool isTexture(const MaterialField& f);
/// By its short name; null when there is none.
const MaterialField* materialField(std::string_view shortName);

Value readField(const MaterialField& f, const Material& m, ValuePool& pool);
/// Writes a value; texture paths are resolved from `file`. A failure leaves all as it was.
Status writeField(const MaterialField& f, const Value& v, Shape& s, Services& services,
                  std::string_view file);
/// The same with the value as text, as setMaterial has it.
Status writeFieldText(const MaterialField& f, std::string_view v, Shape& s, Services& services,
                      std::string_view file);

/// Sets the colour, and the opacity unless it is negative.
void setColor(Shape& s, const Vec3& rgb, double opacity, Services& services);
/// Sets the colour map, and the opacity map to the same image when it has alpha, else to none.
void setTexture(Shape& s, std::string_view path, Services& services, std::string_view file);
/// A material of the library (material/library.h), or one of the folder materials/NAME of the
/// project, in a tint if there is one. Codes: unknown-material, bad-material.
Status setLibraryMaterial(Shape& s, std::string_view name, const Vec3* tint, Services& services,
                          std::string_view file);

/// The material in use of the shape's first face, and the one that the model brought for it.
MaterialId usedMaterial(const Shape& s, const Services& services);
MaterialId geometryMaterial(const Shape& s, const Services& services);

/// What the shape's own material has different from the default, laid over a model's material.
Material overlaid(const Material& own, const Material& model);
/// The materials and groups of an inserted model become those of the shape's slots.
void setModelMaterials(Shape& s, const AssetModel& model, Services& services);
/// For each slot of the shape's mesh, slot 0 too, the first slot with the same material, or of the
/// same group: what component splits take as one. Faces of no group are one.
std::vector<uint16_t> slotsByMaterial(const Shape& s, const Services& services);
std::vector<uint16_t> slotsByGroup(const Shape& s, const Services& services);
/// Back to the default: the shape's own changes, the model's materials, or both.
void resetMaterials(Shape& s, bool own, bool geometry, Services& services);

}  // namespace gable
