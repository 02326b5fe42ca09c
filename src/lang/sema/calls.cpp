// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Calls. Each argument is visited once, with what the signatures left over by count expect in its
// place; the types that come out choose the signature. So the cost is linear however deep calls
// nest.

#include <algorithm>

#include "base/number.h"
#include "lang/other_languages.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

bool hasWord(const char* words, std::string_view word) { return wordIndex(words, word) >= 0; }

// The words of a list with blanks between.
std::vector<std::string_view> listed(std::string_view words) {
  std::vector<std::string_view> out;
  while (!words.empty()) {
    const size_t end = std::min(words.find(' '), words.size());
    out.push_back(words.substr(0, end));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return out;
}

std::string countText(std::span<const Signature> signatures) {
  std::vector<size_t> counts;
  bool open = false;
  for (const Signature& s : signatures) {
    for (size_t n = s.requiredCount(); n <= s.params.size(); ++n) counts.push_back(n);
    open = open || s.variadic;
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  if (counts.empty()) return "no arguments";
  std::string out;
  for (size_t i = 0; i < counts.size(); ++i) {
    out += (i == 0 ? "" : i + 1 == counts.size() ? " or " : ", ") + std::to_string(counts[i]);
  }
  if (open) out += " or more";
  if (counts == std::vector<size_t>{0}) return "no arguments";
  return out + (counts == std::vector<size_t>{1} ? " argument" : " arguments");
}

// The form that comes closest to a number of arguments; the first of several.
const Signature& nearestByCount(std::span<const Signature> forms, size_t count) {
  const auto distance = [&](const Signature& s) {
    const size_t least = s.requiredCount(), most = s.params.size();
    return count < least ? least - count : count > most ? count - most : 0;
  };
  return *std::min_element(forms.begin(), forms.end(), [&](const Signature& a, const Signature& b) {
    return distance(a) < distance(b);
  });
}

}  // namespace

// What may be left out stands in brackets.
std::string Analysis::signatureText(std::string_view name, const Signature& s) {
  std::string out = std::string(name) + "(";
  for (size_t i = 0; i < s.params.size(); ++i) {
    const bool optional = s.params[i].defaultText != nullptr;
    out += std::string(i ? ", " : "") + (optional ? "[" : "") + s.params[i].name +
           (optional ? "]" : "");
  }
  return out + (s.variadic ? ", ...)" : ")");
}

std::span<const NodeId> Analysis::arguments(NodeId list) const { return tree().children(list); }

bool Analysis::acceptsCount(std::span<const Signature> signatures, size_t count) const {
  return std::any_of(signatures.begin(), signatures.end(),
                     [&](const Signature& s) { return s.acceptsCount(count); });
}

void Analysis::checkNamedArguments(std::span<const NodeId> args) {
  for (const NodeId a : args) {
    const NodeKind kind = tree().kind(a);
    if (kind == NodeKind::NamedArg) {
      errorAt("unexpected-assignment", a, quote(text(a)) + " cannot be set in these brackets",
              "write only the value, in the order of the parameters");
    } else if (kind == NodeKind::Rule) {
      errorAt("unexpected-assignment", a, "a rule cannot be defined in these brackets",
              "define it outside");
    }
  }
}

// ' and ~ only where a size is asked for.
void Analysis::checkPrefix(NodeId node, const std::vector<const ParamSpec*>& params) {
  const NodeKind kind = tree().kind(node);
  if (kind != NodeKind::Relative && kind != NodeKind::Floating) return;
  const bool floating = kind == NodeKind::Floating;
  const bool allowed = std::any_of(params.begin(), params.end(), [&](const ParamSpec* p) {
    return p->type == ParamType::FloatingSize || (p->type == ParamType::Size && !floating);
  });
  if (allowed) return;
  errorAt("bad-prefix", node,
          std::string(floating ? "'~'" : "a size relative to the scope") + " is not allowed here",
          floating ? "remove the '~'" : "multiply by scope.sx, scope.sy or scope.sz instead");
  const uint32_t sign = tree()[node].begin;
  if (floating) fix({tree().file(), sign, sign + 1}, "");
}

// One argument, with the parameters that it may be for.
ValueType Analysis::visitArgument(NodeId node, const std::vector<const ParamSpec*>& params) {
  for (const ParamSpec* p : params) {
    switch (p->type) {
      case ParamType::Selection: visitSelection(node, *p); return ValueType::Null;
      case ParamType::DrawnList: visitDrawnList(node); return ValueType::Null;
      default: break;
    }
  }
  checkPrefix(node, params);
  const bool wantsWord = std::any_of(params.begin(), params.end(), [](const ParamSpec* p) {
    return p->type == ParamType::Selector;
  });
  if (wantsWord && tree().kind(node) == NodeKind::Name) return visitSelectorWord(node, params);
  if (tree().kind(node) == NodeKind::String) checkWrittenWord(node, params);
  ValueType expected = params.empty() ? ValueType::Null : valueType(params[0]->type);
  for (const ParamSpec* p : params) {
    if (valueType(p->type) != expected) expected = ValueType::Null;
  }
  return visit(node, expected == ValueType::Selector ? ValueType::Null : expected);
}

// A text may stand for a word; one that is written out must be one of them.
void Analysis::checkWrittenWord(NodeId node, const std::vector<const ParamSpec*>& params) {
  std::string list;
  for (const ParamSpec* p : params) {
    // What takes no text says nothing about this one.
    if (!fits(ValueType::String, p->type)) continue;
    const bool word = p->type == ParamType::Selector || p->type == ParamType::String;
    if (!word || !p->words || hasWord(p->words, text(node))) return;
    list += (list.empty() ? "" : " ") + std::string(p->words);
  }
  if (!list.empty()) {
    const std::string nearest = near(text(node), [&] { return listed(list); });
    errorAt("unknown-selector", node, quote(text(node)) + " is not known here",
            nearest.empty() ? "one of: " + list : nearest);
  }
}

size_t Analysis::parameterOf(const Signature& s, std::span<const NodeId> args, size_t i) const {
  if (tree().kind(args[i]) != NodeKind::NamedArg) return s.paramAt(i) ? i : kNoParameter;
  for (size_t p = 0; p < s.params.size(); ++p) {
    if (text(args[i]) == s.params[p].name) return p;
  }
  return kNoParameter;
}

bool Analysis::hasNames(std::span<const NodeId> args) const {
  return std::any_of(args.begin(), args.end(),
                     [&](NodeId a) { return tree().kind(a) == NodeKind::NamedArg; });
}

bool Analysis::areNamesLast(std::span<const NodeId> args) const {
  return std::is_partitioned(args.begin(), args.end(),
                             [&](NodeId a) { return tree().kind(a) != NodeKind::NamedArg; });
}

// By count alone where no argument has a name. Else every argument needs a parameter of its own,
// and every parameter without a default an argument.
std::vector<uint16_t> Analysis::signaturesByShape(const CallTarget& target,
                                                  std::span<const NodeId> args) {
  const auto fitsShape = [&](const Signature& s) {
    if (s.variadic) return s.acceptsCount(args.size());
    std::vector<bool> given(s.params.size());
    for (size_t i = 0; i < args.size(); ++i) {
      const size_t p = parameterOf(s, args, i);
      if (p == kNoParameter || given[p]) return false;
      given[p] = true;
    }
    for (size_t p = 0; p < given.size(); ++p) {
      if (!given[p] && s.params[p].defaultText == nullptr) return false;
    }
    return true;
  };
  std::vector<uint16_t> left;
  if (!areNamesLast(args)) return left;
  for (size_t i = 0; i < target.signatures.size(); ++i) {
    if (fitsShape(target.signatures[i])) left.push_back(static_cast<uint16_t>(i));
  }
  return left;
}

// Of a call with one form: a parameter that got two arguments, or none and has no default.
bool Analysis::reportMissingArgument(const CallTarget& target, std::span<const NodeId> args) {
  const Signature& s = target.signatures[0];
  std::vector<bool> given(s.params.size());
  for (size_t i = 0; i < args.size(); ++i) {
    const size_t p = parameterOf(s, args, i);
    if (p == kNoParameter) return false;
    if (given[p]) {
      errorAt("wrong-argument", args[i],
              quote(s.params[p].name) + " is given twice, by its place and by its name",
              "remove one of them");
      return true;
    }
    given[p] = true;
  }
  for (size_t p = 0; p < given.size(); ++p) {
    if (given[p] || s.params[p].defaultText != nullptr) continue;
    errorAt("wrong-argument-count", target.node,
            quote(target.name) + " needs " + quote(s.params[p].name) + " as well",
            "write " + signatureText(target.name, s));
    return true;
  }
  return false;
}

// Says which name is wrong, or else that the arguments do not go together.
void Analysis::reportNamedArguments(const CallTarget& target, std::span<const NodeId> args) {
  std::vector<std::string_view> names;
  for (const Signature& s : target.signatures) {
    for (const ParamSpec& p : s.params) names.push_back(p.name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string list;
  for (const std::string_view n : names) list += (list.empty() ? "" : ", ") + std::string(n);
  bool named = false;
  for (size_t i = 0; i < args.size(); ++i) {
    const bool hasName = tree().kind(args[i]) == NodeKind::NamedArg;
    if (!hasName && named) {
      errorAt("wrong-argument", args[i], "an argument without a name stands behind one with a name",
              "write its name before it, or put it first");
      return;
    }
    named = named || hasName;
    if (!hasName) continue;
    if (!std::binary_search(names.begin(), names.end(), text(args[i]))) {
      const std::string nearest = near(text(args[i]), [&] { return names; });
      errorAt("unknown-argument", args[i],
              quote(target.name) + " has no parameter " + quote(text(args[i])),
              !nearest.empty() ? nearest
              : list.empty()   ? "it takes no arguments"
                               : "its parameters are: " + list);
      return;
    }
    for (size_t j = 0; j < i; ++j) {
      if (tree().kind(args[j]) != NodeKind::NamedArg || text(args[j]) != text(args[i])) continue;
      errorAt("wrong-argument", args[i], quote(text(args[i])) + " is given twice", "remove one");
      return;
    }
  }
  if (target.signatures.size() == 1 && reportMissingArgument(target, args)) return;
  std::string forms;
  for (const Signature& s : target.signatures) {
    forms += (forms.empty() ? "" : " or ") + signatureText(target.name, s);
  }
  errorAt("wrong-argument-count", target.node,
          "these arguments of " + quote(target.name) + " do not go together, or one is missing",
          "write " + forms);
}

// The nearest form of a call. The names of some operations do in other languages what a shorter one
// does here: 'translate(0, 1, 0)' is 't(0, 1, 0)'.
std::string Analysis::formHint(const CallTarget& target, size_t count) const {
  if (target.signatures.empty()) return {};
  const ForeignWord* shorter =
      catalogue_.operation(target.name) ? foreignWord(ForeignUse::Operation, target.name) : nullptr;
  return "write " + signatureText(target.name, nearestByCount(target.signatures, count)) +
         (shorter && !shorter->instead.empty()
              ? ", or the shorter '" + std::string(shorter->instead) + "'"
              : std::string());
}

// What to write in the place of a value of the wrong type, in a call of `target`.
std::string Analysis::mismatchHint(std::string_view target, NodeId node, const ParamSpec& param,
                                   ValueType type) const {
  const bool drawn = param.type == ParamType::Drawn && type == ValueType::FloatArray;
  if (drawn && tree().kind(node) == NodeKind::Array && tree().children(node).size() == 1) {
    const std::span<const NodeId> row = tree().children(tree().children(node)[0]);
    const auto written = [&](NodeId n) {
      const Span span = tree().span(n);
      return std::string(sources_.text(span.file).substr(span.begin, span.end - span.begin));
    };
    if (row.size() == 2) {
      return "write rand(" + written(row[0]) + ", " + written(row[1]) +
             ") for a number between the two";
    }
  }
  double number = 0;
  if (valueType(param.type) == ValueType::Float && tree().kind(node) == NodeKind::String &&
      parseNumber(text(node), number)) {
    return "remove the quotes: " + std::string(text(node));
  }
  if (valueType(param.type) == ValueType::String && tree().kind(node) == NodeKind::Number) {
    return "write it in quotes: \"" + shortestText(tree().number(node)) + "\"";
  }
  const AttributeInfo* named = attributeAt(node);
  const ValueType wanted = valueType(param.type);
  const bool list = type == ValueType::FloatArray || type == ValueType::StringArray ||
                    type == ValueType::BoolArray;
  if (list && target == "len") return "write size(array) for the number of its values";
  if (named && list) return "take one value of the list, such as " + named->name + "[0]";
  if (named && wanted != ValueType::Null) return typeRemedy(*named, wanted);
  // A sum is a text where one of its parts is.
  if (tree().kind(node) == NodeKind::Binary && wanted == ValueType::Float) {
    for (const NodeId part : tree().children(node)) {
      const AttributeInfo* const a = attributeAt(part);
      if (a && a->type == type) return typeRemedy(*a, wanted);
    }
  }
  return "it is: " + docText(param);
}

// What to write where a name is a word of another parameter than the one in its place; empty where
// it is none.
std::string Analysis::wordOfOther(const CallTarget& target, NodeId node,
                                  const std::vector<const ParamSpec*>& params) const {
  if (tree().kind(node) != NodeKind::Name) return {};
  const auto takes = [&](const ParamSpec& p) {
    return p.type == ParamType::Selector && hasWord(p.words, text(node));
  };
  if (std::any_of(params.begin(), params.end(), [&](const ParamSpec* p) { return takes(*p); }))
    return {};
  for (const Signature& s : target.signatures) {
    for (const ParamSpec& p : s.params) {
      if (!takes(p)) continue;
      return quote(text(node)) + " is a word of the parameter " + quote(p.name) + ": write " +
             quote(std::string(p.name) + " = " + std::string(text(node)));
    }
  }
  return {};
}

// Visits one argument, and strikes out the signatures that its word or its type does not fit.
ValueType Analysis::visitArgumentFor(const CallTarget& target, std::span<const NodeId> args,
                                     size_t i, std::vector<uint16_t>& left, bool& isFit) {
  const bool named = tree().kind(args[i]) == NodeKind::NamedArg;
  const NodeId value = argumentValue(tree(), args[i]);
  const auto paramOf = [&](uint16_t s) -> const ParamSpec& {
    const Signature& signature = target.signatures[s];
    return *signature.paramAt(parameterOf(signature, args, i));
  };
  // A word that only some signatures know decides between them.
  if (tree().kind(value) == NodeKind::Name) {
    const auto knows = [&](uint16_t s) {
      const ParamSpec& p = paramOf(s);
      return p.type == ParamType::Selector && hasWord(p.words, text(value));
    };
    if (std::any_of(left.begin(), left.end(), knows)) {
      left.erase(std::remove_if(left.begin(), left.end(), [&](uint16_t s) { return !knows(s); }),
                 left.end());
    }
  }
  std::vector<const ParamSpec*> params;
  for (const uint16_t s : left) params.push_back(&paramOf(s));
  wordHint_ = named ? std::string() : wordOfOther(target, value, params);
  const ValueType type = visitArgument(value, params);
  const std::string wordHint = std::exchange(wordHint_, {});
  std::vector<uint16_t> fitting;
  for (const uint16_t s : left) {
    if (fits(type, paramOf(s).type)) fitting.push_back(s);
  }
  if (!fitting.empty()) {
    left = std::move(fitting);
    return type;
  }
  reportMisfit(target, "type-mismatch", value,
               quote(params[0]->name) + " of " + quote(target.name) + " is a " + typeName(type) +
                   ", not a " + typeName(valueType(params[0]->type)),
               wordHint.empty() ? mismatchHint(target.name, value, *params[0], type) : wordHint);
  isFit = false;
  return type;
}

// An operation whose arguments fit none of its forms is another name to CGA: a rule without
// definition.
void Analysis::reportMisfit(const CallTarget& target, const char* code, NodeId node,
                            std::string message, std::string hint) {
  if (!target.mayBeLeaf) return errorAt(code, node, std::move(message), std::move(hint));
  warning(code, tree().span(node), std::move(message) + "; so the call is a leaf", std::move(hint));
}

std::span<const NodeId> Analysis::orderArguments(NodeId node, const Signature& s,
                                                 std::span<const NodeId> args) {
  std::vector<NodeId>& order = module().namedArguments[node];
  order.assign(s.params.size(), kNoNode);
  for (size_t i = 0; i < args.size(); ++i) {
    order[parameterOf(s, args, i)] = argumentValue(tree(), args[i]);
  }
  return order;
}

// How many of the arguments, as they are written out, do not fit their parameters of a form. What
// it has no parameter for does not count.
size_t Analysis::misfits(const Signature& signature, std::span<const NodeId> args) const {
  const auto isWrong = [&](const ParamSpec& p, NodeId node) {
    switch (tree().kind(node)) {
      case NodeKind::Number: return !fits(ValueType::Float, p.type);
      case NodeKind::Bool: return !fits(ValueType::Bool, p.type);
      case NodeKind::String:
        return p.type == ParamType::Selector ? !hasWord(p.words, text(node))
                                             : !fits(ValueType::String, p.type);
      default: return false;
    }
  };
  size_t count = 0;
  for (size_t i = 0; i < args.size(); ++i) {
    const size_t p = parameterOf(signature, args, i);
    if (p == kNoParameter) continue;
    count += isWrong(*signature.paramAt(p), argumentValue(tree(), args[i])) ? 1 : 0;
  }
  return count;
}

// Where no form of as many parameters fits, but one of fewer does with the first of the arguments,
// those behind it are too many: roofGable(30, 1, 1, true, 0, 7).
bool Analysis::reportTooMany(const CallTarget& target, std::span<const NodeId> args,
                             const std::vector<uint16_t>& left) {
  const auto fitsAll = [&](uint16_t s) { return misfits(target.signatures[s], args) == 0; };
  if (hasNames(args) || std::any_of(left.begin(), left.end(), fitsAll)) return false;
  // A word that one of the forms begins with tells which is meant.
  const bool hasWordOfForm = std::any_of(left.begin(), left.end(), [&](uint16_t s) {
    const ParamSpec* const first = target.signatures[s].paramAt(0);
    return first && first->type == ParamType::Selector && first->words &&
           tree().kind(args[0]) == NodeKind::Name && hasWord(first->words, text(args[0]));
  });
  if (hasWordOfForm) return false;
  const Signature* meant = nullptr;
  for (const Signature& s : target.signatures) {
    if (s.params.empty() || s.params.size() >= args.size() || misfits(s, args) > 0) continue;
    if (!meant || s.params.size() > meant->params.size()) meant = &s;
  }
  if (!meant) return false;
  const size_t most = meant->params.size(), more = args.size() - most;
  visitMisfits(target, args);
  reportMisfit(target, "wrong-argument-count", args[most],
               quote(target.name) + " takes at most " + std::to_string(most) +
                   (most == 1 ? " argument" : " arguments") + " where they begin like this; " +
                   (more == 1 ? "this one is" : "the last " + std::to_string(more) + " are") +
                   " too many",
               "write " + signatureText(target.name, *meant));
  return true;
}

// Where what is written out fits no form, the forms that the least of it fits not: what is told
// is then the mistake, and not that of a form which nobody meant.
void Analysis::keepNearest(const CallTarget& target, std::span<const NodeId> args,
                           std::vector<uint16_t>& left) const {
  std::vector<size_t> wrong;
  for (const uint16_t s : left) wrong.push_back(misfits(target.signatures[s], args));
  const size_t least = *std::min_element(wrong.begin(), wrong.end());
  if (least == 0) return;
  size_t kept = 0;
  for (size_t i = 0; i < left.size(); ++i) {
    if (wrong[i] == least) left[kept++] = left[i];
  }
  left.resize(kept);
}

Analysis::Chosen Analysis::checkBuiltinCall(const CallTarget& target,
                                            std::span<const NodeId> args) {
  const bool anyNamed = hasNames(args);
  std::vector<uint16_t> left = signaturesByShape(target, args);
  if (left.empty()) {
    visitMisfits(target, args);
    if (anyNamed) {
      reportNamedArguments(target, args);
    } else {
      reportMisfit(target, "wrong-argument-count", target.node,
                   quote(target.name) + " takes " + countText(target.signatures) + ", not " +
                       std::to_string(args.size()),
                   formHint(target, args.size()));
    }
    Chosen none;
    none.leaf = target.mayBeLeaf && !anyNamed;
    return none;
  }
  if (reportTooMany(target, args, left)) {
    Chosen none;
    none.leaf = target.mayBeLeaf;
    return none;
  }
  if (left.size() > 1) keepNearest(target, args, left);
  bool unknownType = false;
  bool isFit = true;
  for (size_t i = 0; i < args.size(); ++i) {
    const ValueType type = visitArgumentFor(target, args, i, left, isFit);
    // The value of a word may decide as well, where it is only known later.
    unknownType = unknownType || type == ValueType::Null || type == ValueType::String ||
                  type == ValueType::Selector;
  }
  if (target.mayBeLeaf && !isFit) {
    Chosen none;
    none.leaf = true;
    return none;
  }
  checkFiles(target.signatures[left[0]], args);
  if (anyNamed) {
    orderArguments(target.node, target.signatures[left[0]], args);
    return {left[0], false};
  }
  return {left[0], left.size() > 1 && unknownType};
}

std::vector<ValueType> Analysis::visitArguments(std::span<const NodeId> args) {
  checkNamedArguments(args);
  std::vector<ValueType> types;
  for (const NodeId a : args) {
    checkPrefix(a, {});
    types.push_back(visit(a));
  }
  return types;
}

// Arguments that fit no signature. What only its parameter could understand is left alone; so a
// slip in the name of one argument says nothing about the words of the others.
void Analysis::visitMisfits(const CallTarget& target, std::span<const NodeId> args) {
  for (size_t i = 0; i < args.size(); ++i) {
    const bool named = tree().kind(args[i]) == NodeKind::NamedArg;
    const NodeId value = argumentValue(tree(), args[i]);
    const bool unknown = named && std::all_of(target.signatures.begin(), target.signatures.end(),
                                              [&](const Signature& s) {
                                                return parameterOf(s, args, i) == kNoParameter;
                                              });
    const bool understood =
        unknown ||
        std::any_of(target.signatures.begin(), target.signatures.end(), [&](const Signature& s) {
          const size_t p = parameterOf(s, args, i);
          const ParamType type = p == kNoParameter ? ParamType::Any : s.paramAt(p)->type;
          return type == ParamType::Selection || type == ParamType::DrawnList;
        });
    if (!understood) visitLoosely({&value, 1});
  }
}

// Arguments of something unknown: a word that nothing else is may be one of its selectors.
void Analysis::visitLoosely(std::span<const NodeId> args) {
  for (NodeId a : args) {
    while (tree().kind(a) == NodeKind::Relative || tree().kind(a) == NodeKind::Floating) {
      a = tree().child(a, 0);
    }
    if (tree().kind(a) == NodeKind::Name && !isKnownValue(text(a))) {
      resolve(a, RefKind::Selector);
    } else {
      visit(a);
    }
  }
}

// The first candidate with as many parameters whose inferred types agree; kNone if there is none.
template <class Info>
uint32_t Analysis::chooseOverload(const std::vector<uint32_t>& candidates,
                                  const std::vector<Info>& infos, std::span<const NodeId> args,
                                  const std::vector<ValueType>& types) {
  uint32_t byCount = kNone;
  for (const uint32_t id : candidates) {
    const Info& info = infos[id];
    if (info.paramCount != args.size()) continue;
    if (byCount == kNone) byCount = id;
    bool agrees = true;
    for (size_t i = 0; i < types.size(); ++i) {
      const ValueType wanted = info.paramTypes[i];
      agrees = agrees &&
               (types[i] == ValueType::Null || wanted == ValueType::Null || types[i] == wanted);
    }
    if (agrees) return id;
  }
  return byCount;
}

template uint32_t Analysis::chooseOverload(const std::vector<uint32_t>&,
                                           const std::vector<RuleInfo>&, std::span<const NodeId>,
                                           const std::vector<ValueType>&);
template uint32_t Analysis::chooseOverload(const std::vector<uint32_t>&,
                                           const std::vector<FunctionInfo>&,
                                           std::span<const NodeId>, const std::vector<ValueType>&);

// A name where a word may stand.
ValueType Analysis::visitSelectorWord(NodeId node, const std::vector<const ParamSpec*>& params) {
  const std::string_view word = text(node);
  bool open = false;
  bool onlyWords = true;
  std::vector<std::string_view> known;
  for (const ParamSpec* p : params) {
    if (p->type != ParamType::Selector) {
      onlyWords = false;
      continue;
    }
    open = open || p->words == nullptr;
    if (hasWord(p->words, word)) {
      resolve(node, RefKind::Selector);
      return typed(node, ValueType::Selector);
    }
    if (!p->words) continue;
    for (const std::string_view w : listed(p->words)) known.push_back(w);
  }
  const bool isSlot = std::find(body_.slots.begin(), body_.slots.end(), word) != body_.slots.end();
  const bool isOwn = isSlot || attributeNamed(body_.module, word) != kNone ||
                     !functionsNamed(body_.module, word).empty();
  if (isOwn || !onlyWords) {
    if (!isOwn) wordsHere_ = known;
    const ValueType type = typed(node, visitName(node, ValueType::Null));
    wordsHere_.clear();
    if (!onlyWords || type != ValueType::Float) return type;
  }
  if (open) {
    resolve(node, RefKind::Selector);
    return typed(node, ValueType::Selector);
  }
  if (isOwn) return module().types[node];
  resolve(node, RefKind::Selector);
  std::string list;
  for (const std::string_view w : known) list += (list.empty() ? "" : ", ") + std::string(w);
  const std::string nearest = near(word, [&] { return known; });
  errorAt("unknown-selector", node, quote(word) + " is not known here",
          nearest.empty() ? "one of: " + list : nearest);
  return typed(node, ValueType::Selector);
}

}  // namespace gable::lang
