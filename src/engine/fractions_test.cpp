// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is held to lie between 0 and 1 is there by its name.

#include "lang/sema/fractions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "builtins/catalogue.h"

namespace gable {
namespace {

bool takes(std::span<const Signature> signatures, std::string_view parameter) {
  return std::any_of(signatures.begin(), signatures.end(), [&](const Signature& s) {
    return std::any_of(s.params.begin(), s.params.end(),
                       [&](const ParamSpec& p) { return p.name == parameter; });
  });
}

bool isThere(std::string_view callee, std::string_view parameter) {
  const Catalogue& catalogue = builtinCatalogue();
  if (callee == "set") {
    const AttributeSpec* a = catalogue.attribute(parameter);
    return a && a->set && a->type == ValueType::Float;
  }
  const OpSpec* op = catalogue.operation(callee);
  const FunctionSpec* f = catalogue.function(callee);
  return (op && takes(op->signatures, parameter)) || (f && takes(f->signatures, parameter));
}

TEST(Fractions, areOfTheCatalogue) {
  EXPECT_FALSE(isThere("color", "colour"));
  EXPECT_FALSE(isThere("set", "material.gloss"));
  for (const lang::Fractions& f : lang::fractions()) {
    for (const std::string_view p : f.parameters) {
      EXPECT_TRUE(isThere(f.callee, p)) << f.callee << ": " << p;
      EXPECT_TRUE(lang::isFraction(f.callee, p));
    }
  }
}

}  // namespace
}  // namespace gable
