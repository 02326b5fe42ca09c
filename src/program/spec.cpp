// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "program/spec.h"

#include <algorithm>

namespace gable {

namespace {

template <class T>
const T* find(std::span<const T* const> list, std::string_view name) {
  const auto at = std::lower_bound(list.begin(), list.end(), name, [](const T* a, auto n) {
    return std::string_view(a->name) < n;
  });
  return at != list.end() && (*at)->name == name ? *at : nullptr;
}

}  // namespace

const OpSpec* Catalogue::operation(std::string_view name) const { return find(operations, name); }
const FunctionSpec* Catalogue::function(std::string_view name) const {
  return find(functions, name);
}
const AttributeSpec* Catalogue::attribute(std::string_view name) const {
  return find(attributes, name);
}
bool Catalogue::isSelector(std::string_view name) const {
  return std::any_of(selectors.begin(), selectors.end(),
                     [&](const SelectorSpec& s) { return s.name == name; });
}

}  // namespace gable
