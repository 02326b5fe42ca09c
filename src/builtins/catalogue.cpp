// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/catalogue.h"

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "builtins/lists.h"
#include "builtins/selectors.h"

namespace gable {

namespace {

template <class T>
void sortUnique(std::vector<const T*>& list) {
  std::sort(list.begin(), list.end(), [](const T* a, const T* b) {
    return std::string_view(a->name) < std::string_view(b->name);
  });
  for (size_t i = 1; i < list.size(); ++i) {
    GABLE_CHECK(std::string_view(list[i - 1]->name) != list[i]->name);
  }
}

struct Storage {
  std::vector<const OpSpec*> operations;
  std::vector<const FunctionSpec*> functions;
  std::vector<const AttributeSpec*> attributes;
  Catalogue catalogue;

  Storage() {
    for (const OpList& list : allOpLists()) {
      for (const OpSpec& op : list) operations.push_back(&op);
    }
    for (const FunctionList& list : allFunctionLists()) {
      for (const FunctionSpec& f : list.functions) functions.push_back(&f);
      for (const AttributeSpec& a : list.attributes) attributes.push_back(&a);
    }
    sortUnique(operations);
    sortUnique(functions);
    sortUnique(attributes);
    catalogue = {operations, functions, attributes, kSelectors};
  }
};

}  // namespace

const Catalogue& builtinCatalogue() {
  static const Storage storage;
  return storage.catalogue;
}

}  // namespace gable
