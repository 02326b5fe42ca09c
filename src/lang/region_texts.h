// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The short forms in which park grammars, and rule files before selections were expressions, say
// what an operation on regions takes: "outer & !W", "3 {[2,4] a[-5,5]}", "[0.02,1] [0,1]",
// "circle(3)". Each is rewritten as an expression of the language:
//
//   outer & !W               outer && !side(west)
//   3 {[2,4] a[-5,5]}        3, sizes [rand(2, 4)], angles [rand(-5, 5)]
//   [0.02,1] _ 0             edge(0, 0.02, 1) || edge(1)
//   (0.2, 0.5) (0.8, 0.5)    at(0.2, 0.5) || at(0.8, 0.5)
//   5 {[5-10]}               5, radius rand(5, 10)
//
// Numbers are any expressions; what they become is up to `number`.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gable::lang {

class RegionTexts {
 public:
  using Number = std::function<std::string(std::string_view)>;
  RegionTexts() = default;
  explicit RegionTexts(Number number) : number_(std::move(number)) {}

  /// Words that mean nothing become words of the expression, for the analysis to report; otherwise
  /// they are problems.
  void keepUnknown() { keepUnknown_ = true; }

  // Empty where the text cannot be read; problem() then says why, and word() which word is wrong.
  std::string selection(std::string_view text);
  std::string lines(std::string_view text);
  std::string places(std::string_view text);
  std::string targets(std::string_view text);
  std::string figure(std::string_view text);
  std::string smoothing(std::string_view text);
  std::string profile(std::string_view text);
  /// "[a,b]", "[a-b]" or one number.
  std::string drawn(std::string_view text);

  struct Sites {
    std::string sites, radius;
  };
  Sites sites(std::string_view text);
  struct Dimension {
    std::string count, sizes, angles;
    bool read = false;
  };
  Dimension dimension(std::string_view text);

  /// name=value and words, divided by blanks or commas.
  static std::vector<std::pair<std::string, std::string>> options(std::string_view text);

  const std::string& problem() const { return problem_; }
  /// The words that a selection knows, for suggestions.
  static const std::vector<std::string_view>& words();
  const std::string& word() const { return word_; }

 private:
  friend class RegionReader;
  Number number_;
  std::string problem_, word_;
  bool keepUnknown_ = false;
};

}  // namespace gable::lang
