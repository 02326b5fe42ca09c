// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "finite_files.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "base/json.h"

namespace gable {

namespace {

uint32_t wordAt(std::string_view file, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, file.data() + at, 4);
  return word;
}

/// The first number of the tree that single precision cannot hold, as a path to it.
std::string faultOfTree(const JsonValue& value, const std::string& path) {
  if (value.isNumber() && !(std::fabs(value.number(0)) <= double{FLT_MAX})) return path;
  size_t index = 0;
  for (const JsonValue& item : value.items()) {
    const std::string fault = faultOfTree(item, path + "/" + std::to_string(index++));
    if (!fault.empty()) return fault;
  }
  for (const auto& [name, member] : value.members()) {
    const std::string fault = faultOfTree(member, path + "/" + name);
    if (!fault.empty()) return fault;
  }
  return {};
}

size_t componentsOf(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 16;
}

std::string faultOfAccessor(const JsonValue& accessor, const JsonValue& views,
                            std::string_view binary) {
  constexpr double kFloat = 5126;
  if (accessor["componentType"].number(0) != kFloat) return {};
  const JsonValue& view = views.at(static_cast<size_t>(accessor["bufferView"].number(0)));
  const size_t components = componentsOf(accessor["type"].text());
  size_t stride = static_cast<size_t>(view["byteStride"].number(0));
  if (stride == 0) stride = components * 4;
  const auto begin =
      static_cast<size_t>(view["byteOffset"].number(0) + accessor["byteOffset"].number(0));
  const auto count = static_cast<size_t>(accessor["count"].number(0));
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < components; ++k) {
      const size_t at = begin + i * stride + k * 4;
      if (at + 4 > binary.size()) return "ends beyond the file";
      float v = 0;
      std::memcpy(&v, binary.data() + at, 4);
      if (!std::isfinite(v)) return "is not finite at " + std::to_string(i);
    }
  }
  return {};
}

}  // namespace

std::string faultOfGlb(std::string_view file) {
  if (file.empty()) return {};
  constexpr size_t kHead = 20;
  if (file.size() < kHead || wordAt(file, 12) > file.size() - kHead) return "has no head";
  const size_t length = wordAt(file, 12);
  Result<JsonValue> tree = parseJson(file.substr(kHead, length));
  if (!tree.ok()) return tree.error().message;
  std::string fault = faultOfTree(*tree, "");
  if (!fault.empty()) return "number at " + fault;
  const size_t binary = kHead + length + 8;
  const std::string_view bytes = binary < file.size() ? file.substr(binary) : std::string_view();
  size_t index = 0;
  for (const JsonValue& accessor : (*tree)["accessors"].items()) {
    fault = faultOfAccessor(accessor, (*tree)["bufferViews"], bytes);
    if (!fault.empty()) return "accessor " + std::to_string(index) + " " + fault;
    ++index;
  }
  return {};
}

std::string faultOfText(std::string_view file) {
  size_t begin = 0;
  while (begin < file.size()) {
    const size_t end = std::min(file.find('\n', begin), file.size());
    const std::string_view line = file.substr(begin, end - begin);
    begin = end + 1;
    // Only lines of numbers: names may well hold "inf".
    if (!line.starts_with("v")) continue;
    if (line.find("nan") != line.npos || line.find("inf") != line.npos) return std::string(line);
  }
  return {};
}

std::string faultOfPly(std::string_view file) {
  if (file.empty()) return {};
  const size_t end = file.find("end_header\n");
  const size_t element = file.find("element vertex ");
  if (end == file.npos || element > end) return "has no head";
  unsigned long long count = 0;
  std::sscanf(std::string(file.substr(element, 60)).c_str(), "element vertex %llu", &count);
  const std::string_view head = file.substr(0, end);
  const bool wide = head.find("property double x") != head.npos;
  const size_t width = wide ? 8 : 4, stride = 3 * width + 4, begin = end + 11;
  if (begin + count * stride > file.size()) return "is shorter than its head says";
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      double v = 0;
      float f = 0;
      std::memcpy(wide ? static_cast<void*>(&v) : &f, file.data() + begin + i * stride + k * width,
                  width);
      if (!std::isfinite(wide ? v : double{f})) return "vertex " + std::to_string(i);
    }
  }
  return {};
}

}  // namespace gable
