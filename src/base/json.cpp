// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Reading drives the event interface of nlohmann-json, whose parser keeps its own stack, so depth
// costs no C++ recursion; the tree is built and bounded here. Its destructor recurses, which is why
// the depth limit is small.
#include "base/json.h"

#include <exception>
#include <nlohmann/json.hpp>

#include "base/number.h"
#include "base/work.h"

namespace gable {

const std::string& JsonValue::text() const {
  static const std::string kEmpty;
  return isText() ? std::get<std::string>(data_) : kEmpty;
}

const std::vector<JsonValue>& JsonValue::items() const {
  static const std::vector<JsonValue> kEmpty;
  return isArray() ? std::get<std::vector<JsonValue>>(data_) : kEmpty;
}

const std::vector<JsonValue::Member>& JsonValue::members() const {
  static const std::vector<Member> kEmpty;
  return isObject() ? std::get<std::vector<Member>>(data_) : kEmpty;
}

const JsonValue& JsonValue::at(size_t i) const {
  static const JsonValue kNull;
  return i < size() ? items()[i] : kNull;
}

const JsonValue* JsonValue::find(std::string_view name) const {
  const std::vector<Member>& all = members();
  work(all.size());
  for (auto m = all.rbegin(); m != all.rend(); ++m) {
    if (m->first == name) return &m->second;
  }
  return nullptr;
}

const JsonValue& JsonValue::operator[](std::string_view name) const {
  static const JsonValue kNull;
  const JsonValue* v = find(name);
  return v ? *v : kNull;
}

// The handler that nlohmann's parser calls. Each call returns false to stop.
struct JsonBuilder {
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  const JsonLimits& limits;
  JsonValue root;
  std::vector<JsonValue*> open;
  std::string pendingKey;
  uint64_t values = 0;
  Error error;

  // Puts a value into the open container; nullptr when there are too many.
  template <class T>
  JsonValue* place(T content) {
    work();
    if (++values > limits.values) {
      error = {"json-limit", "the JSON text has more values than allowed", {}};
      return nullptr;
    }
    JsonValue* v = &root;
    if (!open.empty()) {
      JsonValue& parent = *open.back();
      if (parent.isArray()) {
        v = &std::get<std::vector<JsonValue>>(parent.data_).emplace_back();
      } else {
        auto& members = std::get<std::vector<JsonValue::Member>>(parent.data_);
        v = &members.emplace_back(std::move(pendingKey), JsonValue{}).second;
        pendingKey.clear();
      }
    }
    v->data_ = std::move(content);
    return v;
  }
  template <class T>
  bool container() {
    if (open.size() >= limits.depth) {
      error = {"json-limit", "the JSON text is nested too deeply", {}};
      return false;
    }
    JsonValue* v = place(T{});
    if (v) open.push_back(v);
    return v != nullptr;
  }

  bool null() { return place(std::monostate{}) != nullptr; }
  bool boolean(bool b) { return place(b) != nullptr; }
  bool number_integer(number_integer_t n) { return place(static_cast<double>(n)) != nullptr; }
  bool number_unsigned(number_unsigned_t n) { return place(static_cast<double>(n)) != nullptr; }
  bool number_float(number_float_t n, const string_t&) { return place(n) != nullptr; }
  bool string(string_t& s) { return place(std::move(s)) != nullptr; }
  bool binary(binary_t&) { return false; }
  bool start_object(size_t) { return container<std::vector<JsonValue::Member>>(); }
  bool start_array(size_t) { return container<std::vector<JsonValue>>(); }
  bool key(string_t& k) {
    pendingKey = std::move(k);
    return true;
  }
  bool end() {
    open.pop_back();
    return true;
  }
  bool end_object() { return end(); }
  bool end_array() { return end(); }
  bool parse_error(size_t position, const std::string&, const nlohmann::detail::exception& e) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..." without its head.
    std::string what = e.what();
    const size_t head = what.find("] ");
    if (head != std::string::npos) what.erase(0, head + 2);
    if (what.size() > 300) what.resize(300);
    error = {"json-syntax", what + " (byte " + std::to_string(position) + ")", {}};
    return false;
  }
};

Result<JsonValue> parseJson(std::string_view text, const JsonLimits& limits) {
  JsonBuilder builder{limits, {}, {}, {}, 0, {}};
  try {
    if (nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) {
      return std::move(builder.root);
    }
  } catch (const std::exception& e) {
    return Error{"json-syntax", std::string("the JSON text cannot be read: ") + e.what(), {}};
  }
  if (builder.error.code.empty()) builder.error = {"json-syntax", "the text is not JSON", {}};
  return builder.error;
}

namespace {

// The length of the UTF-8 sequence at the head of s, 0 when it is none (Unicode 15, table 3-7).
size_t sequenceLength(std::string_view s) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(s[i]); };
  const auto follows = [&](size_t i) { return i < s.size() && (byte(i) & 0xc0) == 0x80; };
  const unsigned c = byte(0);
  if (c < 0x80) return 1;
  if (c >= 0xc2 && c < 0xe0) return follows(1) ? 2 : 0;
  if (c >= 0xe0 && c < 0xf0) {
    if (!follows(1) || !follows(2)) return 0;
    if ((c == 0xe0 && byte(1) < 0xa0) || (c == 0xed && byte(1) >= 0xa0)) return 0;
    return 3;
  }
  if (c >= 0xf0 && c < 0xf5) {
    if (!follows(1) || !follows(2) || !follows(3)) return 0;
    if ((c == 0xf0 && byte(1) < 0x90) || (c == 0xf4 && byte(1) >= 0x90)) return 0;
    return 4;
  }
  return 0;
}

}  // namespace

void JsonWriter::newLine() {
  if (indent_ <= 0) return;
  out_ += '\n';
  out_.append(static_cast<size_t>(indent_ * depth_), ' ');
}

void JsonWriter::separate() {
  if (afterKey_) {
    afterKey_ = false;
    return;
  }
  if (!first_) out_ += ',';
  if (depth_ > 0) newLine();
  first_ = false;
}

JsonWriter& JsonWriter::open(char c) {
  separate();
  out_ += c;
  ++depth_;
  first_ = true;
  return *this;
}

JsonWriter& JsonWriter::close(char c) {
  --depth_;
  if (!first_) newLine();
  out_ += c;
  first_ = false;
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  quote(name);
  out_ += indent_ > 0 ? ": " : ":";
  afterKey_ = true;
  return *this;
}

JsonWriter& JsonWriter::raw(std::string_view json) {
  separate();
  out_ += json;
  return *this;
}

JsonWriter& JsonWriter::value(double v) {
  if (!(v - v == 0)) return null();
  char text[kNumberRoom];
  return raw({text, static_cast<size_t>(writeShortest(text, v) - text)});
}

JsonWriter& JsonWriter::value(float v) {
  if (!(v - v == 0)) return null();
  char text[kNumberRoom];
  return raw({text, static_cast<size_t>(writeShortest(text, v) - text)});
}

JsonWriter& JsonWriter::value(bool v) { return raw(v ? "true" : "false"); }

JsonWriter& JsonWriter::value(uint64_t v) {
  char text[kNumberRoom];
  return raw({text, static_cast<size_t>(writeInteger(text, v) - text)});
}

JsonWriter& JsonWriter::integer(int64_t v) {
  char text[kNumberRoom];
  char* p = text;
  if (v < 0) *p++ = '-';
  p = writeInteger(p, v < 0 ? 0 - static_cast<uint64_t>(v) : static_cast<uint64_t>(v));
  return raw({text, static_cast<size_t>(p - text)});
}

JsonWriter& JsonWriter::value(std::string_view v) {
  separate();
  quote(v);
  return *this;
}

void JsonWriter::quote(std::string_view v) {
  static const char* const kHex = "0123456789abcdef";
  out_ += '"';
  for (size_t i = 0; i < v.size();) {
    const size_t n = sequenceLength(v.substr(i, 4));
    const auto c = static_cast<unsigned char>(v[i]);
    if (n == 0) {
      out_ += "\xef\xbf\xbd";
      ++i;
      continue;
    }
    if (c == '"' || c == '\\') {
      out_ += '\\';
      out_ += v[i];
    } else if (c == '\n') {
      out_ += "\\n";
    } else if (c == '\t') {
      out_ += "\\t";
    } else if (c < 0x20) {
      out_ += "\\u00";
      out_ += kHex[c >> 4];
      out_ += kHex[c & 15];
    } else {
      out_.append(v, i, n);
    }
    i += n;
  }
  out_ += '"';
}

}  // namespace gable
