// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/importers/geojson_edges.h"

#include "base/work.h"
#include "shape/edge_attributes.h"

namespace gable {

PlainValue plainValue(const JsonValue& v) {
  if (v.isNumber()) return {PlainValue::Kind::Number, v.number(0), {}};
  if (v.isBool()) return {PlainValue::Kind::Bool, v.boolean(false) ? 1.0 : 0.0, {}};
  return {PlainValue::Kind::Text, 0, v.text()};
}

bool isPlainValue(const JsonValue& v) { return v.isNumber() || v.isBool() || v.isText(); }

void WrittenEdges::begin(const JsonValue* properties) {
  *this = {};
  if (!properties) return;
  for (const JsonValue::Member& m : properties->members()) {
    wanted_ = wanted_ || EdgeAttributes::isNamed(m.first, m.second.isArray());
  }
}

std::vector<Vec2> WrittenEdges::ring(const std::vector<Vec2>& points, double tolerance) {
  const auto same = [&](Vec2 a, Vec2 b) { return length(a - b) <= tolerance; };
  const bool closed = points.size() > 1 && same(points.front(), points.back());
  const size_t count = closed ? points.size() - 1 : points.size();
  std::vector<Vec2> out;
  std::vector<size_t> numbers;
  for (size_t i = 0; i < count; ++i) {
    work();
    if (!out.empty() && same(out.back(), points[i])) {
      numbers.back() = written_ + i;
      continue;
    }
    out.push_back(points[i]);
    numbers.push_back(written_ + i);
  }
  while (out.size() > 1 && same(out.back(), out.front())) {
    out.pop_back();
    numbers.pop_back();
  }
  written_ += count;
  for (size_t i = 0; i < out.size(); ++i) {
    corners_[{out[i].x, out[i].y}] = {out[(i + 1) % out.size()], numbers[i]};
  }
  return out;
}

void WrittenEdges::add(Vec2 from, Vec2 to) {
  edges_.push_back(-1);
  for (const auto& [a, b] : {std::pair{from, to}, std::pair{to, from}}) {
    const auto at = corners_.find({a.x, a.y});
    if (at == corners_.end() || !(at->second.next == b)) continue;
    edges_.back() = static_cast<int64_t>(at->second.edge);
    return;
  }
}

AttributeValue WrittenEdges::values(const std::string& name, const JsonValue& list,
                                    size_t more) const {
  AttributeValue out;
  out.name = name;
  const JsonValue* first = nullptr;
  for (const JsonValue& v : list.items()) {
    work();
    if (v.isNull()) continue;
    if (!first) first = &v;
    if (!isPlainValue(v) || v.kind() != first->kind()) return out;
  }
  if (!first) return out;
  PlainValue none = plainValue(*first);
  none.number = 0;
  none.text.clear();
  for (const int64_t edge : edges_) {
    work();
    const bool known = edge >= 0 && static_cast<size_t>(edge) < list.size() &&
                       !list.at(static_cast<size_t>(edge)).isNull();
    out.values.push_back(known ? plainValue(list.at(static_cast<size_t>(edge))) : none);
  }
  out.values.resize(out.values.size() + more, none);
  out.rows = 1;
  out.columns = static_cast<uint32_t>(out.values.size());
  return out;
}

}  // namespace gable
