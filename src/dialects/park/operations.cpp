// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/park/operations.h"

#include <vector>

#include "base/text.h"
#include "dialects/park/grammar.h"

namespace gable::park {

std::span<const OperationName> operationNames() {
  using O = Operation;
  static constexpr OperationName kNames[] = {
      {"Grid", O::Grid},
      {"QuadMap", O::QuadMap},
      {"VoronoiRegions", O::Voronoi},
      {"VoronoiSmoothed", O::Voronoi},
      {"Voronoi", O::Voronoi},
      {"FFRegions", O::Voronoi},
      {"Cells", O::Voronoi},
      {"CastRays", O::Rays},
      {"RayCast", O::Rays},
      {"Beam", O::Rays},
      {"Rays", O::Rays},
      {"Peel", O::Peel},
      {"Contract", O::Contract},
      {"InnerRect", O::InnerRect},
      {"NoHoles", O::NoHoles},
      {"Insert", O::Insert},
      {"Place", O::Place},
      {"Distribute", O::Distribute},
      {"Scatter", O::Scatter},
      {"ScatterCircles", O::Scatter},
      {"Sweep", O::Sweep},
      {"DistributeSmooth", O::Sweep},
      {"SmoothDistribute", O::Sweep},
      {"Parametrise", O::Parametrise},
      {"Circle", O::Figure},
      {"Romb", O::Figure},
      {"RombCenter", O::Figure},
      {"Square", O::Figure},
      {"Rect", O::Figure},
      {"Polygon", O::Figure},
      {"joined", O::Joined},
      {"Choose", O::Choose},
      {"Select", O::Select},
      {"Extrude", O::Extrude},
      {"Color", O::Colour},
      {"Colour", O::Colour},
      {"Texture", O::Colour},
      {"loadModel", O::Model},
  };
  return kNames;
}

Operation operationNamed(std::string_view name) {
  const std::string low = lowerCase(name);
  for (const OperationName& n : operationNames()) {
    if (lowerCase(n.name) == low) return n.operation;
  }
  return Operation::None;
}

const char* wordForCga(std::string_view name) {
  constexpr const char* kWords[][2] = {
      {"split", "Grid(3, 2) { A }"},
      {"splitGrid", "Grid(3, 2) { A }"},
      {"splitArea", "Grid(3, 2) { A }"},
      {"voronoi", "Voronoi(sites) { A } { B }"},
      {"quadMap", "QuadMap(3, 2) { A }"},
      {"castRays", "CastRays(CENTRE, Corners(Region)) { A } { B }"},
      {"offset", "Contract(2)"},
      {"contract", "Contract(2)"},
      {"setback", "Peel(OUTER, 2) { A | B }"},
      {"peel", "Peel(OUTER, 2) { A | B }"},
      {"comp", "Select { OUTER : A } else { B }"},
      {"innerRectangle", "InnerRect { shape: A | remainder: B }"},
      {"innerRect", "InnerRect { shape: A | remainder: B }"},
      {"deleteHoles", "NoHoles"},
      {"scatter", "Scatter(20 {1}) { A }"},
      {"scatterSpaced", "Scatter(20 {1}) { A }"},
      {"i", "loadModel(\"tree\")"},
      {"insert", "loadModel(\"tree\")"},
      {"primitiveDisk", "Circle(3)"},
      {"primitiveCylinder", "Circle(3)"},
      {"primitiveQuad", "Rect(3, 2)"},
      {"rhombus", "Romb(3)"},
      {"sweep", "Sweep(OUTER, width=1) { A }"},
      {"set", "Color(\"#79a052\") or Texture(\"gravel.jpg\")"},
  };
  for (const auto& [cga, own] : kWords) {
    if (name == cga) return own;
  }
  return nullptr;
}

std::string nearestOperation(std::string_view name) {
  std::vector<std::string> all;
  for (const OperationName& n : operationNames()) all.push_back(lowerCase(n.name));
  const std::string nearest =
      nearestName(lowerCase(name), std::vector<std::string_view>(all.begin(), all.end()));
  for (const OperationName& n : operationNames()) {
    if (lowerCase(n.name) == nearest) return n.name;
  }
  return {};
}

}  // namespace gable::park
