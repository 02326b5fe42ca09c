// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The tables of a pool are split into shards, each with its own lock; an id is shard plus index,
// and contents lie in blocks that never move, so that readers need no lock.

#include "program/value.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include "base/interned.h"

namespace gable {

ValueType elementType(ValueType array) {
  switch (array) {
    case ValueType::FloatArray: return ValueType::Float;
    case ValueType::BoolArray: return ValueType::Bool;
    case ValueType::StringArray: return ValueType::String;
    default: return array;
  }
}

ValueType arrayType(ValueType element) {
  switch (element) {
    case ValueType::Float: return ValueType::FloatArray;
    case ValueType::Bool: return ValueType::BoolArray;
    case ValueType::String: return ValueType::StringArray;
    default: return element;
  }
}

const char* typeName(ValueType t) {
  switch (t) {
    case ValueType::Null: return "nothing";
    case ValueType::Float: return "float";
    case ValueType::Bool: return "bool";
    case ValueType::String: return "string";
    case ValueType::Selector: return "selector";
    case ValueType::FloatArray: return "float[]";
    case ValueType::BoolArray: return "bool[]";
    case ValueType::StringArray: return "string[]";
    case ValueType::Code: return "selection";
  }
  return "?";
}

namespace {

uint64_t contentHash(std::string_view s) { return hashBytes(s); }
uint64_t contentHash(const Array& a) {
  uint64_t h = hashCombine(static_cast<uint64_t>(a.element), (uint64_t{a.rows} << 32) | a.columns);
  for (double v : a.numbers) h = hashCombine(h, hashDouble(v));
  for (StringId s : a.strings) h = hashCombine(h, s);
  return h;
}

bool isSame(std::string_view a, std::string_view b) { return a == b; }
// To the bit: not a number is no new value each time, and -0 is another than 0.
bool isSame(const Array& a, const Array& b) {
  const auto sameBits = [](double x, double y) {
    return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y);
  };
  return a.element == b.element && a.rows == b.rows && a.columns == b.columns &&
         a.strings == b.strings && std::ranges::equal(a.numbers, b.numbers, sameBits);
}

}  // namespace

template <class T>
class ValuePool::Table {
 public:
  template <class Key>
  uint32_t intern(Key&& key) {
    const uint64_t hash = contentHash(key);
    Shard& shard = shards_[hash % kShards];
    std::lock_guard lock(shard.mutex);
    auto [first, last] = shard.index.equal_range(hash);
    for (; first != last; ++first) {
      if (isSame(shard.at(first->second), key)) return id(hash % kShards, first->second);
    }
    if (shard.count >= capacity_) tableIsFull();
    const uint32_t index = shard.count++;
    const uint32_t block = index / kBlock;
    if (!shard.blocks[block]) shard.blocks[block] = std::make_unique<std::array<T, kBlock>>();
    (*shard.blocks[block])[index % kBlock] = T(std::forward<Key>(key));
    shard.index.emplace(hash, index);
    return id(hash % kShards, index);
  }

  const T& get(uint32_t id) const { return shards_[id % kShards].at(id / kShards); }

 private:
  static constexpr uint32_t kShards = 16, kBlock = 1024, kBlocks = 1u << 12;
  struct Shard {
    mutable std::mutex mutex;
    uint32_t count = 0;
    std::unordered_multimap<uint64_t, uint32_t> index;
    std::vector<std::unique_ptr<std::array<T, kBlock>>> blocks{kBlocks};
    const T& at(uint32_t i) const { return (*blocks[i / kBlock])[i % kBlock]; }
  };
  static uint32_t id(uint64_t shard, uint32_t index) {
    return index * kShards + static_cast<uint32_t>(shard);
  }
  std::array<Shard, kShards> shards_;
  /// Of each shard.
  const uint32_t capacity_ = std::min(kBlock * kBlocks, TableCapacityScope::most());
};

namespace {
constexpr StringId kEmptyText = 0;
}

ValuePool::ValuePool()
    : strings_(std::make_unique<Table<std::string>>()), arrays_(std::make_unique<Table<Array>>()) {}
ValuePool::~ValuePool() = default;

// The empty string is id 0 without being stored; every other id is the table's plus one.
StringId ValuePool::intern(std::string_view text) {
  return text.empty() ? kEmptyText : strings_->intern(text) + 1;
}

std::string_view ValuePool::text(StringId id) const {
  return id == kEmptyText ? std::string_view() : std::string_view(strings_->get(id - 1));
}

Value ValuePool::intern(Array a) {
  const ValueType type = arrayType(a.element);
  return Value::array(type, arrays_->intern(std::move(a)));
}

const Array& ValuePool::array(const Value& v) const { return arrays_->get(v.id); }

std::string numberText(double v) {
  if (std::isnan(v)) return "nan";
  if (std::isinf(v)) return v > 0 ? "inf" : "-inf";
  if (v == 0) return "0";
  // The fewest digits that give the number back, up to sixteen: 9.3 has two, what the original
  // shows of 0.1 as a float is 0.1000000014901161, and 0.1 + 0.2 looks as an author expects.
  char text[40];
  const double size = std::fabs(v);
  const bool plain = size >= 1e-4 && size < 1e16;
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  const char* end = std::to_chars(text, text + sizeof text, v, format).ptr;
  const char* const exponent = std::find<const char*>(text, end, 'e');
  const char* const first =
      std::find_if<const char*>(text, exponent, [](char c) { return c >= '1' && c <= '9'; });
  if (std::count_if(first, exponent, [](char c) { return c != '.'; }) > 16) {
    end = std::to_chars(text, text + sizeof text, v, std::chars_format::general, 16).ptr;
  }
  return {static_cast<const char*>(text), end};
}

namespace {

std::string elementText(const Array& a, size_t i, const ValuePool& pool) {
  if (a.element == ValueType::String) return std::string(pool.text(a.strings[i]));
  if (a.element == ValueType::Bool) return a.numbers[i] != 0 ? "true" : "false";
  return numberText(a.numbers[i]);
}

std::string rowText(const Array& a, const ValuePool& pool) {
  std::string out = "(" + std::to_string(a.columns) + ")[";
  for (size_t i = 0; i < a.size() && out.size() <= kMaxTextLength; ++i) {
    if (i > 0) out += ',';
    out += elementText(a, i, pool);
  }
  return out + "]";
}

// A line for each row; columns are flush right and three blanks apart.
std::string tableText(const Array& a, const ValuePool& pool) {
  std::vector<std::string> cells;
  std::vector<size_t> widths(a.columns, 0);
  size_t length = 0;
  for (size_t i = 0; i < a.size() && length <= kMaxTextLength; ++i) {
    cells.push_back(elementText(a, i, pool));
    length += cells[i].size();
    widths[i % a.columns] = std::max(widths[i % a.columns], cells[i].size());
  }
  std::string out = "(" + std::to_string(a.rows) + "x" + std::to_string(a.columns) + ")";
  for (size_t i = 0; i < cells.size() && out.size() <= kMaxTextLength; ++i) {
    if (i % a.columns == 0) out += '\n';
    out.append(3 + widths[i % a.columns] - cells[i].size(), ' ').append(cells[i]);
  }
  return out;
}

}  // namespace

std::string ValuePool::str(const Value& v) const {
  switch (v.type) {
    case ValueType::Null: return "";
    case ValueType::Float: return numberText(v.number);
    case ValueType::Bool: return v.truth() ? "true" : "false";
    case ValueType::String:
    case ValueType::Selector: return std::string(text(v.id));
    default: break;
  }
  const Array& a = array(v);
  return a.rows > 1 ? tableText(a, *this) : rowText(a, *this);
}

}  // namespace gable
