// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <draco/compression/decode.h>

#include <cstring>
#include <vector>

#include "jobs.h"

bool unpackDraco(std::string_view bytes, std::string& out) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return false;
  const draco::Mesh& mesh = *decoded.value();
  putWord(out, mesh.num_points());
  putWord(out, mesh.num_faces());
  for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& p : mesh.face(draco::FaceIndex(f))) putWord(out, p.value());
  }
  putWord(out, static_cast<uint32_t>(mesh.num_attributes()));
  for (int i = 0; i < mesh.num_attributes(); ++i) {
    // What integers mean the accessors of the file tell, so they stay as they are.
    draco::PointAttribute attribute;
    attribute.CopyFrom(*mesh.attribute(i));
    attribute.set_normalized(false);
    const int width = attribute.num_components();
    if (width < 1 || width > 4) return false;
    putWord(out, attribute.unique_id());
    putWord(out, static_cast<uint32_t>(width));
    float v[4];
    for (uint32_t p = 0; p < mesh.num_points(); ++p) {
      const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(p));
      if (at.value() >= attribute.size()) return false;
      if (!attribute.ConvertValue<float>(at, static_cast<int8_t>(width), v)) return false;
      for (int c = 0; c < width; ++c) {
        uint32_t word;
        std::memcpy(&word, &v[c], 4);
        putWord(out, word);
      }
    }
  }
  return true;
}
