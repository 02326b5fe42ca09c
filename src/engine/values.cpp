// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Attribute values from text and from files, as values of a rule file's pool.

#include <algorithm>

#include "base/number.h"
#include "base/text.h"
#include "base/work.h"
#include "engine/impl.h"
#include "material/material.h"

namespace gable {

namespace {

// With or without quotes.
Value stringOfText(std::string_view text, ValuePool& pool) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return pool.string(text);
}

Value scalarOfText(std::string_view text, ValuePool& pool) {
  double number = 0;
  if (parseNumber(text, number)) return Value::of(number);
  if (text == "true" || text == "false") return Value::of(text == "true");
  return stringOfText(text, pool);
}

std::vector<std::string_view> cut(std::string_view text, char at) {
  std::vector<std::string_view> out;
  size_t from = 0;
  for (size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] != at) continue;
    std::string_view part = text.substr(from, i - from);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    out.push_back(part);
    from = i + 1;
  }
  return out;
}

void append(Array& a, const Value& v) {
  if (a.element == ValueType::String)
    a.strings.push_back(v.id);
  else
    a.numbers.push_back(v.number);
}

}  // namespace

Value valueOfText(const std::string& text, ValuePool& pool) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') {
    return scalarOfText(text, pool);
  }
  Array a;
  const std::string_view inner = std::string_view(text).substr(1, text.size() - 2);
  if (inner.find_first_not_of(' ') == std::string_view::npos) return pool.intern(std::move(a));
  for (std::string_view row : cut(inner, ';')) {
    const auto items = cut(row, ',');
    for (size_t i = 0; i < items.size(); ++i) {
      Value v = scalarOfText(items[i], pool);
      if (a.rows == 0 && i == 0) a.element = v.type;
      // A ragged or mixed list is no array: it stays text, and the type check says so.
      if (v.type != a.element) return pool.string(text);
      append(a, v);
    }
    if (a.rows > 0 && items.size() != a.columns) return pool.string(text);
    a.columns = static_cast<uint32_t>(items.size());
    ++a.rows;
  }
  return pool.intern(std::move(a));
}

Result<Value> settingOf(const std::string& name, const std::string& text, ValueType type,
                        ValuePool& pool) {
  const auto refuse = [&](const char* what, const char* remedy) {
    constexpr size_t kShown = 60;
    const std::string shown = text.size() > kShown ? text.substr(0, kShown) + "..." : text;
    return Error{"attribute-value", "'" + name + "' is " + what + ", and '" + shown + "' is none",
                 remedy};
  };
  if (type == ValueType::String) return stringOfText(text, pool);
  const Value v = valueOfText(text, pool);
  switch (type) {
    case ValueType::Float:
      if (v.type != type) return refuse("a number", "write it as 12, -0.5 or 1e3");
      break;
    case ValueType::Bool:
      if (v.type == ValueType::Float && (v.number == 0 || v.number == 1)) {
        return Value::of(v.number == 1);
      }
      if (v.type != type) return refuse("true or false", "write one of the two");
      break;
    case ValueType::FloatArray:
    case ValueType::BoolArray:
    case ValueType::StringArray:
      if (v.type != type && text != "[]") {
        return refuse("an array", "write values of its kind as [1, 2, 3], rows as [1, 2; 3, 4]");
      }
      break;
    default: break;
  }
  return v;
}

// An error where the words that are allowed are all there are, a warning else: as forms offer them.
std::optional<Diagnostics::Entry> outsideOf(const AttributeCode& a, const Value& v,
                                            const ValuePool& pool) {
  const auto written = [&](const Value& x) {
    return x.type == ValueType::String ? std::string(pool.text(x.id)) : shortestText(x.number);
  };
  const auto entry = [&](Severity severity, std::string what, std::string hint) {
    Diagnostics::Entry e;
    e.severity = severity;
    e.code = severity == Severity::Error ? "attribute-value" : "attribute-outside";
    e.message = "'" + a.name + "' is " + what + ", not " + written(v);
    e.hint = std::move(hint);
    return e;
  };
  if (v.isArray() && v.type != ValueType::BoolArray) {
    // Annotations of an array are about its elements.
    const Array& list = pool.array(v);
    for (size_t i = 0; i < list.size(); ++i) {
      work();
      const bool isText = list.element == ValueType::String;
      auto found =
          outsideOf(a, isText ? Value::string(list.strings[i]) : Value::of(list.numbers[i]), pool);
      if (found) return found;
    }
    return std::nullopt;
  }
  if (v.type != ValueType::String && v.type != ValueType::Float) return std::nullopt;
  for (const AnnotationInfo& note : a.annotations) {
    const auto named = [&](std::string_view key) {
      const auto at = std::find_if(note.arguments.begin(), note.arguments.end(),
                                   [&](const auto& x) { return x.key == key; });
      return at == note.arguments.end() ? Value{} : at->value;
    };
    if (const Value r = named("restricted"); r.type == ValueType::Bool && !r.truth()) continue;
    if (note.name == "Range" && v.type == ValueType::Float) {
      const Value least = named("min"), most = named("max");
      if (!(least.number < most.number)) continue;
      if (v.number >= least.number && v.number <= most.number) continue;
      return entry(Severity::Warning, "meant to be from " + written(least) + " to " + written(most),
                   "the rules take it as it is; what they make of it may be of no use");
    }
    if (note.name == "Color" && v.type == ValueType::String && !pool.text(v.id).empty()) {
      Vec3 rgb;
      double opacity = 1;
      if (parseColor(pool.text(v.id), rgb, opacity)) continue;
      return entry(Severity::Warning, "meant to be a colour",
                   "write \"#rrggbb\" or \"#rrggbboo\"; the rules take it as it is");
    }
    if (note.name != "Enum" || named("valuesAttr").type == ValueType::String) continue;
    std::string allowed;
    std::vector<std::string> words;
    for (const AnnotationInfo::Argument& x : note.arguments) {
      if (x.key.empty() && x.value.type == v.type) words.push_back(written(x.value));
    }
    if (words.empty() || std::find(words.begin(), words.end(), written(v)) != words.end()) continue;
    for (const std::string& w : words) allowed += (allowed.empty() ? "" : ", ") + w;
    const std::vector<std::string_view> views(words.begin(), words.end());
    const std::string near = didYouMean(written(v), views);
    return entry(v.type == ValueType::String ? Severity::Error : Severity::Warning,
                 "one of: " + allowed, near);
  }
  return std::nullopt;
}

Value valueOfAttribute(const AttributeValue& a, ValuePool& pool) {
  const auto single = [&](const PlainValue& v) {
    switch (v.kind) {
      case PlainValue::Kind::Number: return Value::of(v.number);
      case PlainValue::Kind::Bool: return Value::of(v.number != 0);
      default: return pool.string(v.text);
    }
  };
  if (a.rows == 0) return a.values.empty() ? Value{} : single(a.values[0]);
  Array out;
  out.rows = a.rows;
  out.columns = a.columns;
  if (!a.values.empty()) out.element = single(a.values[0]).type;
  for (const PlainValue& v : a.values) append(out, single(v));
  return pool.intern(std::move(out));
}

}  // namespace gable
