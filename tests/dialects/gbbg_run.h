// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A GBBG grammar, derived, with its shapes as the derivation tree tells them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/json.h"
#include "engine/impl.h"
#include "gable/gable.h"
#include "gbbg_world.h"
#include "json/answers.h"

namespace gable {

struct TracedShape {
  std::string name;
  bool leaf = false;
  Frame scope;
  Vec3 size;
  uint32_t depth = 0;
};

inline Vec3 vecOf(const JsonValue& v) {
  return {v.at(0).number(0), v.at(1).number(0), v.at(2).number(0)};
}

/// In the order of derivation.
inline void flattenTrace(const JsonValue& node, uint32_t depth, std::vector<TracedShape>& out) {
  TracedShape s;
  s.name = node["shape"].text();
  s.leaf = node["leaf"].boolean(false);
  const JsonValue& scope = node["scope"];
  s.scope =
      Frame::of(vecOf(scope["origin"]), vecOf(scope["x"]), vecOf(scope["y"]), vecOf(scope["z"]));
  s.size = vecOf(scope["size"]);
  s.depth = depth;
  out.push_back(s);
  for (const JsonValue& child : node["children"].items()) flattenTrace(child, depth + 1, out);
}

struct Derivation {
  Rules rules;
  Model model;
  std::vector<TracedShape> shapes;

  std::vector<TracedShape> leaves(const std::string& name = {}) const {
    std::vector<TracedShape> out;
    for (const TracedShape& s : shapes) {
      if (s.leaf && (name.empty() || s.name == name)) out.push_back(s);
    }
    return out;
  }
  size_t count(const std::string& name) const {
    size_t n = 0;
    for (const TracedShape& s : shapes) n += s.name == name;
    return n;
  }
  std::string codes() const {
    std::string out;
    for (const DiagnosticList* list : {&rules.diagnostics(), &model.diagnostics()}) {
      for (const Diagnostic& m : *list) out += (out.empty() ? "" : " ") + m.code;
    }
    return out;
  }
};

inline Derivation derived(const std::string& grammar, const DeriveSettings& given = {},
                          const Shapes& shapes = Shapes::lot(20, 20),
                          const std::string& path = "test.gbbg") {
  LoadSettings options;
  const size_t slash = path.rfind('/');
  if (slash != std::string::npos) options.project = path.substr(0, slash);
  const Rules rules = Rules::parse(grammar, path, options);
  for (const Diagnostic& m : rules.diagnostics()) {
    if (m.isError()) ADD_FAILURE() << m.rendered;
  }
  DeriveSettings settings = given;
  settings.trace = true;
  settings.jobs = 1;
  Model model = derive(rules, shapes, settings);
  Derivation run{rules, model, {}};
  std::string told;
  writeTrace(model.trace(), [&](std::string_view text) { told += text; });
  const Result<JsonValue> trace = parseJson(told);
  EXPECT_TRUE(trace.ok());
  if (trace.ok()) {
    for (const JsonValue& root : trace.value().items()) flattenTrace(root, 0, run.shapes);
  }
  return run;
}

/// Where a box of GBBG's world lies in Gable's: the world mirrored, and the origin at the other end
/// of z.
inline TracedShape mirrored(const gbbg_world::Box& b) {
  const auto flip = [](const gbbg_world::Vec& v) { return Vec3{v[0], v[1], -v[2]}; };
  TracedShape s;
  s.name = b.symbol;
  const Vec3 z = -flip(b.rotation.axes[2]);
  s.scope = Frame::of(flip(b.root) - z * b.size[2], flip(b.rotation.axes[0]),
                      flip(b.rotation.axes[1]), z);
  s.size = {b.size[0], b.size[1], b.size[2]};
  return s;
}

inline double differenceOf(const TracedShape& a, const TracedShape& b) {
  if (a.name != b.name) return 1e9;
  return length(a.scope.origin - b.scope.origin) + length(a.size - b.size) +
         length(a.scope.x - b.scope.x) + length(a.scope.y - b.scope.y) +
         length(a.scope.z - b.scope.z);
}

inline std::string textOf(const TracedShape& s) {
  std::string out = s.name;
  for (const Vec3& v : {s.scope.origin, s.scope.x, s.scope.y, s.scope.z, s.size}) {
    out += " (" + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + ")";
  }
  return out + "\n";
}

/// Each expected box is there once and nothing else, whatever the order.
inline ::testing::AssertionResult sameBoxes(const std::vector<TracedShape>& got,
                                            const std::vector<gbbg_world::Box>& expected) {
  std::vector<bool> used(got.size(), false);
  std::string missing;
  for (const gbbg_world::Box& b : expected) {
    const TracedShape wanted = mirrored(b);
    size_t best = got.size();
    for (size_t i = 0; i < got.size() && best == got.size(); ++i) {
      if (!used[i] && differenceOf(got[i], wanted) < 1e-6) best = i;
    }
    if (best == got.size()) {
      missing += "  missing " + textOf(wanted);
    } else {
      used[best] = true;
    }
  }
  std::string more;
  for (size_t i = 0; i < got.size(); ++i) {
    if (!used[i]) more += "  got     " + textOf(got[i]);
  }
  if (missing.empty() && more.empty()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\n" << missing << more;
}

}  // namespace gable
