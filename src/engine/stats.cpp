// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The JSON of --stats and of traces, in the form that the command line promises.

#include <algorithm>
#include <map>

#include "base/json.h"
#include "engine/impl.h"

namespace gable {

namespace {

void writeVec(JsonWriter& json, const Vec3& v) {
  json.beginArray().value(v.x).value(v.y).value(v.z).endArray();
}

struct ReportTotal {
  uint64_t n = 0;
  double sum = 0, min = 0, max = 0;
  bool numbers = true;
  std::map<std::string, uint64_t> values;
};

std::map<std::string, ReportTotal> totals(const Scene& scene) {
  std::map<std::string, ReportTotal> out;
  for (const Report& r : scene.reports) {
    ReportTotal& t = out[r.key];
    ++t.n;
    if (r.value.kind == PlainValue::Kind::Number) {
      const double v = r.value.number;
      t.min = t.n == 1 ? v : std::min(t.min, v);
      t.max = t.n == 1 ? v : std::max(t.max, v);
      t.sum += v;
      continue;
    }
    t.numbers = false;
    const bool isBool = r.value.kind == PlainValue::Kind::Bool;
    ++t.values[isBool ? (r.value.number != 0 ? "true" : "false") : r.value.text];
  }
  return out;
}

void writeReports(JsonWriter& json, const Scene& scene) {
  json.key("reports").beginObject();
  for (const auto& [key, t] : totals(scene)) {
    json.key(key).beginObject().key("n").value(t.n);
    if (t.numbers) {
      json.key("sum").value(t.sum).key("avg").value(t.sum / static_cast<double>(t.n));
      json.key("min").value(t.min).key("max").value(t.max);
    } else {
      json.key("values").beginObject();
      for (const auto& [value, n] : t.values) json.key(value).value(n);
      json.endObject();
    }
    json.endObject();
  }
  json.endObject();
}

void writeTimes(JsonWriter& json, const Model::Times& times) {
  json.key("seconds").beginObject();
  const std::pair<const char*, double> parts[] = {{"parse", times.parse},
                                                  {"derive", times.derive},
                                                  {"write", times.write},
                                                  {"total", times.total}};
  for (const auto& [name, seconds] : parts) {
    if (seconds >= 0) json.key(name).value(seconds);
  }
  json.endObject();
  if (times.peakBytes >= 0) json.key("peakBytes").value(static_cast<int64_t>(times.peakBytes));
}

}  // namespace

std::string statsOf(const DeriveResult& result, const Scene& scene, const Messages& messages,
                    const Model::Times& times) {
  const SceneCounts c = count(scene);
  std::string out;
  JsonWriter json(out, 1);
  json.beginObject();
  json.key("shapes").value(c.shapes).key("leaves").value(c.leaves).key("faces").value(c.faces);
  json.key("vertices").value(c.vertices);
  json.key("triangles").value(times.triangles > 0 ? times.triangles : c.triangles);
  json.key("instances").value(c.instances).key("prototypes").value(c.prototypes);
  json.key("materials").value(c.materials);
  if (result.recalled > 0) json.key("recalled").value(result.recalled);
  json.key("bbox").beginObject().key("min");
  const Vec3 none;
  writeVec(json, c.bounds.empty() ? none : c.bounds.min);
  json.key("max");
  writeVec(json, c.bounds.empty() ? none : c.bounds.max);
  json.endObject();
  writeReports(json, scene);
  json.key("prints").beginArray();
  for (const std::string& p : scene.prints) json.value(p);
  json.endArray();
  json.key("diagnostics").raw(messagesJson(messages));
  writeTimes(json, times);
  json.endObject();
  return out + "\n";
}

std::string traceOf(const DeriveResult& result, const Program& program, const Sources& sources) {
  const std::vector<TraceNode>& nodes = result.trace;
  std::vector<std::vector<uint32_t>> children(nodes.size());
  std::vector<uint32_t> roots;
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent == TraceNode::kNone)
      roots.push_back(i);
    else
      children[nodes[i].parent].push_back(i);
  }
  std::string out;
  JsonWriter json(out);
  const auto open = [&](const TraceNode& n) {
    json.beginObject().key("shape").value(program.pool->text(n.name));
    if (n.span.valid()) {
      const LineColumn at = sources.locate(n.span.file, n.span.begin);
      json.key("source").beginObject().key("file").value(sources.path(n.span.file));
      json.key("line").value(at.line).key("column").value(at.column).endObject();
    }
    json.key("scope").beginObject().key("origin");
    writeVec(json, n.scope.origin);
    json.key("x");
    writeVec(json, n.scope.x);
    json.key("y");
    writeVec(json, n.scope.y);
    json.key("z");
    writeVec(json, n.scope.z);
    json.key("size");
    writeVec(json, n.size);
    json.endObject();
    if (n.leaf) json.key("leaf").value(true);
    if (n.dropped) json.key("dropped").value(true);
    json.key("children").beginArray();
  };
  // Depth first on a stack of (node, next child): trees are as deep as rules recurse.
  json.beginArray();
  for (uint32_t root : roots) {
    std::vector<std::pair<uint32_t, size_t>> stack{{root, 0}};
    open(nodes[root]);
    while (!stack.empty()) {
      auto& [node, next] = stack.back();
      if (next < children[node].size()) {
        const uint32_t child = children[node][next++];
        open(nodes[child]);
        stack.emplace_back(child, 0);
      } else {
        json.endArray().endObject();
        stack.pop_back();
      }
    }
  }
  json.endArray();
  return out + "\n";
}

}  // namespace gable
