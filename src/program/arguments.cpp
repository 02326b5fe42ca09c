// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "program/arguments.h"

#include <algorithm>
#include <limits>

#include "base/number.h"
#include "base/small_buffer.h"

namespace gable {

namespace {

bool isNoWord(const ParamSpec& p, const Value& v, const ValuePool& pool) {
  const bool isText = v.type == ValueType::Selector || v.type == ValueType::String;
  return p.type == ParamType::Selector && p.words && isText &&
         wordIndex(p.words, pool.text(v.id)) < 0;
}

bool accepts(const Signature& s, std::span<const Value> values, const ValuePool& pool) {
  if (!s.acceptsCount(values.size())) return false;
  for (size_t i = 0; i < values.size(); ++i) {
    const ParamSpec& p = *s.paramAt(i);
    if (!fits(values[i].type, p.type) || isNoWord(p, values[i], pool)) return false;
  }
  return true;
}

// Puts a value for each parameter into the struct, until one is not taken.
ArgumentProblem storeAll(const Signature& form, const Value* values, const ValuePool& pool,
                         void* arguments) {
  using Kind = ArgumentProblem::Kind;
  for (size_t i = 0; i < form.params.size(); ++i) {
    const ParamSpec& p = form.params[i];
    const Value& v = values[i];
    // A field that other signatures leave out is asked for in this one.
    const bool missing = v.type == ValueType::Null && p.mayBeMissing && !p.defaultText;
    if (missing || !p.store(arguments, v, pool) || (p.words && isNoWord(p, v, pool))) {
      return {Kind::Type, i, &p};
    }
    const bool taken = v.type == ValueType::Float ? p.range.holds(v.number) : isTaken(p, v, pool);
    if (!taken) return {Kind::Value, i, &p};
  }
  return {};
}

// The signature for these values; where none fits, one that takes as many, to say what is wrong.
const Signature* choose(std::span<const Signature> signatures, std::span<const Value> values,
                        const ValuePool& pool) {
  const Signature* byCount = nullptr;
  for (const Signature& s : signatures) {
    if (accepts(s, values, pool)) return &s;
    if (!byCount && s.acceptsCount(values.size())) byCount = &s;
  }
  return byCount;
}

}  // namespace

int wordIndex(const char* words, std::string_view word) {
  if (!words) return -1;
  for (int place = 0; *words; ++place) {
    size_t same = 0;
    const auto ends = [&] { return words[same] == 0 || words[same] == ' '; };
    while (same < word.size() && !ends() && words[same] == word[same]) ++same;
    if (same == word.size() && ends()) return place;
    while (!ends()) ++same;
    words += words[same] == 0 ? same : same + 1;
  }
  return -1;
}

Value defaultValue(const ParamSpec& param, ValuePool& pool) {
  if (param.mayBeMissing || param.defaultText == nullptr) return {};
  std::string_view text = param.defaultText;
  if (text.size() >= 2 && text.front() == '"') {
    text.remove_prefix(1);
    text.remove_suffix(1);
    return pool.string(text);
  }
  if (text == "true" || text == "false") return Value::of(text == "true");
  if (param.type == ParamType::Selector) return pool.selector(text);
  if (double plain = 0; param.type == ParamType::Selection && !parseNumber(text, plain)) {
    return pool.selector(text);
  }
  if (text == "inf") return Value::of(std::numeric_limits<double>::infinity());
  Unit unit = Unit::Absolute;
  if (text.front() == '\'') unit = Unit::Relative;
  if (text.front() == '~') unit = Unit::Floating;
  if (unit != Unit::Absolute) text.remove_prefix(1);
  Value v = Value::of(0.0);
  parseNumber(text, v.number);
  v.unit = unit;
  return v;
}

ArgumentProblem bindArguments(std::span<const Signature> signatures, const Signature* form,
                              std::span<const Value> values, ValuePool& pool, void* arguments) {
  if (form) return storeAll(*form, values.data(), pool, arguments);
  form = choose(signatures, values, pool);
  if (!form) return {ArgumentProblem::Kind::Count, 0, nullptr};
  SmallBuffer<Value, 16> filled;
  for (const Value& v : values) filled.push_back(v);
  for (size_t i = values.size(); i < form->params.size(); ++i) {
    filled.push_back(defaultValue(form->params[i], pool));
  }
  return storeAll(*form, filled.begin(), pool, arguments);
}

bool isTaken(const ParamSpec& param, const Value& v, const ValuePool& pool) {
  switch (v.type) {
    case ValueType::Float: return param.range.holds(v.number);
    case ValueType::FloatArray: {
      if (param.range.any()) return true;
      const std::vector<double>& all = pool.array(v).numbers;
      return std::all_of(all.begin(), all.end(), [&](double x) { return param.range.holds(x); });
    }
    case ValueType::String: return !param.form || param.form->holds(pool.text(v.id));
    default: return true;
  }
}

std::string refusalText(const ParamSpec& param, std::string_view callee, const Value& v,
                        const ValuePool& pool) {
  const std::string which = "'" + std::string(param.name) + "' of '" + std::string(callee) + "'";
  if (v.type == ValueType::String) {
    const std::string_view text = pool.text(v.id);
    constexpr size_t kMost = 40;
    const std::string shown(text.substr(0, kMost));
    return which + " is " + param.form->name + ", and '" + shown +
           (text.size() > kMost ? "...'" : "'") + " is none";
  }
  double number = v.number;
  if (v.type == ValueType::FloatArray) {
    for (const double x : pool.array(v).numbers) {
      if (!param.range.holds(x)) number = x;
    }
    return which + " cannot hold " + shortestText(number);
  }
  const char* const prefix = v.unit == Unit::Relative ? "'" : v.unit == Unit::Floating ? "~" : "";
  return which + " cannot be " + prefix + shortestText(number);
}

std::string refusalHint(const ParamSpec& param) {
  return param.form ? param.form->hint : "write " + rangeText(param.range) + ": " + param.doc;
}

std::string problemText(const ArgumentProblem& problem, std::string_view callee,
                        std::span<const Value> values, const ValuePool& pool) {
  const std::string name = "'" + std::string(callee) + "'";
  if (problem.kind == ArgumentProblem::Kind::Value) {
    const Value v = problem.index < values.size() ? values[problem.index] : Value();
    return refusalText(*problem.param, callee, v, pool);
  }
  if (problem.kind == ArgumentProblem::Kind::Count) {
    return name + " cannot be called with " + std::to_string(values.size()) + " arguments";
  }
  const std::string which = "'" + std::string(problem.param->name) + "' of " + name + " is ";
  const ValueType wanted = valueType(problem.param->type);
  const ValueType got =
      problem.index < values.size() ? values[problem.index].type : ValueType::Null;
  if (wanted == ValueType::Selector && fits(got, problem.param->type)) {
    return which + "none of its words";
  }
  return which + "a " + typeName(got) + ", not a " + typeName(wanted);
}

std::string problemHint(const ArgumentProblem& problem) {
  if (!problem.param) return "see what it takes with 'gable ops'";
  if (problem.kind == ArgumentProblem::Kind::Value) return refusalHint(*problem.param);
  std::string hint = problem.param->doc;
  if (problem.param->words) hint += " One of: " + std::string(problem.param->words);
  return hint;
}

}  // namespace gable
