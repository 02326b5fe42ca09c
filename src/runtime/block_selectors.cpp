// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/block_selectors.h"

namespace gable {

namespace {

SelectorTerm termOf(const BlockTerm& t, const Value* values) {
  SelectorTerm term;
  term.kind = static_cast<SelectorTerm::Kind>(t.kind);
  term.word = t.word;
  term.number = t.number;
  if (t.value < 0) return term;
  const Value& v = values[t.value];
  term.number = v.number;
  if (v.type == ValueType::Bool) term.kind = SelectorTerm::Kind::Boolean;
  if (v.type == ValueType::Selector || v.type == ValueType::String) term.word = v.id;
  if (v.type == ValueType::BoolArray) {
    term.kind = SelectorTerm::Kind::Boolean;
    term.word = v.id + 1;
  }
  return term;
}

}  // namespace

std::span<const SelectorItem> BlockSelectors::of(const BlockCode& block, const Value* values) {
  terms_.clear();
  items_.clear();
  for (const BlockTerm& t : block.terms) terms_.push_back(termOf(t, values));
  for (const BlockItem& item : block.items) {
    SelectorItem s;
    s.terms = std::span(terms_).subspan(item.firstTerm, item.termCount);
    s.op = static_cast<SelectOperator>(item.selectOperator);
    s.slot = item.slot;
    items_.push_back(s);
  }
  return items_;
}

}  // namespace gable
