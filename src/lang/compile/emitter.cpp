// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/compile/emitter.h"

#include "base/hash.h"

namespace gable::lang {

uint32_t Emitter::emit(Code code, Span span, uint32_t a, uint8_t x, uint16_t y, uint64_t site) {
  p_.code.push_back({code, x, y, a});
  p_.spans.push_back(span);
  p_.sites.push_back(site);
  return here() - 1;
}

void Emitter::beginUnit(std::string_view qualifiedName) {
  unitHash_ = hashBytes(qualifiedName);
  uses_.clear();
}

uint64_t Emitter::site(std::string_view what) {
  auto at = uses_.find(what);
  if (at == uses_.end()) at = uses_.emplace(std::string(what), 0).first;
  return hashCombine(hashBytes(what, unitHash_), at->second++);
}

uint32_t Emitter::constant(const Value& v) {
  std::vector<uint32_t>& same = constants_[v.hash()];
  for (uint32_t i : same) {
    if (p_.constants[i] == v && p_.constants[i].unit == v.unit) return i;
  }
  p_.constants.push_back(v);
  same.push_back(static_cast<uint32_t>(p_.constants.size() - 1));
  return same.back();
}

uint32_t Emitter::constantRun(const std::vector<Value>& values) {
  const auto first = static_cast<uint32_t>(p_.constants.size());
  p_.constants.insert(p_.constants.end(), values.begin(), values.end());
  return first;
}

uint32_t Emitter::table(std::vector<uint32_t> entries) {
  p_.jumpTables.push_back(std::move(entries));
  return static_cast<uint32_t>(p_.jumpTables.size() - 1);
}

template <class Entry>
uint32_t Emitter::numberOf(const void* spec, const Signature* form, Entry entry,
                           std::vector<Entry>& list) {
  const auto [at, fresh] = specs_.try_emplace({spec, form}, static_cast<uint32_t>(list.size()));
  if (fresh) list.push_back(entry);
  return at->second;
}

uint32_t Emitter::operation(const OpSpec* spec, const Signature* form) {
  return numberOf(spec, form, Choice<OpSpec>{spec, form}, p_.operations);
}
uint32_t Emitter::function(const FunctionSpec* spec, const Signature* form) {
  return numberOf(spec, form, Choice<FunctionSpec>{spec, form}, p_.builtinFunctions);
}
uint32_t Emitter::attribute(const AttributeSpec* spec) {
  return numberOf(spec, nullptr, spec, p_.builtinAttributes);
}

}  // namespace gable::lang
