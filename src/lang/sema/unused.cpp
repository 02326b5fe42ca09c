// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a sequence does in vain: operations behind its last shape, and colours that a material
// replaces.

#include <algorithm>

#include "base/work.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

// Whether a rule somewhere is run in place, so that what follows its calls is not lost.
bool Analysis::runsInPlace() {
  if (inPlace_) return *inPlace_;
  inPlace_ = std::any_of(program_.units.begin(), program_.units.end(), [&](const Unit& unit) {
    for (NodeId n = 1; n < unit.tree->size(); ++n) {
      work();
      if (unit.tree->kind(n) == NodeKind::Apply && unit.tree->text(n) == "do") return true;
    }
    return false;
  });
  return *inPlace_;
}

// Operations behind the last rule, leaf or division of a sequence change a shape that becomes
// nothing.
void Analysis::reportUnused(NodeId sequence) {
  if (sequence == kNoNode) return;
  constexpr uint32_t kTells = kReports | kLabels | kAsksForRoom;
  const Module& module = program_.modules[body_.module];
  NodeId made = kNoNode, unused = kNoNode;
  for (const NodeId s : tree().children(sequence)) {
    const NodeKind kind = tree().kind(s);
    const Resolution& means = module.at(s);
    if (kind == NodeKind::Push) reportUnused(tree().child(s, 0));
    if (kind == NodeKind::Choice) {
      for (const NodeId branch : tree().children(s)) reportUnused(tree().child(branch, 1));
    }
    if (kind == NodeKind::Apply && means.kind == RefKind::Operation) {
      const OpSpec& op = *means.spec.operation;
      // NIL says that nothing is to become of it.
      const bool changes =
          op.block == BlockKind::None && (op.effects & kTells) == 0 && text(s) != "NIL";
      // What divides a shape leaves nothing of it, unless it waits for its parts.
      const bool divides =
          (op.block == BlockKind::Split || op.block == BlockKind::Selectors) && !op.gathered;
      if (changes && made != kNoNode && unused == kNoNode) unused = s;
      if (!changes) made = divides ? s : kNoNode, unused = kNoNode;
    } else {
      // A name without a meaning has its own message.
      const bool leaf = means.kind == RefKind::Leaf && tree().has(s, kFlagTerminal);
      const bool ends = means.kind == RefKind::Rule || leaf;
      made = ends ? s : kNoNode;
      unused = kNoNode;
    }
  }
  if (unused == kNoNode) return;
  warning("unused-operation", nameSpan(tree(), unused),
          quote(text(unused)) + " stands behind " + quote(text(made)) +
              " and changes a shape that nothing is made of",
          "write it before " + quote(text(made)) + ", or in the rule of what it is for");
}

// material("brick", x), of the calls material("brick") and color(x).
std::string Analysis::tintedCall(NodeId material, NodeId color) const {
  const auto written = [&](NodeId node) {
    const Span span = tree().span(node);
    return std::string(sources_.text(span.file).substr(span.begin, span.end - span.begin));
  };
  const std::span<const NodeId> tint = arguments(tree().child(color, 0));
  return "material(" + written(arguments(tree().child(material, 0))[0]) + ", " +
         (tint.size() == 1 ? written(tint[0]) : "\"#rrggbb\"") + ")";
}

// The name of the material that a rule begins with, as it is written; empty where it begins with
// something else, or gives the material a tint.
std::string Analysis::materialThatBegins(RuleId rule) {
  const RuleInfo& r = program_.rules[rule];
  const Tree& t = program_.tree(r.module);
  const NodeId body = bodyOf(t, r.node);
  if (body == kNoNode || t.children(body).empty()) return {};
  const NodeId first = t.child(body, 0);
  if (t.kind(first) != NodeKind::Apply || t.text(first) != "material") return {};
  const std::span<const NodeId> args = t.children(t.child(first, 0));
  if (args.size() != 1 || !rulesNamed(r.module, "material").rules.empty()) return {};
  const Span span = t.span(args[0]);
  return std::string(sources_.text(span.file).substr(span.begin, span.end - span.begin));
}

// color(x) material("brick"): a material of the library without a tint has a colour of its own. So
// it is where the material stands at the beginning of the one rule that the colour can be for.
void Analysis::reportLostColors(NodeId sequence) {
  NodeId color = kNoNode;
  const std::span<const NodeId> all = tree().children(sequence);
  for (const NodeId s : all) {
    const NodeKind kind = tree().kind(s);
    const bool works = kind == NodeKind::Apply && module().at(s).kind == RefKind::Operation &&
                       module().at(s).spec.operation->block == BlockKind::None;
    if (!works) {
      const bool calls = module().at(s).kind == RefKind::Rule && s == all.back() && !followed_;
      const std::string material =
          calls && color != kNoNode ? materialThatBegins(module().at(s).index) : std::string();
      if (!material.empty()) {
        warning("lost-color", nameSpan(tree(), color),
                "the rule " + quote(text(s)) +
                    " begins with 'material', which has a colour of its own and takes the place "
                    "of this one",
                "to keep this one, write there: material(" + material + ", material.color.rgb)");
      }
      color = kNoNode;
      continue;
    }
    const std::span<const NodeId> args = arguments(tree().child(s, 0));
    if (text(s) == "material" && args.size() == 1 && color != kNoNode) {
      warning("lost-color", nameSpan(tree(), color),
              "'material' has a colour of its own and takes the place of this one",
              "give it as the second argument: " + tintedCall(s, color));
    }
    if (text(s) == "material") color = kNoNode;
    if (text(s) == "color") color = s;
  }
}

}  // namespace gable::lang
