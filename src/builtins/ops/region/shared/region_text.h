// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The small texts that operations on regions take: selections of edges, sizes of grids, figures.
// Words do not mind capitals.
//
//   selection  outer & !side(W)      see the page of peel for all words
//   dimension  3 { [7,15] a[-15,15], 4 }
//   figure     romb(3)  circle(2.5)  square(4)  rect(4, 2)  polygon(6, 3)
//   range      [7,15]  [7-15]  7
//
// A text that cannot be read gives false and says in `problem` what is wrong with it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "builtins/ops/region/shared/region_shape.h"
#include "geom/region/along.h"
#include "geom/region/grid_partition.h"
#include "geom/region/places.h"

namespace gable {

/// Reads words, numbers and signs of a text, skipping blanks.
class TextReader {
 public:
  explicit TextReader(std::string_view text) : text_(text) {}

  bool atEnd();
  /// The next sign, or 0.
  char peek();
  bool accept(char c);
  bool accept(std::string_view sign);
  /// Letters, digits and _, in lower case; empty where none begins.
  std::string word();
  bool number(double& v);
  bool range(DrawnRange& r);
  size_t place() const { return at_; }
  void goTo(size_t place) { at_ = place; }

 private:
  void skip();
  std::string_view text_;
  size_t at_ = 0;
};

bool readDimension(std::string_view text, GridDim& out, std::string& problem);
bool readFigure(std::string_view text, PlanFigure& out, std::string& problem);

/// "(3, 4) (10, 4, 2.5)", perhaps in points( .. ) or [ .. ]: places from the south-west corner of
/// the region's box, and discs where a radius follows. False when the text is no such list.
bool readPoints(std::string_view text, std::vector<Disc>& out);

/// The value of `name=value` in a list of options, in lower case; empty when it is not there, "1"
/// for a word alone. A value goes on to the next blank or comma outside of brackets.
std::string option(std::string_view options, std::string_view name);

/// Whether options are among the known ones: "fit=stretch|center|fail sliver=# smooth=* lines"
/// knows words, numbers, any text, and a word that stands alone.
bool checkOptions(std::string_view options, std::string_view known, std::string& problem);

struct SelectionInput {
  const RegionView& view;
  /// For random(p).
  uint64_t seed = 0;
  /// From the world to the plane of the region, for world.W and the like; asked only for these.
  std::function<Frame()> world;
};

/// The parts of edges that a selection means, ascending.
bool selectEdges(std::string_view text, const SelectionInput& input, std::vector<EdgePart>& out,
                 std::string& problem);

/// Ranges along logical edges, "[0.02,1] [0,1] [0,0.15] 0": an entry for each logical edge from 0
/// on; [] and 0 are none, _ the whole. False when the text is no such list.
bool readRanges(std::string_view text, std::vector<LogicalRange>& out);

}  // namespace gable
