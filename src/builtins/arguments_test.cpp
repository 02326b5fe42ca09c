// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// All operations and functions take their arguments in structs, and a value of a type that a
// parameter does not take never comes through: rules pass values on whose types are known only when
// they run.

#include <gtest/gtest.h>

#include <algorithm>

#include "builtins/catalogue.h"
#include "builtins/testing/op_fixture.h"

namespace gable {

namespace {

const Arg kOneOfEach[] = {1.5,         true,          "text",        word("all"),
                          floats({1}), bools({true}), strings({"a"})};

// One that the parameter takes.
Value fitting(const ParamSpec& p, ValuePool& pool) {
  switch (p.type) {
    case ParamType::Bool: return Value::of(true);
    case ParamType::String: {
      const Value text = pool.string("text");
      return isTaken(p, text, pool) ? text : pool.string("#ffffff");
    }
    case ParamType::Selector: {
      const std::string_view words = p.words ? p.words : "all";
      return pool.selector(words.substr(0, words.find(' ')));
    }
    case ParamType::FloatArray: {
      const Value list = floats({1, 2}).value(pool);
      return isTaken(p, list, pool) ? list : floats({0, 1}).value(pool);
    }
    case ParamType::BoolArray: return bools({true, false}).value(pool);
    case ParamType::StringArray: return strings({"a", "b"}).value(pool);
    default: return Value::of(p.range.holds(1) ? 1 : p.range.least + 1);
  }
}

// What the compiler makes code of: three are never called, the fourth gets a list that it made.
bool isCode(std::string_view name) {
  return name == "do" || name == "repeat" || name == "local" || name == "setbackPerEdge";
}

// Calls with one argument of each type in turn that its parameter does not take.
template <class Call>
void refusesOtherTypes(const char* name, std::span<const Signature> signatures, ValuePool& pool,
                       Call&& refuses) {
  for (const Signature& s : signatures) {
    std::vector<Value> values;
    for (const ParamSpec& p : s.params) {
      EXPECT_NE(p.store, nullptr) << name << " reads " << p.name << " by number";
      values.push_back(fitting(p, pool));
    }
    for (size_t i = 0; i < values.size(); ++i) {
      const Value before = values[i];
      for (const Arg& other : kOneOfEach) {
        if (fits(other.type, s.params[i].type)) continue;
        values[i] = other.value(pool);
        EXPECT_TRUE(refuses(s, values))
            << name << " takes a " << typeName(other.type) << " for " << s.params[i].name;
      }
      values[i] = before;
    }
  }
}

}  // namespace

TEST(Arguments, functionsRefuseOtherTypes) {
  FakeServices services;
  const Shape shape = boxShape({1, 1, 1});
  for (const FunctionSpec* f : builtinCatalogue().functions) {
    refusesOtherTypes(f->name, f->signatures, services.pool(),
                      [&](const Signature& form, std::span<const Value> values) {
                        services.warnings.clear();
                        FunctionCall call(values, shape, services, f, &form);
                        call.run(f->call, f->effects);
                        return services.warnings.size() == 1 &&
                               services.warnings[0].code == "wrong-argument";
                      });
  }
}

TEST(Arguments, operationsRefuseOtherTypes) {
  FakeServices services;
  for (const OpSpec* op : builtinCatalogue().operations) {
    if (isCode(op->name)) continue;
    refusesOtherTypes(op->name, op->signatures, services.pool(),
                      [&](const Signature& form, std::span<const Value> values) {
                        Shape shape = boxShape({1, 1, 1});
                        const CallPlace place{shape.scope, shape.size, "rules/test.cga", 0, &form};
                        std::vector<BlockChild> children;
                        BlockInput block;
                        block.children = &children;
                        OpCall call(*op, shape, values, services, place, &block);
                        const Status status = call.run();
                        return !status.ok() && status.code() == std::string_view("wrong-argument");
                      });
  }
}

}  // namespace gable
