// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Bodies of rules. For each name in a sequence it is decided here whether it is an operation, a
// rule or a leaf; blocks are checked against the kind that the operation declares.

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "base/work.h"
#include "lang/old_regions.h"
#include "lang/other_languages.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// From then on CGA compares the types of what an operation or a rule gets; before, a call that fits
// none was an undefined rule.
constexpr double kTypesChecked = 2019.1;

std::string hintOfNewName(std::string_view name) {
  return "write '" + std::string(name) + "', or let 'gable format' rewrite the file";
}

/// A split whose parts have a depth as well, and a second block for what they leave.
bool hasSections(const OpSpec& op) { return op.block == BlockKind::Split && !op.parts.empty(); }

// Words of other languages for what 'case' and splits do.
std::string hintOfStatement(std::string_view name) {
  const ForeignWord* const word = foreignWord(ForeignUse::Statement, name);
  return word ? remedyOf(*word) : std::string();
}

// Operations of other programs and of earlier grammars that are written in another way here.
std::string hintOfOperation(std::string_view name) {
  const ForeignWord* const word = foreignWord(ForeignUse::Operation, name);
  return word && word->instead.empty() ? remedyOf(*word) : std::string();
}

// Operations of one letter, by what other programs call them.
std::string_view shortNameOf(std::string_view name) {
  const ForeignWord* const word = foreignWord(ForeignUse::Operation, name);
  return word ? word->instead : std::string_view();
}

}  // namespace

void Analysis::visitSequence(NodeId node) {
  if (node == kNoNode) return;
  const bool followed = std::exchange(followed_, false);
  const std::span<const NodeId> all = tree().children(node);
  for (size_t i = 0; i < all.size(); ++i) {
    // The end of a branch is followed by what follows the choice.
    const bool isChoice = tree().kind(all[i]) == NodeKind::Choice;
    followed_ = isChoice && (followed || i + 1 < all.size());
    visitSuccessor(all[i]);
  }
  followed_ = followed;
  reportLostColors(node);
}

void Analysis::visitSuccessor(NodeId node) {
  work();
  switch (tree().kind(node)) {
    case NodeKind::Apply: return visitApply(node);
    case NodeKind::ImportApply: return visitImportCall(node, true);
    case NodeKind::Push: return visitSequence(tree().child(node, 0));
    case NodeKind::Choice: return visitSuccessorChoice(node);
    default: return;
  }
}

void Analysis::visitSuccessorChoice(NodeId node) {
  const bool isCase = tree().choiceKind(node) == ChoiceKind::Case;
  for (const NodeId branch : tree().children(node)) {
    const NodeId condition = tree().child(branch, 0);
    const ValueType wanted = isCase ? ValueType::Bool : ValueType::Float;
    if (condition != kNoNode) {
      expectType(condition, visit(condition, wanted), wanted, isCase ? "a condition" : "a weight");
    }
    const bool followed = followed_;
    visitSequence(tree().child(branch, 1));
    followed_ = followed;
  }
  if (!isCase && node != headless_) checkWeights(node);
}

// Constant weights above 100 % can never all happen; below it something must stand under "else".
void Analysis::checkWeights(NodeId choice) {
  double sum = 0;
  bool known = true;
  bool hasElse = false;
  for (const NodeId branch : tree().children(choice)) {
    const NodeId weight = tree().child(branch, 0);
    hasElse = hasElse || weight == kNoNode;
    if (weight == kNoNode) continue;
    known = known && tree().kind(weight) == NodeKind::Number;
    sum += tree().number(weight);
  }
  if (known && sum > 100 + 1e-9) {
    warning("weights-over-100", tree().span(choice), "these weights add up to more than 100 %",
            "lower them; what is above 100 % never happens");
  }
  // A chain without else is whole when its weights are.
  if (!hasElse && (!known || sum < 100 - 1e-3)) {
    errorAt("missing-else", choice, "these weights do not add up to 100 % and have no 'else'",
            "add 'else : ...'");
  }
}

// --- Rules and leaves ---

void Analysis::makeLeaf(NodeId node, bool known) {
  resolve(node, RefKind::Leaf);
  if (known) return;
  for (const NodeId block : tree().children(node).subspan(1)) {
    const std::string_view now = modernOperation(text(node));
    std::string hint = hintOfOperation(text(node));
    if (hint.empty()) hint = hintOfStatement(text(node));
    if (hint.empty()) {
      hint = now.empty() ? near(text(node), [&] { return ruleNames(body_.module); })
                         : hintOfNewName(now);
    }
    const std::string nearest = now.empty() ? std::exchange(meant_, {}).nearest : std::string(now);
    errorAt("unexpected-block", block,
            quote(text(node)) + " is no operation, so it cannot have a block", std::move(hint));
    // The report is at the block; what is wrong is the word before it.
    if (!nearest.empty()) fix(nameSpan(tree(), node), nearest);
  }
}

namespace {

bool isSmallLetter(char c) { return c >= 'a' && c <= 'z'; }

}  // namespace

// A name with arguments that is nearly that of an operation is meant to be it; as a leaf the model
// would lack what the operation makes. Rules begin with a capital, and a file may call rules that
// it does not define: so a name with a capital must be that of an operation but for the case, and
// have arguments that the operation takes, in number and type: T(0, 1, 0).
std::string_view Analysis::slippedOperation(NodeId node) {
  constexpr size_t kShortest = 5;
  const std::string_view name = text(node);
  if (name.empty()) return {};
  if (!isSmallLetter(name[0])) {
    for (const OpSpec* op : catalogue_.operations) {
      if (!equalButForCase(name, op->name)) continue;
      if (name.size() > 1 ? acceptsCount(op->signatures, arguments(tree().child(node, 0)).size())
                          : fitsOperation(node, *op)) {
        return op->name;
      }
    }
    return {};
  }
  if (name.size() < kShortest) return {};
  const size_t most = name.size() < 8 ? 1 : 2;
  std::string_view best;
  size_t least = most + 1;
  for (const OpSpec* op : catalogue_.operations) {
    const size_t distance = editDistance(name, op->name, most);
    if (distance >= least) continue;
    least = distance;
    best = op->name;
  }
  return best;
}

void Analysis::reportUndefinedRule(NodeId node, const RuleSet& found) {
  if ((node == headless_ && node != kNoNode) || isMute()) return;
  const std::string_view name = text(node);
  const Span span = nameSpan(tree(), node);
  if (!found.rules.empty()) {
    const RuleInfo& r = program_.rules[found.rules[0]];
    warning("undefined-rule", span,
            "the rule " + quote(name) + " takes " + std::to_string(r.paramCount) +
                (r.paramCount == 1 ? " argument" : " arguments") +
                ", so this is another name: a leaf",
            "it is written " + formOf(r));
    return;
  }
  if (ruleInAnyStyle(body_.module, name) || inMissingImport(body_.module, name)) return;
  const bool called = tree().kind(node) == NodeKind::Apply && tree().child(node, 0) != kNoNode;
  std::string_view meant;
  if (called) {
    if (const std::string_view now = modernOperation(name); !now.empty()) {
      error("unknown-operation", span, "there is no operation or rule " + quote(name),
            hintOfNewName(now));
      fix(span, std::string(now));
      return;
    }
    meant = slippedOperation(node);
    // A file of CityEngine may have leaves that look like rules: Extrude(3).
    if (!meant.empty() && (isSmallLetter(name[0]) || !isVersioned(body_.module))) {
      meant_ = {name, std::string(meant)};
      error("unknown-operation", span, "there is no operation or rule " + quote(name),
            "did you mean " + quote(meant) + "?");
      return;
    }
  }
  const std::pair<ModuleId, std::string_view> place = enter(body_.module, name);
  const bool isShort = called && !shortNameOf(name).empty();
  std::string hint =
      isShort ? std::string() : near(place.second, [&] { return ruleNames(place.first); });
  if (!hint.empty() && place.second.size() < name.size()) {
    const std::string_view before = name.substr(0, name.size() - place.second.size());
    hint = "did you mean " + quote(std::string(before) + meant_.nearest) + "?";
  }
  if (hint.empty()) hint = hintOfImport(place.first, place.second);
  const auto own = scopes_[body_.module].imports.find(name);
  if (hint.empty() && own != scopes_[body_.module].imports.end()) {
    const std::string rule = firstRuleOf(own->second);
    hint = quote(name) + " is an import; its rules are written as " +
           quote(std::string(name) + "." + rule);
  }
  if (hint.empty()) hint = hintOfOperation(name);
  if (hint.empty() && !meant.empty() && !isShort) {
    meant_ = {name, std::string(meant)};
    hint = "did you mean " + quote(meant) + "?";
  }
  const bool leaf = hint.empty();
  if (const std::string statement = hintOfStatement(name); !statement.empty()) {
    meant_ = {};
    hint = statement;
    if (called) {
      error("unknown-operation", span, "there is no operation or rule " + quote(name), hint);
      return;
    }
  } else if (const OpSpec* op = catalogue_.operation(name); op && op->soft) {
    meant_ = {};
    hint = "the operation is written with its brackets: " + signatureText(name, op->signatures[0]);
  } else if (const std::string_view meantOp = called ? shortNameOf(name) : "";
             leaf && !meantOp.empty()) {
    hint = "the operation is " + quote(meantOp) + "; write " + quote(std::string(name) + ".") +
           " if it shall be a leaf";
  } else if (leaf) {
    hint = "write " + quote(std::string(name) + ".") + " if it shall be a leaf";
  }
  warning("undefined-rule", span,
          "no rule or operation is named " + quote(name) + "; it becomes a leaf", std::move(hint));
}

std::string Analysis::formOf(const RuleInfo& rule) const {
  const Tree& t = program_.tree(rule.module);
  std::string out;
  for (const NodeId p : t.children(paramsOf(t, rule.node))) {
    out += (out.empty() ? "" : ", ") + std::string(t.text(p));
  }
  return quote(rule.qualifiedName + (out.empty() ? "" : '(' + out + ')'));
}

void Analysis::reportArgument(NodeId node, const RuleInfo& rule, size_t parameter, ValueType got) {
  const Tree& t = program_.tree(rule.module);
  const std::string name(t.text(t.child(paramsOf(t, rule.node), parameter)));
  const ValueType wanted = rule.paramTypes[parameter];
  errorAt(
      "type-mismatch", node,
      "the argument " + quote(name) + " must be a " + typeName(wanted) + ", not a " + typeName(got),
      "the rule is written " + formOf(rule));
}

bool Analysis::applyRule(NodeId node, const std::vector<RuleId>& rules,
                         std::span<const NodeId> args, const std::vector<ValueType>& types) {
  const RuleId id = chooseOverload(rules, program_.rules, args, types);
  if (id == kNone) return false;
  resolve(node, RefKind::Rule, id);
  for (size_t i = 0; i < args.size(); ++i) {
    const ValueType wanted = program_.rules[id].paramTypes[i], got = types[i];
    if (got == wanted || got == ValueType::Null || wanted == ValueType::Null) continue;
    if (!isBefore(kTypesChecked, body_.module)) {
      reportArgument(args[i], program_.rules[id], i, got);
      continue;
    }
    warning("type-mismatch", tree().span(args[i]),
            std::string("this argument must be a ") + typeName(wanted) + ", not a " +
                typeName(got) + "; so the call is a leaf",
            "");
    makeLeaf(node, true);
    break;
  }
  for (const NodeId block : tree().children(node).subspan(1)) {
    if (tree().kind(block) != NodeKind::Block) continue;
    errorAt("unexpected-block", block, quote(text(node)) + " is a rule and takes no block",
            "put the operations into the rule");
  }
  return true;
}

namespace {

std::string listText(const Sources& sources, const Tree& t, std::span<const NodeId> args,
                     bool named) {
  std::string out;
  for (const NodeId a : args) {
    if ((t.kind(a) == NodeKind::NamedArg) != named) continue;
    const Span span = t.span(argumentValue(t, a));
    out += (out.empty() ? "" : ", ") + (named ? std::string(t.text(a)) + " = " : std::string()) +
           std::string(sources.text(span.file).substr(span.begin, span.end - span.begin));
  }
  return out;
}

}  // namespace

// A rule of an import, for examples in hints.
std::string Analysis::firstRuleOf(ModuleId module) const {
  for (RuleId r = program_.modules[module].firstRule;
       r < program_.modules[module].firstRule + program_.modules[module].ruleCount; ++r) {
    const std::string& name = program_.rules[r].name;
    if (name.find('.') == std::string::npos) return name;
  }
  return "Rule";
}

// Values for the attributes of an import that stand behind the rule, or that no rule follows:
// ground.Opening(height = 2.6), ground(height = 2.6). Whether that is so.
bool Analysis::reportImportValues(NodeId node, std::span<const NodeId> args) {
  const std::string_view name = text(node);
  const std::string_view import = name.substr(0, name.find('.'));
  const auto target = scopes_[body_.module].imports.find(import);
  if (target == scopes_[body_.module].imports.end()) return false;
  const std::string alias(import);
  const bool hasRule = import.size() < name.size();
  const std::string values = listText(sources_, tree(), args, true);
  const std::string rest = listText(sources_, tree(), args, false);
  if (hasRule && values.empty()) return false;
  if (!hasRule && tree().child(node, 0) == kNoNode) return false;
  visitLoosely(args);
  if (hasRule) {
    errorAt(
        "bad-dynamic-import", node,
        "values for the attributes of " + quote(alias) + " stand behind its name, before the rule",
        "write " + alias + "(" + values + ")." + std::string(name.substr(import.size() + 1)) +
            (rest.empty() ? "" : "(" + rest + ")"));
    return true;
  }
  errorAt("bad-dynamic-import", node,
          quote(alias) + " is an import, and no rule of it stands behind these brackets",
          "write " + alias + "(" + (values.empty() ? "attribute = value" : values) + ")." +
              firstRuleOf(target->second));
  return true;
}

void Analysis::visitApply(NodeId node) {
  const Tree& t = tree();
  const std::string_view name = t.text(node);
  const std::span<const NodeId> args = arguments(t.child(node, 0));
  const bool hasBlock = t.children(node).size() > 1;
  if (t.has(node, kFlagTerminal)) {
    visitLoosely(args);
    return makeLeaf(node, true);
  }
  const RuleSet found = rulesNamed(body_.module, name);
  const OpSpec* op = found.imported ? nullptr : catalogue_.operation(name);
  const bool ruleFits = std::any_of(found.rules.begin(), found.rules.end(), [&](RuleId r) {
    return program_.rules[r].paramCount == args.size();
  });
  if (op && op->soft) {
    // The author's own name wins; without brackets and block it is a leaf as ever.
    if (!found.rules.empty() || (t.child(node, 0) == kNoNode && !hasBlock)) op = nullptr;
  } else if (op && ruleFits && !hasBlock && !fitsOperation(node, *op)) {
    op = nullptr;
  }
  if (op) return visitOperation(node, *op);
  if (reportImportValues(node, args)) return makeLeaf(node, true);

  std::vector<ValueType> types;
  checkNamedArguments(args);
  if (found.rules.empty()) visitLoosely(args);
  for (size_t i = 0; i < args.size() && !found.rules.empty(); ++i) {
    // With a single overload its parameter tells what the argument is.
    ValueType expected = ValueType::Null;
    if (found.rules.size() == 1 && ruleFits)
      expected = program_.rules[found.rules[0]].paramTypes[i];
    checkPrefix(args[i], {});
    types.push_back(visit(args[i], expected));
  }
  if (applyRule(node, found.rules, args, types)) {
    visitAllBlocks(node);
    return;
  }
  makeLeaf(node, false);
  visitAllBlocks(node);
  if (!hasBlock) reportUndefinedRule(node, found);
}

// The bodies of blocks that belong to nothing, so that their mistakes are seen too.
void Analysis::visitAllBlocks(NodeId node) {
  for (const NodeId block : tree().children(node).subspan(1)) {
    for (const NodeId item : tree().children(block)) {
      if (tree().kind(item) == NodeKind::Item) visitSequence(tree().child(item, 2));
    }
  }
}

// `imp(a = e).Rule(args)`, as a successor or in an expression.
void Analysis::visitImportCall(NodeId node, bool successor) {
  const Tree& t = tree();
  const NodeId import = t.child(node, 0);
  for (const NodeId item : t.children(t.child(node, 1))) {
    if (t.kind(item) == NodeKind::NamedArg) {
      visit(t.child(item, 0));
    } else if (t.kind(item) != NodeKind::Rule) {
      errorAt("bad-override", item, "a dynamic import takes 'name = value' only",
              "write the name of the attribute before the value");
    }
  }
  const std::span<const NodeId> args = arguments(t.child(node, 2));
  const std::vector<ValueType> types = visitArguments(args);
  if (!successor) {
    errorAt("bad-dynamic-import", node, "a dynamic import can only apply rules",
            "store the value in an attribute of the importing file");
    return;
  }
  const auto& imports = scopes_[body_.module].imports;
  if (imports.count(t.text(import)) == 0) {
    std::vector<std::string_view> names;
    for (const auto& [n, id] : imports) names.push_back(n);
    std::sort(names.begin(), names.end());
    makeLeaf(node, true);
    if (units_[module().unit].importNames.count(t.text(import)) == 0) {
      errorAt("unknown-import", import, "there is no import " + quote(t.text(import)),
              near(t.text(import), [&] { return names; }));
    }
    return;
  }
  const ModuleId target = dynamicModule(body_.module, node);
  if (target == kNone) return makeLeaf(node, true);
  checkOverrides(target, t.child(node, 1));
  checkGivenTypes(target, t.child(node, 1));
  const RuleSet found = rulesNamed(target, t.text(node));
  if (applyRule(node, found.rules, args, types)) return;
  makeLeaf(node, true);
  warning("undefined-rule", nameSpan(t, import),
          "the imported file has no rule " + quote(t.text(node)) + " with " +
              std::to_string(args.size()) + " arguments; it becomes a leaf",
          near(t.text(node), [&] { return ruleNames(target); }));
}

// Of the values in the brackets of a call, which have been visited.
void Analysis::checkGivenTypes(ModuleId target, NodeId list) {
  for (const NodeId item : tree().children(list)) {
    if (tree().kind(item) != NodeKind::NamedArg) continue;
    const auto at = scopes_[target].attributes.find(text(item));
    if (at == scopes_[target].attributes.end()) continue;
    look(UnitKind::Attribute, at->second);
    const NodeId value = tree().child(item, 0);
    const std::string what = "the value of " + quote(text(item));
    expectType(value, module().types[value], program_.attributes[at->second].type, what.c_str());
  }
}

// --- Operations ---

// Whether the arguments are those of the operation, as against a rule of its name.
bool Analysis::fitsOperation(NodeId node, const OpSpec& op) {
  const std::span<const NodeId> args = arguments(tree().child(node, 0));
  if (!acceptsCount(op.signatures, args.size())) return false;
  const bool muted = std::exchange(mute_, true);
  const bool spoke = body_.unit != kNoUnit && walked_[body_.unit].speaks;
  const bool leaf = checkBuiltinCall({op.name, node, op.signatures, true}, args).leaf;
  mute_ = muted;
  if (body_.unit != kNoUnit) walked_[body_.unit].speaks = spoke;
  return !leaf;
}

void Analysis::visitOperation(NodeId node, const OpSpec& op) {
  const std::string_view name = op.name;
  if (name == "set") return visitSet(node, op);
  if (name == "local") return visitLocal(node, op);
  if (name == "do") return visitDo(node, op);
  const std::span<const NodeId> args = arguments(tree().child(node, 0));
  const bool old = reportOldCall(node, args);
  const bool mayBeLeaf = isBefore(kTypesChecked, body_.module) && !op.soft &&
                         op.block == BlockKind::None && tree().children(node).size() == 1;
  const Chosen chosen =
      old ? Chosen{} : checkBuiltinCall({name, node, op.signatures, mayBeLeaf}, args);
  if (chosen.leaf) return makeLeaf(node, true);
  resolve(node, RefKind::Operation);
  Resolution& r = module().resolutions[node];
  r.spec.operation = &op;
  r.signature = chosen.signature;
  r.open = chosen.open;
  visitBlocks(node, op);
}

// set() of a name that is declared nowhere: another is meant, or its declaration is missing.
void Analysis::reportUnknownPlace(NodeId place, ValueType given) {
  const std::string_view name = text(place);
  std::string hint = near(name, [&] {
    std::vector<std::string_view> names;
    for (const auto& [n, id] : scopes_[body_.module].attributes) names.push_back(n);
    for (const AttributeSpec* s : catalogue_.attributes) names.push_back(s->name);
    std::sort(names.begin(), names.end());
    return names;
  });
  // A name with a dot is one of an import or of the shape, and declared there.
  if (hint.empty() && name.find('.') == std::string_view::npos) {
    const char* value = given == ValueType::Float         ? "0"
                        : given == ValueType::Bool        ? "false"
                        : given == ValueType::FloatArray  ? "floatArray"
                        : given == ValueType::BoolArray   ? "boolArray"
                        : given == ValueType::StringArray ? "stringArray"
                                                          : "\"\"";
    hint = "declare it: attr " + std::string(name) + " = " + value;
  }
  errorAt("unknown-attribute", place, "there is no attribute " + quote(name), hint);
}

// set(attribute, value): the first argument is a place, not a value.
void Analysis::visitSet(NodeId node, const OpSpec& op) {
  const Tree& t = tree();
  std::span<const NodeId> args = arguments(t.child(node, 0));
  resolve(node, RefKind::Operation);
  module().resolutions[node].spec.operation = &op;
  module().resolutions[node].signature = 0;
  if (hasNames(args)) {
    const CallTarget target{op.name, node, op.signatures};
    if (signaturesByShape(target, args).empty()) {
      visitMisfits(target, args);
      return reportNamedArguments(target, args);
    }
    args = orderArguments(node, op.signatures[0], args);
  } else if (args.size() != 2) {
    visitArguments(args);
    errorAt("wrong-argument-count", node,
            "'set' takes 2 arguments, not " + std::to_string(args.size()),
            "write 'set(attribute, value)'");
    return;
  }
  checkNamedArguments(args);
  ValueType wanted = ValueType::Null;
  bool unknown = false;
  const NodeId place = args[0];
  const std::string_view name = t.text(place);
  if (t.kind(place) != NodeKind::Name) {
    visit(place);  // sel("material.color." + channel)
  } else if (const AttributeId a = attributeNamed(body_.module, name); a != kNone) {
    const AttributeInfo& info = program_.attributes[a];
    resolve(place, RefKind::Attribute, a);
    wanted = typed(place, info.type);
    if (info.constant) {
      errorAt("not-settable", place, quote(name) + " is a constant and cannot be set",
              "declare it with 'attr'");
    }
  } else if (const AttributeSpec* spec = catalogue_.attribute(name)) {
    resolve(place, RefKind::ShapeAttribute);
    module().resolutions[place].spec.attribute = spec;
    wanted = typed(place, spec->type);
    if (!spec->set) {
      errorAt("not-settable", place, quote(name) + " can only be read", "");
    }
  } else if (inMissingImport(body_.module, name)) {
    resolve(place, RefKind::Selector);
  } else {
    resolve(place, RefKind::Selector);
    unknown = true;
  }
  const ValueType given = visit(args[1], wanted);
  expectType(args[1], given, wanted, "the value");
  if (unknown) reportUnknownPlace(place, given);
  // material.colormap and the like hold a picture.
  const bool ofShape = module().at(place).kind == RefKind::ShapeAttribute;
  if (ofShape && wanted == ValueType::String && name.ends_with("map")) checkFile(args[1]);
  visitBlocks(node, op);
}

// local(name = value, ...) { operations }: each name is an attribute.
void Analysis::visitLocal(NodeId node, const OpSpec& op) {
  resolve(node, RefKind::Operation);
  module().resolutions[node].spec.operation = &op;
  for (const NodeId a : arguments(tree().child(node, 0))) {
    const NodeId value = tree().kind(a) == NodeKind::NamedArg ? tree().child(a, 0) : a;
    ValueType wanted = ValueType::Null;
    const AttributeId id = value == a ? kNone : attributeNamed(body_.module, text(a));
    if (id != kNone) {
      resolve(a, RefKind::Attribute, id);
      wanted = program_.attributes[id].type;
    } else {
      errorAt("unknown-attribute", a, "'local' sets attributes, and this names none",
              "write 'local(attribute = value) { ... }'");
    }
    expectType(value, visit(value, wanted), wanted, "the value");
  }
  visitBlocks(node, op);
}

// do(A(args)): applies a rule in place; the argument is a rule written like a call.
void Analysis::visitDo(NodeId node, const OpSpec& op) {
  resolve(node, RefKind::Operation);
  module().resolutions[node].spec.operation = &op;
  const std::span<const NodeId> args = arguments(tree().child(node, 0));
  const NodeId call = args.size() == 1 ? args[0] : kNoNode;
  const bool isRule = tree().kind(call) == NodeKind::Name || tree().kind(call) == NodeKind::Call;
  if (!isRule) {
    errorAt("wrong-argument-count", node, "'do' takes one rule", "write 'do(Rule(arguments))'");
    return;
  }
  const std::span<const NodeId> inner = tree().kind(call) == NodeKind::Call
                                            ? arguments(tree().child(call, 0))
                                            : std::span<const NodeId>();
  const std::vector<ValueType> types = visitArguments(inner);
  const RuleSet found = rulesNamed(body_.module, text(call));
  const RuleId id = chooseOverload(found.rules, program_.rules, inner, types);
  resolve(call, id == kNone ? RefKind::Leaf : RefKind::Rule, id);
  if (id == kNone) reportUndefinedRule(call, found);
  visitBlocks(node, op);
}

// --- Blocks ---

void Analysis::visitBlocks(NodeId node, const OpSpec& op) {
  const Tree& t = tree();
  const std::span<const NodeId> blocks = t.children(node).subspan(1);
  const std::string name = quote(op.name);
  if (op.block == BlockKind::None) {
    if (!blocks.empty()) {
      errorAt("unexpected-block", blocks[0], name + " takes no block", "remove the braces");
      visitAllBlocks(node);
    }
    return;
  }
  if (blocks.empty() && !op.blockOptional) {
    const char* const hints[] = {"", "add '{ size : operations | ... }'",
                                 "add '{ selector : operations | ... }'", "add '{ operations }'",
                                 "add '{ operations | operations }'"};
    errorAt("missing-block", node, name + " needs a block",
            hasSections(op) ? "add '{ size : depth : operations | ... }'"
                            : hints[static_cast<size_t>(op.block)]);
  }
  for (size_t i = 0; i < blocks.size(); ++i) {
    if (i == 1 && hasSections(op)) {
      visitRemainder(blocks[i], op);
      continue;
    }
    if (i > 0)
      errorAt("unexpected-block", blocks[i], name + " takes no further block",
              "put '[' and ']' around what makes the first, and begin anew behind it");
    // In the old form, union A, the other operand is the present shape.
    const bool two = t.has(node, kFlagOperand) || t.children(blocks[i]).size() == 2;
    if (op.block == BlockKind::Operands && !two) {
      errorAt("wrong-operand-count", blocks[i], name + " takes two operands",
              "write '" + std::string(op.name) + " { A | B }'");
    }
    visitBlock(blocks[i], op);
  }
}

void Analysis::visitBlock(NodeId block, const OpSpec& op) {
  const Tree& t = tree();
  if (t.has(block, kFlagRepeat) && op.block != BlockKind::Split) {
    errorAt("unexpected-repeat", block, "only splits can be repeated with '*'", "remove the '*'");
    const uint32_t end = t[block].end;
    if (end > 0 && sources_.text(t.file()).substr(end - 1, 1) == "*") {
      fix({t.file(), end - 1, end}, "");
    }
  }
  const size_t count = t.children(block).size();
  // Besides the operations there may be those for otherwise; what gathers takes any number.
  const size_t most = op.gathered ? count : !op.parts.empty() ? 2 : 1;
  if (op.block == BlockKind::Operations && count > most) {
    errorAt("unexpected-separator", block, quote(op.name) + " takes operations without '|'",
            "remove the '|'");
  }
  for (const NodeId item : t.children(block)) {
    if (t.kind(item) != NodeKind::Block) {
      visitItem(item, op);
      continue;
    }
    if (op.block != BlockKind::Split) {
      errorAt("unexpected-group", item, "only splits have groups", "remove the inner braces");
    }
    visitBlock(item, op);
  }
}

void Analysis::visitItem(NodeId item, const OpSpec& op) {
  const Tree& t = tree();
  if (t.kind(item) != NodeKind::Item) return;
  const NodeId head = t.child(item, 0);
  const NodeId second = t.child(item, 1);
  const bool wantsHead = op.block == BlockKind::Split || op.block == BlockKind::Selectors;
  if (head == kNoNode && wantsHead && t.kind(t.child(item, 2)) != NodeKind::Missing) {
    reportMissingHead(item, op);
  }
  // place { A | otherwise : B }: the word beside plain operations.
  const bool word = op.block == BlockKind::Operations && head != kNoNode &&
                    t.kind(head) == NodeKind::Name && op.part(t.text(head));
  if (word) {
    resolve(head, RefKind::Selector);
    typed(head, ValueType::Selector);
  } else if (head != kNoNode && !wantsHead && !op.parts.empty() && t.kind(head) == NodeKind::Name &&
             !isKnownValue(t.text(head))) {
    reportSelector(head, &op);
  } else if (head != kNoNode && !wantsHead) {
    visit(head);
    errorAt("unexpected-head", head, quote(op.name) + " takes operations only here",
            "remove what stands before the ':'");
  }
  if (head != kNoNode && op.block == BlockKind::Split) {
    visitSizeHead(head, op);
    if (t.itemKind(item) != ItemKind::Each) {
      errorAt("bad-separator", item, "the parts of a split are written 'size : operations'",
              "replace '=' by ':'");
      const size_t sign = sources_.text(t.file()).find('=', t[head].end);
      if (sign < t[item].end) {
        const auto at = static_cast<uint32_t>(sign);
        fix({t.file(), at, at + 1}, ":");
      }
    }
  }
  if (head != kNoNode && op.block == BlockKind::Selectors) {
    const ValueType type = visitHead(head, &op);
    if (type == ValueType::String || type >= ValueType::FloatArray) {
      errorAt("type-mismatch", head,
              std::string("a selector is a word, a condition or an index, not a ") + typeName(type),
              "");
    } else if (type == ValueType::Float && op.isOnlyParts()) {
      errorAt("unknown-selector", head, quote(op.name) + " has named parts, not numbered ones",
              partsText(op));
    }
  }
  if (second != kNoNode) {
    checkPrefix(second, {});
    expectType(second, visit(second, ValueType::Float), ValueType::Float, "a depth");
    if (t.kind(second) != NodeKind::Missing && !hasSections(op)) {
      errorAt("unexpected-head", second, "only splitAndSetbackPerimeter takes a second size",
              "remove one of the two");
    }
  } else if (head != kNoNode && t.kind(head) != NodeKind::Missing && hasSections(op) &&
             !op.part(t.text(head))) {
    errorAt("missing-depth", head, "this section has a length, but no depth",
            "write 'length : depth : operations'");
  }
  visitSequence(t.child(item, 2));
  checkFigure(item, op);
}

}  // namespace gable::lang
