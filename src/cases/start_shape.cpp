// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A polygon in space goes by way of OBJ text, so that it is read as users' files are.

#include "cases/start_shape.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace gable::cases {
namespace {

/// "1,2 3,4 | 5,6": rings of points with so many coordinates each; empty when it is not understood.
std::vector<std::vector<std::vector<double>>> ringsOf(std::string_view text, size_t coordinates) {
  std::vector<std::vector<std::vector<double>>> rings(1);
  const std::string copy(text);
  const char* at = copy.c_str();
  std::vector<double> point;
  while (*at) {
    if (*at == ' ' || *at == ',')
      ++at;
    else if (*at == '|') {
      rings.emplace_back();
      ++at;
    } else {
      char* end = nullptr;
      point.push_back(std::strtod(at, &end));
      if (end == at) return {};
      at = end;
      if (point.size() == coordinates) {
        rings.back().push_back(point);
        point.clear();
      }
    }
  }
  return point.empty() ? rings : std::vector<std::vector<std::vector<double>>>{};
}

Shapes polygonOf(const std::vector<std::vector<std::vector<double>>>& rings) {
  std::vector<Shapes::Ring> plan;
  for (const auto& ring : rings) {
    plan.emplace_back();
    for (const auto& p : ring) plan.back().emplace_back(p[0], p[1]);
  }
  return Shapes::polygon(plan.front(), {plan.begin() + 1, plan.end()});
}

/// A polygon in space, by way of OBJ text.
Shapes faceOf(const std::vector<std::vector<double>>& ring) {
  std::string text, face = "f";
  for (size_t i = 0; i < ring.size(); ++i) {
    for (double v : ring[i])
      text += (text.empty() || text.back() == '\n' ? "v " : " ") + std::to_string(v);
    text += '\n';
    face += " " + std::to_string(i + 1);
  }
  return Shapes::parse(text + face + "\n", "face.obj");
}

}  // namespace

std::optional<Shapes> startShape(const Case& c, const std::string& folder,
                                 const FileLimits& limits) {
  const auto lines = linesOf(c.textOf("shape"));
  const std::string_view text = lines.empty() ? "lot 10x10" : trimmed(lines.front());
  const size_t blank = text.find(' ');
  const std::string_view kind = text.substr(0, blank);
  const std::string rest(blank == std::string_view::npos ? "" : trimmed(text.substr(blank)));
  double width = 0, depth = 0;
  int used = 0;
  const bool isExtent = std::sscanf(rest.c_str(), "%lfx%lf%n", &width, &depth, &used) == 2 &&
                        static_cast<size_t>(used) == rest.size();
  if (kind == "lot" && isExtent) return Shapes::lot(width, depth);
  if (kind == "face" && isExtent) return Shapes::face(width, depth);
  if (kind == "load" && !rest.empty()) {
    return Shapes::load((std::filesystem::path(folder) / rest).string(), limits);
  }
  const auto rings = ringsOf(rest, kind == "face" ? 3 : 2);
  if (rings.empty() || rings.front().empty()) return std::nullopt;
  if (kind == "polygon") return polygonOf(rings);
  if (kind == "face" && rings.size() == 1) return faceOf(rings.front());
  return std::nullopt;
}

}  // namespace gable::cases
