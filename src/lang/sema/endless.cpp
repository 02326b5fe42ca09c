// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules that cannot end, A --> extrude(1) A, and files that have none.

#include "base/work.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

// What stands in a choice or in a block may not be reached; the rest always is.
void Analysis::checkEndless(const RuleInfo& rule, NodeId sequence) {
  const Tree& t = tree();
  for (const NodeId item : t.children(sequence)) {
    work();
    if (t.kind(item) == NodeKind::Push) checkEndless(rule, t.child(item, 0));
    if (t.kind(item) != NodeKind::Apply) continue;
    // What follows has nothing to work on.
    if (t.text(item) == "NIL") return;
    const Resolution& r = module().at(item);
    if (r.kind != RefKind::Rule || r.index != rule.id) continue;
    warning("endless-rule", nameSpan(t, item),
            quote(rule.name) + " applies itself whatever happens, and ends at the limit on depth",
            "write 'case condition : ... else : ...' around it");
  }
}

void Analysis::checkEndlessRules(ModuleId firstModule) {
  for (size_t i = 0; i < program_.rules.size(); ++i) {
    const RuleInfo rule = program_.rules[i];
    if (rule.module < firstModule) continue;
    body_ = {};
    body_.module = rule.module;
    const NodeId body = bodyOf(tree(), rule.node);
    if (tree().kind(body) == NodeKind::Sequence) checkEndless(rule, body);
  }
}

void Analysis::reportEmptyFile() {
  const Tree& t = program_.units[0].tree;
  if (!t.children(t.root()).empty() || diagnostics_.hasErrors()) return;
  warning("empty-file", {t.file(), 0, 0}, "the file has no rules",
          "write one: Lot --> extrude(10)");
}

}  // namespace gable::lang
