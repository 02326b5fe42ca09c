// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Value: what an expression of a rule yields. Sixteen bytes, trivially copied: strings and arrays
// are interned in a ValuePool and carried as ids, so that equal contents have equal ids within a
// pool. Ids depend on the order of interning and never reach any output.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/hash.h"

namespace gable {

using StringId = uint32_t;

enum class ValueType : uint8_t {
  Null,
  Float,
  Bool,
  String,
  /// A word such as xy, world.up or scope; carried like a string.
  Selector,
  FloatArray,
  BoolArray,
  StringArray,
  /// An argument that the operation evaluates itself; see ArgumentCode in program/program.h.
  Code,
};

/// The prefix that a size was written with: none, ' (times the scope) or ~ (share of the rest).
enum class Unit : uint8_t { Absolute, Relative, Floating };

struct Value {
  ValueType type = ValueType::Null;
  Unit unit = Unit::Absolute;
  /// String, selector or array id.
  uint32_t id = 0;
  /// The number of a Float; 0 or 1 of a Bool.
  double number = 0;

  static Value of(double v) { return {ValueType::Float, Unit::Absolute, 0, v}; }
  static Value of(bool v) { return {ValueType::Bool, Unit::Absolute, 0, v ? 1.0 : 0.0}; }
  static Value string(StringId s) { return {ValueType::String, Unit::Absolute, s, 0}; }
  static Value selector(StringId s) { return {ValueType::Selector, Unit::Absolute, s, 0}; }
  static Value array(ValueType type, uint32_t id) { return {type, Unit::Absolute, id, 0}; }

  bool truth() const { return number != 0; }
  static Value code(uint32_t id) { return {ValueType::Code, Unit::Absolute, id, 0}; }

  bool isArray() const { return type >= ValueType::FloatArray && type <= ValueType::StringArray; }
  friend bool operator==(const Value& a, const Value& b) {
    return a.type == b.type && a.id == b.id && a.number == b.number;
  }
  uint64_t hash() const {
    return hashCombine(hashDouble(number),
                       static_cast<uint64_t>(type) << 40 | static_cast<uint64_t>(unit) << 32 | id);
  }
};
static_assert(sizeof(Value) == 16);

/// The element type of an array type, and back.
ValueType elementType(ValueType array);
ValueType arrayType(ValueType element);
const char* typeName(ValueType t);

/// Bytes that a text may have, and elements that an array may have. What would become longer is a
/// mistake of the rules, reported where it happens.
inline constexpr size_t kMaxTextLength = size_t{1} << 24;
inline constexpr size_t kMaxArraySize = 100000;

/// A rows x columns table, stored by rows; a plain list has one row.
struct Array {
  ValueType element = ValueType::Float;
  uint32_t rows = 0;
  uint32_t columns = 0;
  /// Floats and bools (0 or 1).
  std::vector<double> numbers;
  /// Strings.
  std::vector<StringId> strings;

  size_t size() const { return static_cast<size_t>(rows) * columns; }
  bool operator==(const Array&) const = default;
};

/// Interns strings and arrays. Any thread may call; text() and array() take no lock and stay valid
/// as long as the pool.
class ValuePool {
 public:
  ValuePool();
  ~ValuePool();
  ValuePool(const ValuePool&) = delete;
  ValuePool& operator=(const ValuePool&) = delete;

  /// Id 0 is the empty string.
  StringId intern(std::string_view text);
  std::string_view text(StringId id) const;
  Value string(std::string_view text) { return Value::string(intern(text)); }
  Value selector(std::string_view text) { return Value::selector(intern(text)); }

  Value intern(Array a);
  const Array& array(const Value& v) const;

  /// The value as str() prints it: numbers with up to sixteen significant digits,
  /// lists as (n)[a,b,c], tables as (rxc) and a line for each row, columns flush right. A text that
  /// would become longer than kMaxTextLength ends soon after it.
  std::string str(const Value& v) const;

 private:
  template <class T>
  class Table;
  std::unique_ptr<Table<std::string>> strings_;
  std::unique_ptr<Table<Array>> arrays_;
};

/// A number as CGA's str() and string + number show it.
std::string numberText(double v);

}  // namespace gable
