// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// JSON: a tree of values for reading and a streaming writer. Reading never throws and is bounded in
// depth and size; writing gives the same bytes everywhere.
//
//   Result<JsonValue> tree = parseJson(text);
//   double x = tree->find("bbox")->at(0).number(0);
//
//   std::string out;
//   JsonWriter w(out);
//   w.beginObject().key("n").value(3).endObject();      // {"n":3}
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/result.h"

namespace gable {

class JsonValue {
 public:
  /// In the order of the alternatives of data_.
  enum class Kind : uint8_t { Null, Bool, Number, Text, Array, Object };
  using Member = std::pair<std::string, JsonValue>;

  Kind kind() const { return static_cast<Kind>(data_.index()); }
  bool isNull() const { return kind() == Kind::Null; }
  bool isBool() const { return kind() == Kind::Bool; }
  bool isNumber() const { return kind() == Kind::Number; }
  bool isText() const { return kind() == Kind::Text; }
  bool isArray() const { return kind() == Kind::Array; }
  bool isObject() const { return kind() == Kind::Object; }

  /// The value, or the fallback when it is of another kind.
  bool boolean(bool fallback) const { return isBool() ? std::get<bool>(data_) : fallback; }
  double number(double fallback) const { return isNumber() ? std::get<double>(data_) : fallback; }
  /// Empty when it is no text.
  const std::string& text() const;

  /// Elements of an array; empty for other kinds.
  const std::vector<JsonValue>& items() const;
  size_t size() const { return items().size(); }
  /// A shared null where there is no such element.
  const JsonValue& at(size_t i) const;

  /// Members of an object in the order of the text; empty for other kinds.
  const std::vector<Member>& members() const;
  /// The last member of that name, or nullptr. Linear in the members.
  const JsonValue* find(std::string_view name) const;
  /// As find, with a shared null where there is none.
  const JsonValue& operator[](std::string_view name) const;

 private:
  friend struct JsonBuilder;
  std::variant<std::monostate, bool, double, std::string, std::vector<JsonValue>,
               std::vector<Member>>
      data_;
};

struct JsonLimits {
  uint32_t depth = 200;
  uint64_t values = 20'000'000;
};

/// Codes: json-syntax (the message names line and column), json-limit.
Result<JsonValue> parseJson(std::string_view text, const JsonLimits& limits = {});

/// Appends JSON to a string. The caller keeps the order right: a key before each value of an
/// object. Numbers are the shortest text that reads back equal; NaN and the infinities become null.
/// Text that is not UTF-8 has its wrong bytes replaced by U+FFFD.
class JsonWriter {
 public:
  /// With `indent` above 0, one element a line.
  explicit JsonWriter(std::string& out, int indent = 0) : out_(out), indent_(indent) {}

  JsonWriter& beginObject() { return open('{'); }
  JsonWriter& endObject() { return close('}'); }
  JsonWriter& beginArray() { return open('['); }
  JsonWriter& endArray() { return close(']'); }
  JsonWriter& key(std::string_view name);

  JsonWriter& value(double v);
  JsonWriter& value(float v);
  JsonWriter& value(bool v);
  JsonWriter& value(int v) { return integer(v); }
  JsonWriter& value(int64_t v) { return integer(v); }
  JsonWriter& value(uint32_t v) { return integer(static_cast<int64_t>(v)); }
  JsonWriter& value(uint64_t v);
  JsonWriter& value(std::string_view v);
  JsonWriter& value(const char* v) { return value(std::string_view(v)); }
  JsonWriter& null() { return raw("null"); }
  /// Text that is JSON already.
  JsonWriter& raw(std::string_view json);

  template <class T>
  JsonWriter& field(std::string_view name, const T& v) {
    return key(name).value(v);
  }

 private:
  JsonWriter& open(char c);
  JsonWriter& close(char c);
  JsonWriter& integer(int64_t v);
  void separate();
  void newLine();
  void quote(std::string_view v);

  std::string& out_;
  int indent_ = 0;
  int depth_ = 0;
  bool first_ = true;
  bool afterKey_ = false;
};

}  // namespace gable
