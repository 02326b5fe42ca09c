// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules come first in the code, in their order, each followed by its slots: Program::ruleAt relies
// on it. Functions and initialisers follow.

#include "lang/compile/compile.h"

#include <algorithm>

#include "lang/compile/dependence.h"
#include "lang/compile/unit_compiler.h"

namespace gable::lang {

namespace {

uint32_t effectsOf(const Resolution& r) {
  switch (r.kind) {
    case RefKind::Operation: return r.spec.operation->effects;
    case RefKind::BuiltinFunction: return r.spec.function ? r.spec.function->effects : 0;
    case RefKind::ShapeAttribute: return r.spec.attribute->effects;
    default: return 0;
  }
}

// Copies name what their originals name.
uint32_t effectsOf(const ResolvedProgram& resolved) {
  uint32_t effects = 0;
  for (const Module& m : resolved.modules) {
    if (m.original != m.id) continue;
    for (const Resolution& r : m.resolutions) effects |= effectsOf(r);
  }
  return effects;
}

class Compiler {
 public:
  Compiler(const ResolvedProgram& resolved, const Catalogue& catalogue,
           std::shared_ptr<ValuePool> pool, const Sources& sources, Diagnostics& diagnostics)
      : r_(resolved), component_(catalogue.operation("comp")), emitter_(program_, diagnostics) {
    program_.pool = std::move(pool);
    for (uint32_t f = 0; f < sources.size(); ++f) program_.files.push_back(sources.path(f));
  }

  Program run() {
    ruleUses_.resize(r_.rules.size());
    functionUses_.resize(r_.functions.size());
    initialiserUses_.resize(r_.attributes.size());
    for (const RuleInfo& rule : r_.rules) compileRule(rule);
    for (const FunctionInfo& f : r_.functions) compileFunction(f);
    for (const AttributeInfo& a : r_.attributes) compileAttribute(a);
    closeDependence(program_, ruleUses_, functionUses_, initialiserUses_);
    program_.effects = effectsOf(r_);
    program_.startRule = r_.startRule == kNone ? -1 : static_cast<int32_t>(r_.startRule);
    program_.indexNames();
    return std::move(program_);
  }

 private:
  UnitCompiler unit(ModuleId module, Uses& uses, std::string_view qualifiedName) {
    emitter_.beginUnit(qualifiedName);
    return UnitCompiler(r_, module, emitter_, uses, component_);
  }

  void compileRule(const RuleInfo& rule) {
    const Tree& tree = r_.tree(rule.module);
    RuleCode code;
    const size_t dot = rule.name.rfind('.');
    code.name =
        program_.pool->intern(dot == std::string::npos ? rule.name : rule.name.substr(dot + 1));
    code.qualifiedName = rule.qualifiedName;
    code.entry = emitter_.here();
    code.span = nameSpan(tree, rule.node);
    code.file = tree.file();
    code.startRule = rule.start || rule.annotations.startRule;
    code.hidden = rule.annotations.hidden;
    code.reached = rule.reached;
    for (NodeId p : tree.children(paramsOf(tree, rule.node))) {
      code.parameters.push_back({program_.pool->intern(tree.text(p)), ValueType::Null});
    }
    Uses& uses = ruleUses_[rule.id];
    if (rule.reached) {
      UnitCompiler compiler = unit(rule.module, uses, rule.qualifiedName);
      compiler.locals(localsOf(tree, rule.node));
      compiler.body(bodyOf(tree, rule.node), tree.span(rule.node));
    } else {
      emitter_.emit(Code::End, code.span);
    }
    code.needsPrevious = (uses.effects & kReadsPrevious) != 0;
    program_.rules.push_back(std::move(code));
  }

  void compileFunction(const FunctionInfo& f) {
    const Tree& tree = r_.tree(f.module);
    FunctionCode code;
    code.name = program_.pool->intern(f.name);
    code.parameterCount = f.paramCount;
    code.entry = emitter_.here();
    code.span = nameSpan(tree, f.node);
    code.file = tree.file();
    if (f.reached) {
      UnitCompiler compiler = unit(f.module, functionUses_[f.id], f.qualifiedName);
      compiler.locals(localsOf(tree, f.node));
      compiler.expression(bodyOf(tree, f.node));
    }
    emitter_.emit(Code::Return, code.span);
    program_.functions.push_back(code);
  }

  void compileAttribute(const AttributeInfo& a) {
    const Tree& tree = r_.tree(a.module);
    AttributeCode code;
    code.name = a.qualifiedName;
    code.type = a.type;
    code.constant = a.constant;
    code.hidden = a.annotations.hidden;
    code.span = nameSpan(tree, a.node);
    code.entry = emitter_.here();
    code.annotations = listed(a.annotations, *program_.pool);
    // A random value of an attribute must not change with the text around it, so it has a unit.
    Uses& uses = initialiserUses_[a.id];
    if (a.source == ValueSource::Propagated) {
      code.propagatesFrom = static_cast<int32_t>(a.from);
      uses.attributes.insert(a.from);
      emitter_.emit(Code::RuleAttribute, code.span, a.from);
    } else if (a.source == ValueSource::Override) {
      unit(a.valueModule, uses, a.qualifiedName).expression(a.valueNode);
    } else {
      UnitCompiler compiler = unit(a.module, uses, a.qualifiedName);
      compiler.locals(localsOf(tree, a.node));
      compiler.expression(bodyOf(tree, a.node));
    }
    emitter_.emit(Code::Return, code.span);
    program_.attributes.push_back(std::move(code));
  }

  const ResolvedProgram& r_;
  const OpSpec* component_;
  Program program_;
  Emitter emitter_;
  std::vector<Uses> ruleUses_, functionUses_, initialiserUses_;
};

}  // namespace

std::vector<AnnotationInfo> listed(const Annotations& a, ValuePool& pool) {
  std::vector<AnnotationInfo> out;
  const auto flag = [&](bool is, const char* name) {
    if (is) out.push_back({name, {}});
  };
  const auto text = [&](const std::string& value, const char* name) {
    if (!value.empty()) out.push_back({name, {{"", pool.string(value)}}});
  };
  text(a.description, "Description");
  text(a.displayName, "DisplayName");
  if (a.order) out.push_back({"Order", {{"", Value::of(*a.order)}}});
  if (!a.group.path.empty()) {
    AnnotationInfo group{"Group", {}};
    for (const std::string& g : a.group.path) group.arguments.push_back({"", pool.string(g)});
    if (a.group.order) group.arguments.push_back({"order", Value::of(*a.group.order)});
    out.push_back(std::move(group));
  }
  if (a.range) {
    AnnotationInfo range{"Range",
                         {{"min", Value::of(a.range->min)}, {"max", Value::of(a.range->max)}}};
    if (a.range->step != 0) range.arguments.push_back({"stepsize", Value::of(a.range->step)});
    range.arguments.push_back({"restricted", Value::of(a.range->restricted)});
    out.push_back(std::move(range));
  }
  if (a.choices) {
    AnnotationInfo choices{"Enum", {}};
    for (const EnumValue& v : a.choices->values) {
      choices.arguments.push_back({"", v.isNumber ? Value::of(v.number) : pool.string(v.text)});
    }
    if (!a.choices->valuesAttribute.empty()) {
      choices.arguments.push_back({"valuesAttr", pool.string(a.choices->valuesAttribute)});
    }
    choices.arguments.push_back({"restricted", Value::of(a.choices->restricted)});
    out.push_back(std::move(choices));
  }
  flag(a.unit == UnitNote::Angle, "Angle");
  flag(a.unit == UnitNote::Distance, "Distance");
  flag(a.unit == UnitNote::Percent, "Percent");
  if (a.file != FileNote::None) {
    AnnotationInfo file{a.file == FileNote::Directory      ? "Directory"
                        : a.file == FileNote::MaterialFile ? "MaterialFile"
                                                           : "File",
                        {}};
    for (const std::string& e : a.extensions) file.arguments.push_back({"", pool.string(e)});
    out.push_back(std::move(file));
  }
  flag(a.color, "Color");
  flag(a.hidden, "Hidden");
  flag(a.startRule, "StartRule");
  constexpr const char* kInputs[] = {nullptr,  "InMesh",  "InPolygon",
                                     "InLine", "InPoint", "InPointCloud"};
  const char* input = kInputs[static_cast<size_t>(a.input)];
  flag(input != nullptr, input);
  if (a.separateShapes) {
    out.push_back({"Out", {{"granularity", pool.string("separatedShapes")}}});
  }
  text(a.label, "Label");
  for (const HandleNote& handle : a.handles) {
    AnnotationInfo info{"Handle", {}};
    for (const auto& [key, value] : handle) info.arguments.push_back({key, pool.string(value)});
    out.push_back(std::move(info));
  }
  return out;
}

Program compile(const ResolvedProgram& resolved, const Catalogue& catalogue,
                std::shared_ptr<ValuePool> pool, const Sources& sources, Diagnostics& diagnostics) {
  return Compiler(resolved, catalogue, std::move(pool), sources, diagnostics).run();
}

}  // namespace gable::lang
