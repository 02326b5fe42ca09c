// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is written beyond what an operation takes is a mistake of the author, which would change
// the park in silence: arguments, braces and chances are counted here before they are lowered.
#include "base/text.h"
#include "dialects/park/lowering.h"
#include "dialects/park/operations.h"
#include "dialects/park/places.h"
#include "dialects/proposal.h"

namespace gable::park {

namespace {

enum class Braces { None, One, Many };

// Of operations whose own lowering does not read every argument and every part.
struct Usage {
  Operation operation;
  size_t least, most;
  Braces braces;
  bool otherwise;
  const char* written;
};

constexpr size_t kAny = static_cast<size_t>(-1);
using O = Operation;
constexpr Usage kUsages[] = {
    {O::Choose, 0, 0, Braces::Many, false, "Choose { A, 30%: B }"},
    {O::Select, 0, 0, Braces::Many, true, "Select { outer : A } else { B }"},
    {O::Joined, 0, 0, Braces::Many, true, "joined { A B }"},
    {O::QuadMap, 0, 2, Braces::Many, true, "QuadMap(3, 2) { A }"},
    {O::Colour, 1, 1, Braces::None, false, "Color(\"#79a052\") or Texture(\"gravel.jpg\")"},
    {O::Extrude, 1, 1, Braces::None, false, "Extrude(2)"},
    {O::Model, 1, 1, Braces::None, false, "loadModel(\"tree\")"},
    {O::NoHoles, 0, 0, Braces::None, false, "NoHoles"},
    {O::Contract, 1, kAny, Braces::None, true, "Contract(2)"},
    {O::Insert, 1, 1, Braces::One, true, "Insert(2), or Insert(2) { A }"},
    {O::Place, 0, kAny, Braces::One, true, "Place(CENTRE) { A }"},
    {O::Distribute, 0, kAny, Braces::One, true, "Distribute(OUTER : 0.5, 2) { A }"},
    {O::Scatter, 0, kAny, Braces::One, true, "Scatter(5 {1}) { A }"},
    {O::Sweep, 0, kAny, Braces::One, true, "Sweep(OUTER, width=1) { A }"},
    {O::Parametrise, 0, kAny, Braces::One, true, "Parametrise([0, 0.5]) { Contract(1) }"},
};

const Usage* usageOf(Operation operation) {
  for (const Usage& f : kUsages) {
    if (f.operation == operation) return &f;
  }
  return nullptr;
}

}  // namespace

void Lowering::checkUsage(const Op& op) {
  const Operation operation = operationNamed(op.name);
  if (operation == Operation::None) {
    if (g_.rule(op.name)) noBraces(op);
    return;
  }
  const Usage* usage = usageOf(operation);
  if (!usage) return;
  const size_t given = op.arguments.size();
  if (given < usage->least || given > usage->most) {
    const std::string takes = usage->most == 0              ? "no arguments"
                              : usage->most == usage->least ? "one argument"
                              : usage->most == kAny         ? "an argument"
                                                            : "two arguments";
    diagnostics_.error("wrong-argument-count",
                       given > usage->most ? spanOf(op, usage->most) : op.span,
                       "'" + op.name + "' takes " + takes + ", not " + std::to_string(given),
                       std::string("write ") + usage->written);
  }
  if (!usage->otherwise) noElse(op);
  if (usage->braces == Braces::None) noBraces(op);
  if (usage->braces == Braces::One) onePart(op, usage->written);
}

void Lowering::noBraces(const Op& op) {
  for (const Block& b : op.blocks) {
    // Empty ones say nothing.
    if (b.parts.empty()) continue;
    diagnostics_.error("too-many-blocks", b.span, "'" + op.name + "' has no use for this",
                       "write what comes next behind it, without braces");
  }
}

void Lowering::onePart(const Op& op, const char* written) {
  bool first = true;
  for (const Block& b : op.blocks) {
    for (const Part& p : b.parts) {
      if (!first) {
        diagnostics_.error(
            "too-many-blocks", p.span, "'" + op.name + "' has no use for this",
            std::string("all that it puts there stands in one pair of braces: ") + written);
      }
      if (first && !p.label.empty()) {
        diagnostics_.error("unknown-selector", placeOf(source_, p.span, p.label),
                           "'" + op.name + "' has no part called '" + p.label + "'",
                           std::string("write ") + written);
      }
      first = false;
    }
  }
}

void Lowering::checkShares(const std::vector<Part>& parts, Span whole) {
  if (parts.empty()) {
    diagnostics_.error("bad-argument", whole, "there is nothing to choose from",
                       "write Choose { A, 30%: B }");
  }
  double sum = 0;
  for (const Part& p : parts) {
    std::string share = p.label;
    if (!share.empty() && share.back() == '%') share.pop_back();
    double v = 0;
    if (share.empty()) continue;
    if (!constantValue(g_, share, v)) {
      diagnostics_.error("bad-argument", placeOf(source_, p.span, p.label),
                         "'" + p.label + "' is no chance", "write a number or a constant: 30% : A");
    }
    sum += v > 0 ? v : 0;
  }
  // Thirds of 33.4 are meant as they stand.
  constexpr double kRounding = 1;
  if (sum > 100 + kRounding) {
    diagnostics_.warning("weights-over-100", whole,
                         "these chances add up to more than 100 %; each is taken as a share of all",
                         "lower them, or leave one out: it gets the rest");
  }
}

void Lowering::checkStart(const Rule& r) {
  if (r.parameters.empty()) return;
  diagnostics_.warning("wrong-argument-count", r.nameSpan,
                       "nothing gives the first rule a value for '" + r.parameters[0] + "'",
                       "write a rule without parameters above it, to begin with");
}

// ParkPath(..): a name with arguments that nothing is made of.
void Lowering::warnOfArguments(const Op& op) {
  if (op.arguments.empty() || op.arguments[0].text.find_first_not_of(". ") == std::string::npos) {
    return;
  }
  const bool colour = isMaterialWord(op.name);
  diagnostics_.warning("undefined-rule", op.span,
                       colour ? "the colour '" + op.name + "' takes no arguments"
                              : "no rule or operation is named '" + op.name +
                                    "'; it becomes a leaf, and its arguments mean nothing",
                       colour ? "write " + op.name : "leave them out, or write a rule for it");
}

void Lowering::noElse(const Op& op) {
  if (!op.hasElse) return;
  diagnostics_.error("unexpected-text", op.span, "'" + op.name + "' has no use for else",
                     "leave it out: the operation cannot fail");
}

void Lowering::checkWords(const Op& op, size_t first,
                          std::initializer_list<std::string_view> words) {
  for (size_t i = first; i < op.arguments.size(); ++i) {
    std::string a = lowerCase(op.arguments[i].text);
    const size_t equals = a.find('=');
    if (equals != std::string::npos) a = a.substr(0, a.find_last_not_of(' ', equals - 1) + 1) + '=';
    if (std::find(words.begin(), words.end(), a) != words.end()) continue;
    const std::string nearest = nearestName(a, words);
    std::string hint = meaning(nearest);
    for (const std::string_view w : words) {
      if (!nearest.empty()) break;
      hint += (hint.empty() ? "it knows " : ", ") + std::string(w);
    }
    diagnostics_.error("bad-argument", op.arguments[i].span,
                       "'" + op.arguments[i].text + "' is nothing that '" + op.name + "' knows",
                       hint);
    const std::string& written = op.arguments[i].text;
    if (equals == std::string::npos) {
      propose(diagnostics_, placeOf(source_, op.arguments[i].span, written), written, nearest);
    }
  }
}

}  // namespace gable::park
