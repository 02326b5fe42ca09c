// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The work of lower(): rules, sequences and arguments in lower.cpp, one operation of the notation
// each in lower_operations.cpp.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dialects/gbbg/tree_builder.h"
#include "dialects/park/lower.h"
#include "dialects/park/meanings.h"
#include "lang/region_texts.h"
#include "lang/tree.h"

namespace gable::park {

using lang::kNoNode;
using lang::NodeId;
using Nodes = std::vector<NodeId>;

constexpr double kPathWidth = 3;

class Lowering {
 public:
  Lowering(const Grammar& g, const LowerInput& input, Diagnostics& diagnostics)
      : g_(g), source_(input.source), files_(input), b_(input.file), diagnostics_(diagnostics) {
    while (g.rule(modelFile_) || g.constants.count(modelFile_) != 0) modelFile_ += '_';
  }

  lang::Tree run();

 private:
  // --- Rules ---

  NodeId rule(const Rule& r, bool start);

  NodeId colour(std::string_view name);

  // --- Sequences ---

  // `owner` names the leaf that the region itself becomes; none for parts that stand for nothing.
  NodeId sequence(const Sequence& ops, std::string_view owner);
  void addSteps(const Sequence& ops, std::string_view owner, Nodes& out);
  // In the colour that its name suggests, unless it has one.
  void addLeaf(std::string_view name, Nodes& out);

  // Adds what an operation becomes; false when the region has been given away by it.
  bool step(const Op& op, Nodes& out);

  bool symbol(const Op& op, Nodes& out);

  void call(const Rule& r, const Op& op, Nodes& out);
  void warnOfSlip(const Op& op);
  void warnOfColour(const Op& op);

  // The steps of a function, with the arguments in the place of its parameters.
  void wrongCount(const std::string& mistake, Span span);
  // Tells why a function cannot stand in the place of its call; false then.
  bool canInline(const Rule& r, const Op& op);
  bool inlined(const Rule& r, const Op& op, Nodes& out);

  // --- Blocks ---

  // The parts of an operation's blocks by what they are for: { r } { p } { c }, { r | p | c }, or
  // with names.
  struct Slots {
    std::vector<const Part*> part;
    // Braces with nothing in them, which is not the same as none.
    std::vector<bool> empty;
  };
  Slots slotsOf(const Op& op, const std::vector<std::vector<std::string>>& names);

  NodeId item(const char* word, const Part* p, const char* otherwise);
  /// Nothing where the braces say so.
  NodeId item(const char* word, const Slots& s, size_t i, const char* otherwise);
  void addElse(const Op& op, Nodes& items);

  // Of an operation that only has a block for what stands behind else.
  NodeId elseBlock(const Op& op);

  // --- Checks: what is written beyond what an operation takes ---

  // The number of its arguments, and its braces.
  void checkUsage(const Op& op);
  void noElse(const Op& op);
  void noBraces(const Op& op);
  void onePart(const Op& op, const char* written);
  // Of the parts of a Choose.
  void checkShares(const std::vector<Part>& parts, Span whole);
  void checkStart(const Rule& r);
  void warnOfArguments(const Op& op);
  // What an operation does not know is an error: arguments from `first` on that are none of the
  // words, and do not begin with one that ends in =.
  void checkWords(const Op& op, size_t first, std::initializer_list<std::string_view> words);

  // --- Arguments ---

  std::string text(const Op& op, size_t i) const;
  Span spanOf(const Op& op, size_t i) const;
  NodeId expressionOf(std::string_view text, Span span);
  // The same of a truth; what cannot be read is reported once.
  NodeId conditionOf(std::string_view text, Span span);
  // A number that is known before the rule runs.
  bool known(std::string_view text, double& value) const;
  bool isParameter(const std::string& word) const;
  // An expression of the language, as it stands there; w and the like are those of the region.
  NodeId node(const std::string& expression, std::string_view written, Span span);
  std::string number(std::string_view written, Span span);
  NodeId number(const Op& op, size_t i, double otherwise);
  NodeId numberOf(std::string written, Span span);
  NodeId pathWidth();

  // Short forms that the operations on regions take; see lang/region_texts.h.
  using Form = std::string (lang::RegionTexts::*)(std::string_view);
  NodeId formed(Form form, std::string_view written, Span span);
  void unreadable(std::string_view written, Span span);
  void dimension(const Op& op, size_t i, const char* count, const char* sizes, const char* angles,
                 Nodes& arguments);

  // name=value arguments from `first` on, by the names that the language has for them.
  struct Option {
    std::string_view name;
    const char* argument;
    enum class Takes { Number, Word, Flag, Lowered } takes;
  };
  void options(const Op& op, size_t first, std::initializer_list<Option> known, Nodes& arguments);
  void flags(const Op& op, size_t first, std::initializer_list<std::string_view> known,
             Nodes& arguments);

  // --- Operations ---

  void grid(const Op& op, Nodes& out);
  void gridOptions(const Op& op, Nodes& arguments);
  static bool isDeep(const Slots& s, size_t i);

  // What stands at a junction or in a centre: a figure, or a choice among figures. Where the block
  // leaves no flat ground the figure itself is a leaf of its own.
  NodeId figureItem(NodeId head, const Part& p, bool together);
  NodeId figureBody(const Sequence& body, std::string_view owner, bool ground);
  NodeId choiceBody(const JunctionChoices& choices);
  NodeId centreItem(const Slots& s, size_t i, const std::string& size, Span span);
  Nodes flattened(const Nodes& steps);
  NodeId figureNode(const Op& op);
  bool mayInline(const Rule& r) const;

  // The region becomes the figures in one; what else stands in the braces is done with that.
  void joined(const Op& op, Nodes& out);
  void joinedLater(const Op& op, const Sequence& parts, Nodes& out);

  // Each part takes the region when its selection means an edge of it; the first that does.
  void select(const Op& op, Nodes& out);

  void quadMap(const Op& op, Nodes& out);

  void voronoi(const Op& op, Nodes& out);

  void rays(const Op& op, Nodes& out);
  void rayOptions(const Op& op, Nodes& arguments);

  void peel(const Op& op, Nodes& out);
  NodeId ownWidths(const std::string& written, Span span);

  void choose(const Op& op, Nodes& out);
  void look(const Op& op, Nodes& out);

  void model(const Op& op, Nodes& out);
  void checkModel(const Op& op, const std::string& file, bool typed);
  // The function that finds the file of a model by its name without a type.
  NodeId modelFile();

  void innerRect(const Op& op, Nodes& out);

  // With a centre, what is 0.9 or less is a share of the way to it.
  void contract(const Op& op, Nodes& out);

  // Cuts discs off the outer corners.
  void insert(const Op& op, Nodes& out);

  void figure(const Op& op, Nodes& out);

  NodeId things(const Op& op);
  /// Flat things are cut out of their ground.
  bool endsFlat(const Op& op) const;

  void place(const Op& op, Nodes& out);

  // sel : inset, positions
  void distribute(const Op& op, Nodes& out);
  void positions(const std::string& written, Span span, Nodes& arguments);

  void scatter(const Op& op, Nodes& out);

  // What stands behind the equals sign.
  static std::string valueOf(const std::string& text);

  void sweep(const Op& op, Nodes& out);

  void lines(const Op& op, Nodes& out);
  NodeId onFigure(const std::string& figure, Span span, NodeId operation);
  // Rules and constants that nothing names.
  void warnOfUnused();

  const Grammar& g_;
  std::string_view source_;
  LowerInput files_;
  // Those that were told already.
  std::set<std::string> missedModels_;
  gbbg::TreeBuilder b_;
  Diagnostics& diagnostics_;
  const Rule* rule_ = nullptr;
  // Functions within functions, from the outermost, and how many calls of them there were.
  std::vector<const Rule*> functions_;
  size_t functionCalls_ = 0;
  // Rules in the place of their names.
  int inlined_ = 0;
  // An operation of the sequence at work has given a colour or a picture.
  bool coloured_ = false;
  // Some model is named without the type of its file.
  bool models_ = false;
  std::string modelFile_ = "modelFile";
};

}  // namespace gable::park
