// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/compile/emitter.h"

#include "base/hash.h"
#include "base/work.h"
#include "program/stack.h"

namespace gable::lang {

uint32_t Emitter::emit(Code code, Span span, uint32_t a, size_t x, size_t y, uint64_t site) {
  work();
  const auto narrowX = static_cast<uint8_t>(x);
  const auto narrowY = static_cast<uint16_t>(y);
  if (narrowX != x || narrowY != y || ++depth_ > kMostOnStack) tooLarge(code, span, x);
  p_.code.push_back({code, narrowX, narrowY, a});
  p_.spans.push_back(span);
  p_.sites.push_back(site);
  return here() - 1;
}

// One such mistake tends to bring thousands more.
void Emitter::tooLarge(Code code, Span span, size_t x) {
  if (told_) return;
  told_ = true;
  if (depth_ > kMostOnStack) {
    diagnostics_.error("code-too-large", span,
                       "more than " + std::to_string(kMostOnStack) + " values are needed at once",
                       "read long lists from a file, or put them into attributes of their own");
  } else if (x > UINT8_MAX) {
    diagnostics_.error("code-too-large", span, "more than 255 values are given in one call",
                       "give a list in place of single values");
  } else if (code == Code::Choose) {
    diagnostics_.error("code-too-large", span, "a choice has more than 65535 alternatives",
                       "choose among groups first, and then within the group");
  } else {
    diagnostics_.error("code-too-large", span, "the rules have more than 65534 blocks in all",
                       "use rules in place of blocks that are written again and again");
  }
}

void Emitter::beginUnit(std::string_view qualifiedName) {
  unitHash_ = hashBytes(qualifiedName);
  uses_.clear();
  depth_ = 0;
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

uint32_t Emitter::constantCall() {
  // As many as an instruction has room for.
  constexpr uint32_t kMost = 0xffff;
  return p_.constantCalls < kMost ? ++p_.constantCalls : 0;
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
