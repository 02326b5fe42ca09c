// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/dresser.h"

#include <optional>

namespace gable::progen3d {

NamedTexture Dresser::textureOf(const Wearing& w) {
  NamedTexture out;
  for (const char* type : {".png", ".jpg", ".jpeg"}) {
    out.path = "textures/" + std::string(w.name) + type;
    if (exists_ && exists_(out.path)) return out;
  }
  if (const std::optional<NamedTexture> named = namedTexture(w.name)) return *named;
  if (unknown_.insert(w.name).second) {
    diagnostics_.warning(
        "unknown-texture", w.nameSpan,
        "there is no texture and no variable '" + std::string(w.name) + "'; the body is plain",
        remedy_);
  }
  out.path.clear();
  return out;
}

NodeId Dresser::set(const char* attribute, NodeId value, Span at) {
  return b_.apply("set", {b_.name(std::string("material.") + attribute, at), value}, at);
}

Nodes Dresser::operations(const Wearing& w) {
  const Span at = w.at;
  const NamedTexture look = textureOf(w);
  const auto string = [&](const std::string& text) {
    return b_.add(NodeKind::String, at, {}, text);
  };
  Nodes out;
  if (!look.color.empty()) out.push_back(b_.apply("color", {string(look.color)}, at));
  if (look.opacity < 1) out.push_back(set("opacity", b_.number(look.opacity, at), at));
  if (look.roughness >= 0) out.push_back(set("roughness", b_.number(look.roughness, at), at));
  if (look.metallic > 0) out.push_back(set("metallic", b_.number(look.metallic, at), at));
  if (look.path.empty()) return out;
  out.push_back(b_.apply("texture", {string(look.path)}, at));
  for (const char* scale : {"colormap.su", "colormap.sv"}) out.push_back(set(scale, w.share(), at));
  out.push_back(set("colormap.rw", w.turn(), at));
  return out;
}

}  // namespace gable::progen3d
