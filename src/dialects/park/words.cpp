// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The words of park grammars for editors.

#include "dialects/dialect.h"

namespace gable::park {

std::span<const DialectWord> words() {
  static constexpr DialectWord kWords[] = {
      {"Grid", "Grid(columns, rows) { region } { path } { junction }", "grid", "",
       "Grid(${1:2}, ${2:2}) { ${3:Region} } { ${4:Path} } { }"},
      {"VoronoiRegions", "VoronoiRegions(sites, smooth) { region } { path }", "voronoi", "",
       "VoronoiRegions(${1:5}) { ${2:Region} } { ${3:Path} }"},
      {"Voronoi", "Voronoi(sites) { region } { path }", "voronoi", "", ""},
      {"VoronoiSmoothed", "VoronoiSmoothed(sites) { region } { path }", "voronoi", "", ""},
      {"CastRays", "CastRays(source, targets) { centre } { region }", "castRays", "",
       "CastRays(${1:CENTRE}, ${2:corners}) { ${3:Plaza} } { ${4:Sector} }"},
      {"Peel", "Peel(selection, size) { strip | rest }", "peel", "",
       "Peel(${1:OUTER}) { ${2:0.75}: ${3:Strip} | ${4:Rest} }"},
      {"Contract", "Contract(distance)", "contract", "", ""},
      {"QuadMap", "QuadMap(columns, rows) { region }", "quadMap", "", ""},
      {"Insert", "Insert(radius)", nullptr, "Cuts discs off the corners on the border.", ""},
      {"NoHoles", "NoHoles", "cutHoles", "", ""},
      {"Select", "Select { selection : A } else { B }", nullptr,
       "The first part whose selection means an edge of the region.", ""},
      {"Extrude", "Extrude(height)", "extrude", "", ""},
      {"Color", "Color(\"#79a052\")", "color", "", ""},
      {"Texture", "Texture(\"gravel.jpg\")", "texture", "", ""},
      {"Place", "Place(where) { figure }", "place", "", "Place(${1:CENTRE}) { ${2:Bed} }"},
      {"Distribute", "Distribute(selection : inset, spacing) { figure }", "distribute", "",
       "Distribute(${1:OUTER_EDGE}: ${2:0.4}, ${3:2}) { ${4:Tree} }"},
      {"ScatterCircles", "ScatterCircles(count {radius})", "scatterCircles", "", ""},
      {"Scatter", "Scatter(count)", "scatterCircles", "", ""},
      {"Sweep", "Sweep(lines)", "sweep", "", ""},
      {"DistributeSmooth", "DistributeSmooth(lines)", "sweep", "", ""},
      {"Parametrise", "Parametrise(ranges, figure)", "parametrise", "", ""},
      {"InnerRect", "InnerRect { shape: A | remainder: B }", "innerRectangle", "", ""},
      {"Choose", "Choose { A, 30%: B }", nullptr, "One of several, by chance.",
       "Choose { ${1:A}, 30%: ${2:B} }"},
      {"joined", "joined { Romb(r) P }", nullptr, "Paths and their junctions as one shape.", ""},
      {"loadModel", "loadModel(\"tree\")", "i",
       "A model of the project, or one that comes with Gable, fitted to the place.", ""},
      {"Circle", "Circle(radius)", "circle", "", ""},
      {"Romb", "Romb(radius)", "rhombus", "", ""},
      {"Square", "Square(side)", "square", "", ""},
      {"Rect", "Rect(width, height)", "rect", "", ""},
      {"Polygon", "Polygon(radius, sides)", "regularPolygon", "", ""},
      {"OUTER", "OUTER", nullptr, "Sides on the border of the park.", ""},
      {"INNER", "INNER", nullptr, "Sides along paths.", ""},
      {"CENTRE", "CENTRE", nullptr, "The middle of the region, always inside.", ""},
      {"case", "case condition: operations else: operations", nullptr,
       "Operations under a condition; w and h are the region's width and height.", ""},
      {"fun", "fun Name(parameters) -> operations", nullptr, "Operations under a name.", ""},
  };
  return kWords;
}

}  // namespace gable::park
