// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The state of an analysis, for the files that implement it: modules.cpp (imports, declarations),
// names.cpp (look-up), calls.cpp (signatures and arguments), expressions.cpp and successors.cpp
// (the walk over bodies), order.cpp (initialisation), fold.cpp (constants). Not included elsewhere.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/most_diagnostics.h"
#include "base/text.h"
#include "lang/sema/analyse.h"
#include "lang/sema/resolved.h"
#include "lang/tree.h"
#include "program/arguments.h"
#include "program/spec.h"
#include "program/value.h"

namespace gable::lang {

/// One use of a file is one module; so many are more than any real project has.
inline constexpr size_t kMaxModules = 2000;
/// Bounds the work where large files are imported many times.
inline constexpr size_t kMaxModuleNodes = 8'000'000;
inline constexpr size_t kMaxUnits = 1000;

/// What a module offers by name. Keys are views of the texts of its tree.
struct Scope {
  std::unordered_map<std::string_view, std::vector<RuleId>> rules;
  std::unordered_map<std::string_view, std::vector<FunctionId>> functions;
  std::unordered_map<std::string_view, AttributeId> attributes;
  std::unordered_map<std::string_view, ModuleId> imports;
  /// Rules that the importer puts in the place of ours.
  std::unordered_map<std::string_view, std::vector<RuleId>> replaced;
  std::vector<RuleId> startRules;
  /// No rule is put in the place of one of ours, or of our imports'.
  bool plain = false;
};

/// A declaration with the section of the file it stands in.
struct Declaration {
  NodeId node;
  /// The style it belongs to; "Default" before the first `style`.
  std::string_view style;
  Annotations annotations;
};

/// How near to a module's own style another is: 0 for itself, 1 for the one that it extends, ...
class StyleRanks {
 public:
  explicit StyleRanks(const std::vector<std::string_view>& chain) : none_(chain.size()) {
    for (size_t i = 0; i < chain.size(); ++i) ranks_.emplace(chain[i], i);
  }
  /// none() where the module does not see it.
  size_t of(std::string_view style) const {
    const auto at = ranks_.find(style);
    return at != ranks_.end() ? at->second : none_;
  }
  size_t none() const { return none_; }

 private:
  size_t none_;
  std::unordered_map<std::string_view, size_t> ranks_;
};

/// The declarations of a unit, sorted out once.
struct UnitIndex {
  std::vector<Declaration> rules, functions, attributes, imports;
  /// name -> base, in the order of the file; and by name the number.
  std::vector<StyleInfo> styles;
  std::map<std::string, size_t, std::less<>> styleNumbers;
  std::unordered_set<std::string_view> importNames;
  std::string description;
  /// What `version` says, as a number: 2019.1; 0 where the file does not say it.
  double version = 0;
};

/// The style of all that stands before the first one.
inline constexpr std::string_view kDefaultStyle = "Default";

class Analysis {
 public:
  Analysis(const Catalogue& catalogue, ValuePool& values, FileLoader* loader, Sources& sources,
           Diagnostics& diagnostics);

  ResolvedProgram run(AnalysisInput input);

 private:
  /// The body that is being walked.
  struct Body {
    ModuleId module = 0;
    /// Names of parameters and local variables; the index is the slot.
    std::vector<std::string_view> slots;
    /// Types by slot; those of parameters are inferred, and `open` where uses contradict each
    /// other.
    std::vector<ValueType> types;
    std::vector<bool> open;
    size_t paramCount = 0;
    /// Set while the value of an attribute is walked.
    AttributeId attribute = kNone;
    /// Set while a rule is walked.
    RuleId rule = kNone;
    /// What is walked, as unitOf() numbers it.
    size_t unit = kNoUnit;
  };
  static constexpr size_t kNoUnit = static_cast<size_t>(-1);

  // --- modules.cpp: files, styles, imports, declarations ---
  uint32_t loadUnit(const std::string& path, Span from, uint32_t importerUnit,
                    std::vector<uint32_t>& open);
  void reportImport(const Error& why, const std::string& path, Span from,
                    const std::string& importer);
  /// The file of the project that a path was probably meant to be, which the report that follows
  /// proposes; empty where none is near. `from` names it.
  std::string nearFile(const std::string& path, const std::string& from);
  /// The file of that name among those that come with Gable, as "/gable/rules/x.cga"; or empty.
  std::string bundledFile(std::string_view path, const std::string& from);
  void indexUnit(uint32_t unit);
  void readVersion(uint32_t unit, NodeId node);
  /// Whether the file of a module was written for CGA before that version. One that does not say is
  /// taken as written today.
  bool isVersioned(ModuleId module) const {
    return units_[program_.modules[module].unit].version > 0;
  }
  bool isBefore(double version, ModuleId module) const {
    const double written = units_[program_.modules[module].unit].version;
    return written > 0 && written < version;
  }
  void loadImports(uint32_t unit, std::vector<uint32_t>& open);
  ModuleId addModule(uint32_t unit, std::string path, std::string style, ModuleId importer,
                     NodeId importNode, bool dynamic);
  std::vector<std::string_view> styleChain(uint32_t unit, std::string_view style) const;
  void declareAll(ModuleId module);
  void declareRules(ModuleId module, const StyleRanks& ranks);
  void warnOfStyles(const Tree& t, const std::vector<Declaration>& rules, const StyleRanks& ranks);
  void declareFunctions(ModuleId module, const StyleRanks& ranks);
  void declareAttributes(ModuleId module, const StyleRanks& ranks);
  /// Declarations of one name with the ranks of their styles.
  using RankedDeclarations = std::vector<std::pair<size_t, const Declaration*>>;
  static void inheritAnnotations(AttributeInfo& a, const Tree& t,
                                 const RankedDeclarations& declarations);
  void warnOfNamesOfImports(ModuleId module);
  void addImports(ModuleId module);
  void checkOverrides(ModuleId module, NodeId overrides);
  bool isOpenAttribute(ModuleId module, std::string_view name) const;
  void reportNoAttribute(ModuleId module, Span span, std::string_view name);
  void bindOverrides(ModuleId module, NodeId overrides, bool dynamic);
  void bindRuleOverride(ModuleId module, NodeId rule, ModuleId owner);
  void propagateAttributes(ModuleId module, NodeId overrides);
  RuleId addRule(ModuleId owner, NodeId node, std::string name, const Annotations& notes);
  ModuleId dynamicModule(ModuleId module, NodeId node);
  bool tooManyModules(uint32_t unit) const;
  std::string styleOfImport(ModuleId importer, NodeId import, uint32_t unit);

  // --- names.cpp: look-up ---
  struct RuleSet {
    std::vector<RuleId> rules;
    /// The name begins with the name of an import.
    bool imported = false;
  };
  RuleSet rulesNamed(ModuleId module, std::string_view name) const;
  bool forwards(ModuleId owner, std::string_view name) const;
  std::vector<FunctionId> functionsNamed(ModuleId module, std::string_view name) const;
  AttributeId attributeNamed(ModuleId module, std::string_view name) const;
  /// The module and the rest of a name with prefixes of imports.
  std::pair<ModuleId, std::string_view> enter(ModuleId module, std::string_view name) const;
  bool isImport(ModuleId module, std::string_view name) const;
  /// What to import for a name such as "street.Bench"; empty where it has no prefix.
  std::string hintOfImport(ModuleId module, std::string_view name);
  bool inMissingImport(ModuleId module, std::string_view name) const;
  bool ruleInAnyStyle(ModuleId module, std::string_view name) const;
  std::vector<std::string_view> ruleNames(ModuleId module) const;
  std::vector<std::string_view> valueNames(ModuleId module) const;
  AttributeId ownValueOf(AttributeId attribute);

  // --- calls.cpp: signatures and arguments ---
  struct CallTarget {
    std::string_view name;
    NodeId node;
    std::span<const Signature> signatures;
    /// A call that fits no signature is no call of this at all: a rule of that name, or a leaf.
    bool mayBeLeaf = false;
  };
  /// The signature that a call means; none when nothing fits, which has been reported.
  struct Chosen {
    uint16_t signature = 0xffff;
    bool open = false;
    /// The call is a leaf, which has been told.
    bool leaf = false;
  };
  /// Visits the arguments and chooses a signature.
  Chosen checkBuiltinCall(const CallTarget& target, std::span<const NodeId> arguments);
  /// The signatures that the arguments fit by count and names; reports when there are none.
  std::vector<uint16_t> signaturesByShape(const CallTarget& target,
                                          std::span<const NodeId> arguments);
  size_t misfits(const Signature& signature, std::span<const NodeId> args) const;
  bool reportTooMany(const CallTarget& target, std::span<const NodeId> args,
                     const std::vector<uint16_t>& left);
  void keepNearest(const CallTarget& target, std::span<const NodeId> args,
                   std::vector<uint16_t>& left) const;
  bool hasNames(std::span<const NodeId> arguments) const;
  /// The arguments of a call by name in the order of the signature, which they fit; kept for the
  /// compiler. kNoNode where there is none.
  std::span<const NodeId> orderArguments(NodeId node, const Signature& signature,
                                         std::span<const NodeId> arguments);
  bool areNamesLast(std::span<const NodeId> arguments) const;
  void reportNamedArguments(const CallTarget& target, std::span<const NodeId> arguments);
  bool reportMissingArgument(const CallTarget& target, std::span<const NodeId> arguments);
  void checkWrittenWord(NodeId node, const std::vector<const ParamSpec*>& params);
  ValueType visitArgumentFor(const CallTarget& target, std::span<const NodeId> arguments, size_t i,
                             std::vector<uint16_t>& left, bool& isFit);
  void reportMisfit(const CallTarget& target, const char* code, NodeId node, std::string message,
                    std::string hint);
  /// Which parameter an argument is for, by its name or its place; npos when there is none.
  static constexpr size_t kNoParameter = static_cast<size_t>(-1);
  size_t parameterOf(const Signature& s, std::span<const NodeId> arguments, size_t i) const;
  bool acceptsCount(std::span<const Signature> signatures, size_t count) const;
  static std::string signatureText(std::string_view name, const Signature& s);
  ValueType visitArgument(NodeId node, const std::vector<const ParamSpec*>& params);
  void checkPrefix(NodeId node, const std::vector<const ParamSpec*>& params);
  std::vector<ValueType> visitArguments(std::span<const NodeId> arguments);
  void visitLoosely(std::span<const NodeId> arguments);
  void visitMisfits(const CallTarget& target, std::span<const NodeId> arguments);
  std::string wordOfOther(const CallTarget& target, NodeId node,
                          const std::vector<const ParamSpec*>& params) const;
  std::string formHint(const CallTarget& target, size_t count) const;
  std::string mismatchHint(std::string_view target, NodeId node, const ParamSpec& param,
                           ValueType type) const;
  bool isKnownValue(std::string_view name) const;
  template <class Info>
  uint32_t chooseOverload(const std::vector<uint32_t>& candidates, const std::vector<Info>& infos,
                          std::span<const NodeId> arguments, const std::vector<ValueType>& types);
  std::span<const NodeId> arguments(NodeId list) const;
  void checkNamedArguments(std::span<const NodeId> arguments);

  // --- assets.cpp: files that rules name ---
  static constexpr int kMaxFileHints = 50;
  void checkFiles(const Signature& s, std::span<const NodeId> arguments);
  void checkMaterial(NodeId node);
  void checkTint(NodeId material, NodeId tint);
  void checkFile(NodeId node);
  NodeId writtenText(NodeId node) const;
  bool asksForFile(NodeId argument, std::string_view path);

  // --- selections.cpp: arguments that the operation works out itself ---
  void visitSelection(NodeId node, const ParamSpec& param);
  void visitTerm(NodeId node, const TermSpec& term, const ParamSpec& param);
  void visitTermArgument(NodeId node, const TermSpec& term, const ParamSpec& wanted,
                         const ParamSpec& param);
  void visitSelectionValue(NodeId node, const ParamSpec& param);
  void visitDrawnList(NodeId node);
  bool isSelection(NodeId node, const ParamSpec& param) const;
  const TermSpec* termNamed(const ParamSpec& param, std::string_view name) const;
  void reportTerm(NodeId node, const ParamSpec& param);
  bool reportOldCall(NodeId node, std::span<const NodeId> arguments);

  // --- expressions.cpp ---
  ValueType visit(NodeId node, ValueType expected = ValueType::Null);
  ValueType visitName(NodeId node, ValueType expected);
  ValueType visitCall(NodeId node);
  ValueType visitUnary(NodeId node);
  ValueType visitBinary(NodeId node);
  ValueType visitElementwise(NodeId node);
  ValueType visitIndex(NodeId node);
  void checkIndex(NodeId node);
  ValueType visitArray(NodeId node);
  ValueType visitChoice(NodeId node, ValueType expected);
  ValueType visitSelectorWord(NodeId node, const std::vector<const ParamSpec*>& params);
  ValueType visitHead(NodeId node, const OpSpec* op);
  ValueType visitComp(NodeId node);
  ValueType visitBuiltinCall(NodeId node, const FunctionSpec& spec,
                             std::span<const NodeId> arguments);
  ValueType slotType(uint32_t slot, ValueType expected);
  /// A word of the general selectors, or the name of a part of the operation.
  bool isSelectorWord(std::string_view word, const OpSpec* op) const;
  void expectType(NodeId node, ValueType got, ValueType wanted, const char* what);
  void reportUnknownName(NodeId node);
  const AttributeInfo* attributeAt(NodeId node) const;
  std::string typeRemedy(const AttributeInfo& a, ValueType wanted) const;

  // --- successors.cpp ---
  void visitSequence(NodeId node);
  void visitSuccessor(NodeId node);
  void visitApply(NodeId node);
  void visitOperation(NodeId node, const OpSpec& op);
  void visitSet(NodeId node, const OpSpec& op);
  void reportUnknownPlace(NodeId place, ValueType given);
  void visitLocal(NodeId node, const OpSpec& op);
  void visitDo(NodeId node, const OpSpec& op);
  void visitImportCall(NodeId node, bool successor);
  std::string firstRuleOf(ModuleId module) const;
  bool reportImportValues(NodeId node, std::span<const NodeId> args);
  void checkGivenTypes(ModuleId target, NodeId list);
  void visitSuccessorChoice(NodeId node);
  void visitBlocks(NodeId node, const OpSpec& op);
  void visitBlock(NodeId block, const OpSpec& op);
  void visitRemainder(NodeId block, const OpSpec& op);
  void visitItem(NodeId item, const OpSpec& op);
  void visitAllBlocks(NodeId node);
  bool applyRule(NodeId node, const std::vector<RuleId>& rules, std::span<const NodeId> arguments,
                 const std::vector<ValueType>& types);
  void makeLeaf(NodeId node, bool known);
  bool fitsOperation(NodeId node, const OpSpec& op);
  void reportUndefinedRule(NodeId node, const RuleSet& found);
  /// A rule with the names of its parameters, in quotes.
  std::string formOf(const RuleInfo& rule) const;
  void reportArgument(NodeId node, const RuleInfo& rule, size_t parameter, ValueType got);
  void reportMissingHead(NodeId item, const OpSpec& op);
  /// The operation whose name `name` is a slip of; empty when there is none.
  std::string_view slippedOperation(NodeId node);
  void checkWeights(NodeId choice);

  // --- unused.cpp: what a sequence does in vain ---
  void reportUnused(NodeId sequence);
  bool runsInPlace();
  std::string tintedCall(NodeId material, NodeId color) const;
  std::string materialThatBegins(RuleId rule);
  void reportLostColors(NodeId sequence);

  // --- parts.cpp: named parts of blocks, and the figures that they begin with ---
  void reportSelector(NodeId node, const OpSpec* op);
  std::string partsText(const OpSpec& op) const;
  std::string partOwners(std::string_view word) const;
  std::string elseHint(const OpSpec* op);
  void visitSizeHead(NodeId head, const OpSpec& op);
  void checkFigure(NodeId item, const OpSpec& op);
  const OpSpec* figureOf(ModuleId module, NodeId sequence, int depth) const;

  // --- written_values.cpp: values that parameters do not take ---
  void checkWrittenValues(ModuleId firstModule);
  void checkEndlessRules(ModuleId firstModule);
  using CertainRules = std::vector<std::pair<RuleId, Span>>;
  void certainRules(NodeId sequence, CertainRules& out);
  void certainParts(NodeId block, CertainRules& out);
  void reportEndless(std::span<const RuleId> path, Span at);
  void reportEmptyFile();
  Value writtenValue(NodeId node);
  void checkWrittenSizes(NodeId block, const OpSpec& op);
  void checkShare(NodeId size, double share);
  void checkWrittenValue(NodeId node, const ParamSpec& param, std::string_view callee);
  std::optional<double> writtenNumber(NodeId node);
  void warnOfFraction(NodeId node, const std::string& what, double number, std::string hint);
  void checkFractions(std::string_view callee, const Signature& signature,
                      std::span<const NodeId> args);
  void checkSetFraction(std::span<const NodeId> args);
  void checkWrittenCall(NodeId node, std::string_view callee, const Signature& signature,
                        std::span<const NodeId> arguments);
  bool hasTerm(NodeId node, std::string_view name) const;

  // --- analyse.cpp: styles ---
  std::string chooseStyles(std::string_view text);
  void reportUnusedStyles();
  void addImportedStyles();

  // --- attribute_defaults.cpp: values that an attribute's own annotations leave out ---
  void checkDefaults(ModuleId firstModule);
  void checkDefault(NodeId node, const AttributeInfo& attribute);
  void checkValuesAttribute(const AttributeInfo& attribute);

  // --- analyse.cpp: definitions and rounds ---
  void walkRule(RuleId id);
  void walkFunction(FunctionId id);
  void walkAttribute(AttributeId id);
  void openFrame(size_t unit, ModuleId module, NodeId declaration,
                 const std::vector<ValueType>& paramTypes, const std::vector<bool>& open);
  void walkLocals(NodeId declaration);
  /// Rules, functions and attributes, in one row of numbers.
  enum class UnitKind : uint8_t { Rule, Function, Attribute };
  static constexpr size_t kUnitKinds = 3;
  static size_t unitOf(UnitKind kind, uint32_t id) {
    return size_t{id} * kUnitKinds + static_cast<size_t>(kind);
  }
  void walk(size_t unit);
  // --- originals.cpp: types that modules of one file share ---
  void chooseOriginal(ModuleId module);
  void copyType(UnitKind kind, uint32_t id, ModuleId to);
  void spread(size_t unit);
  bool isDeclaration(UnitKind kind, uint32_t id, ModuleId module) const;
  size_t originalOf(size_t unit) const;
  uint32_t originalId(UnitKind kind, uint32_t id) const {
    return static_cast<uint32_t>(originalOf(unitOf(kind, id)) / kUnitKinds);
  }

  /// Gives its number.
  size_t beginWalk(UnitKind kind, uint32_t id);
  bool isDue(size_t unit) const;
  bool isWalked(size_t unit) const { return unit < walked_.size() && walked_[unit].at > 0; }
  /// The body that is walked comes to that one, and depends on its types.
  void look(UnitKind kind, uint32_t id) const {
    if (body_.unit != kNoUnit) walked_[body_.unit].looked.push_back(unitOf(kind, id));
  }
  void walkOriginals();
  void reach(ModuleId main);
  void speak();
  /// Whether reports are kept for the last round, which walks the body again if there are any.
  bool isMute() {
    if (mute_ && body_.unit != kNoUnit) walked_[body_.unit].speaks = true;
    return mute_;
  }
  void settle();
  void infer(ModuleId main);
  template <class Info>
  void reportOverloads(const std::vector<std::vector<uint32_t>>& sets,
                       const std::vector<Info>& infos, const char* code);
  void tellOfImport(const Diagnostics& ofFile);
  /// "town.cga:3:6", for messages about a second one.
  std::string placeText(Span at) const;
  /// The first declaration of a kind and a name in a file.
  std::string firstPlaceText(const Tree& t, NodeKind kind, std::string_view name) const;
  void reportDuplicates(ModuleId firstModule);
  void reportOverrideTypes();
  void chooseStartRule();
  void checkOtherStyles();

  // --- order.cpp, fold.cpp ---
  void orderAttributes();
  void foldConstants();
  void foldModule(ModuleId module, bool& changed);
  Value foldNode(const Module& m, const Tree& t, NodeId node);

  // --- Small helpers ---
  const Tree& tree() const { return program_.tree(body_.module); }
  Module& module() { return program_.modules[body_.module]; }
  std::string_view text(NodeId node) const { return tree().text(node); }
  void resolve(NodeId node, RefKind kind, uint32_t index = kNone) {
    Resolution& r = module().resolutions[node];
    r = Resolution();
    r.kind = kind;
    r.index = index;
  }
  ValueType typed(NodeId node, ValueType type) {
    module().types[node] = type;
    return type;
  }
  void error(const char* code, Span span, std::string message, std::string hint = {});
  void warning(const char* code, Span span, std::string message, std::string hint = {});
  /// The remedy of the report just made, as an edit; nothing when it was left out.
  void fix(Span span, std::string text);
  /// The part of a span that writes `name`: behind a quote, an @ or the names of imports.
  Span placeOf(std::string_view name, Span span) const;
  void errorAt(const char* code, NodeId node, std::string message, std::string hint = {}) {
    error(code, tree().span(node), std::move(message), std::move(hint));
  }
  /// "did you mean" among what `names` returns; silent rounds and long runs of mistakes skip it.
  /// The report that follows carries the remedy as an edit.
  template <class Names>
  std::string near(std::string_view name, Names names) {
    constexpr int kMaxHints = 200;
    if (isMute() || hints_ >= kMaxHints) return {};
    ++hints_;
    meant_ = {name, nearestName(name, names())};
    return meant_.nearest.empty() ? std::string() : "did you mean '" + meant_.nearest + "'?";
  }
  /// What rules have in the place of a function of another language; empty where it is none.
  std::string hintOfForeignFunction(std::string_view name);
  std::string quote(std::string_view s) const { return "'" + std::string(s) + "'"; }

  const Catalogue& catalogue_;
  ValuePool& values_;
  FileLoader* loader_;
  Sources& sources_;
  Diagnostics& diagnostics_;
  ResolvedProgram program_;
  std::vector<UnitIndex> units_;
  std::vector<Scope> scopes_;
  std::map<std::string, uint32_t> unitByPath_;
  /// Paths of imports that have been told of.
  std::unordered_set<std::string> missingImports_;
  /// By (unit, import node): the unit imported; missing when it could not be loaded.
  std::map<std::pair<uint32_t, NodeId>, uint32_t> importedUnit_;
  /// The styles that were chosen for imports, by their paths.
  struct ChosenStyle {
    std::string style;
    bool taken = false;
  };
  std::map<std::string, ChosenStyle> importStyles_;
  std::map<std::pair<ModuleId, NodeId>, ModuleId> dynamicModules_;
  std::map<AttributeId, AttributeId> ownValues_;
  std::unordered_set<std::string_view> selectors_;
  Body body_;
  /// Rounds before the last one say nothing.
  bool mute_ = false;
  // A selector that stands without its colon, and so reads as a rule.
  NodeId headless_ = kNoNode;
  /// Whether something stands behind the choice whose branch is visited.
  bool followed_ = false;
  /// Whether the last report was taken in.
  bool reported_ = false;
  /// What near() found for the report to come.
  struct Meant {
    std::string_view name;
    std::string nearest;
  };
  Meant meant_;
  /// What to say of a name that stands for nothing, as the argument at work.
  std::string wordHint_;
  /// The words that may stand for the name at work, beside values.
  std::vector<std::string_view> wordsHere_;
  bool changed_ = false;
  /// By unit: when it was walked last and when its types changed last, in steps, what the walk has
  /// looked up, and whether it had something to report.
  struct Walk {
    uint64_t at = 0, changedAt = 0;
    bool speaks = false;
    std::vector<size_t> looked;
  };
  /// Look-ups change what they do not give.
  mutable std::vector<Walk> walked_;
  uint64_t steps_ = 0;
  bool everything_ = false;
  /// The first import that was one too many: rounds make modules, and are silent.
  std::optional<Span> tooManyAt_;
  /// By style, file and the originals of the imports.
  std::map<std::pair<std::string, std::vector<uint32_t>>, ModuleId> originals_;
  /// By original.
  std::map<ModuleId, std::vector<ModuleId>> copies_;
  int hints_ = 0;
  size_t errors_ = 0;
  size_t warnings_ = 0;
  /// By unit: texts and names that it asks fileExists about.
  std::map<uint32_t, std::unordered_set<std::string_view>> askedFiles_;
  /// Listed when the first file is missed.
  std::optional<std::vector<std::string>> projectFiles_, bundledFiles_;
  /// The paths that have been told; each is told where it stands first.
  std::unordered_set<std::string> missedFiles_;
  /// Nodes of all modules together.
  size_t nodes_ = 0;
  /// Body::open of rules and functions, between rounds.
  std::map<RuleId, std::vector<bool>> openRules_;
  /// Whether any rule is run in place, once asked.
  std::optional<bool> inPlace_;
  std::map<FunctionId, std::vector<bool>> openFunctions_;
};

/// What the annotations of a declaration say; mistakes are reported when `diagnostics` is given.
Annotations readAnnotations(const Tree& tree, NodeId list, GroupNote& group,
                            Diagnostics* diagnostics);
/// Adds what `base` says and `own` does not. What limits values (@Range, @Enum, @Color, @File)
/// counts as one: where `own` has any of it, it has all.
void addInherited(const Annotations& base, bool withGroup, Annotations& own);

}  // namespace gable::lang
