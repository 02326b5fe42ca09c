// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "base/number.h"
#include "json/answers.h"
#include "json/reports_json.h"

namespace gable {

namespace {

void writeTriple(JsonWriter& json, const Triple& v) {
  json.beginArray().value(v[0]).value(v[1]).value(v[2]).endArray();
}

// How many of the values are numbers.
uint64_t numberCount(const ReportSummary& r) {
  uint64_t others = 0;
  for (const auto& [value, count] : r.values) others += count;
  return r.count - others;
}

}  // namespace

void writeReports(JsonWriter& json, const std::vector<ReportSummary>& reports) {
  json.key("reports").beginObject();
  for (const ReportSummary& r : reports) {
    json.key(r.key).beginObject().key("n").value(r.count);
    if (r.numbers) {
      json.key("sum").value(r.numbers->sum);
      json.key("avg").value(r.numbers->sum / static_cast<double>(numberCount(r)));
      json.key("min").value(r.numbers->min).key("max").value(r.numbers->max);
    }
    if (!r.values.empty()) {
      json.key("values").beginObject();
      for (const auto& [value, n] : r.values) json.key(value).value(n);
      json.endObject();
    }
    json.endObject();
  }
  json.endObject();
}

namespace {

void writeFigures(JsonWriter& json, const RunFigures& f) {
  json.key("seconds").beginObject();
  const std::pair<const char*, std::optional<double>> parts[] = {{"parse", f.parseSeconds},
                                                                 {"derive", f.deriveSeconds},
                                                                 {"write", f.writeSeconds},
                                                                 {"total", f.totalSeconds}};
  for (const auto& [name, seconds] : parts) {
    if (seconds) json.key(name).value(*seconds);
  }
  json.endObject();
  if (f.peakBytes) json.key("peakBytes").value(*f.peakBytes);
  if (f.fileBytes) json.key("fileBytes").value(*f.fileBytes);
  if (f.savedBytes) json.key("savedBytes").value(*f.savedBytes);
  if (!f.atlas) return;
  json.key("atlas").beginObject().key("merged").value(f.atlas->merged);
  json.key("into").value(f.atlas->into).key("repeating").value(f.atlas->repeating);
  json.key("special").value(f.atlas->special).key("large").value(f.atlas->large).endObject();
}

void openNode(JsonWriter& json, const DerivationTrace& trace, const DerivationTrace::Node& n) {
  json.beginObject().key("shape").value(trace.names[n.name]);
  if (n.place) {
    json.key("source").beginObject().key("file").value(trace.files[n.place->file]);
    json.key("line").value(n.place->line).key("column").value(n.place->column).endObject();
  }
  json.key("scope").beginObject();
  const char* names[] = {"origin", "x", "y", "z"};
  for (size_t i = 0; i < 4; ++i) {
    json.key(names[i]);
    writeTriple(json, {n.frame[3 * i], n.frame[3 * i + 1], n.frame[3 * i + 2]});
  }
  json.key("size");
  writeTriple(json, n.size);
  json.endObject();
  if (n.leaf) json.key("leaf").value(true);
  if (n.dropped) json.key("dropped").value(true);
  json.key("children").beginArray();
}

}  // namespace

namespace {

void writeStatistics(JsonWriter& json, const Model& model, const RunFigures& figures) {
  const Statistics s = model.statistics();
  json.key("shapes").value(s.shapes).key("leaves").value(s.leaves).key("faces").value(s.faces);
  json.key("vertices").value(s.vertices);
  json.key("triangles").value(figures.triangles.value_or(s.triangles));
  json.key("instances").value(s.instances).key("prototypes").value(s.prototypes);
  json.key("materials").value(s.materials);
  json.key("encoder").beginObject().key("faces").value(s.encoder.faces);
  json.key("vertices").value(s.encoder.vertices).endObject();
  if (s.recalled > 0) json.key("recalled").value(s.recalled);
  const BoundingBox box = s.bounds.value_or(BoundingBox{});
  json.key("bbox").beginObject().key("min");
  writeTriple(json, box.min);
  json.key("max");
  writeTriple(json, box.max);
  json.endObject();
  writeReports(json, s.reports);
  if (!s.rooms.empty()) {
    json.key("room").beginObject();
    for (const Statistics::Room& r : s.rooms) {
      json.key(r.group).beginObject().key("kept").value(r.kept);
      json.key("dropped").value(r.dropped).endObject();
    }
    json.endObject();
  }
  json.key("prints").beginArray();
  for (const std::string& p : model.prints()) json.value(p);
  json.endArray();
  writeFigures(json, figures);
}

}  // namespace

std::string statisticsMembers(const Model& model, const RunFigures& figures) {
  std::string out;
  JsonWriter json(out, 1);
  json.beginObject();
  writeStatistics(json, model, figures);
  json.endObject();
  return out;
}

std::string statisticsJson(const Model& model, const RunFigures& figures) {
  std::string out;
  JsonWriter json(out, 1);
  json.beginObject();
  writeStatistics(json, model, figures);
  DiagnosticList all = figures.before;
  for (const DiagnosticList& more : {model.diagnostics(), figures.after}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  json.key("diagnostics").raw(diagnosticsJson(all));
  json.endObject();
  return out + "\n";
}

void writeTrace(const DerivationTrace& trace, const TextSink& sink) {
  constexpr uint32_t kNone = 0xffffffff;
  // Each node's first child, and the next child of its parent or the next root.
  std::vector<uint32_t> first(trace.nodes.size(), kNone), next(trace.nodes.size(), kNone);
  uint32_t root = kNone;
  for (auto i = static_cast<uint32_t>(trace.nodes.size()); i-- > 0;) {
    const std::optional<uint32_t> parent = trace.nodes[i].parent;
    next[i] = std::exchange(parent ? first[*parent] : root, i);
  }
  constexpr size_t kAtOnce = size_t{1} << 16;
  std::string out;
  JsonWriter json(out);
  const auto enter = [&](uint32_t node) {
    if (out.size() >= kAtOnce) {
      sink(out);
      out.clear();
    }
    openNode(json, trace, trace.nodes[node]);
  };
  // Depth first on a stack of next children: trees are as deep as rules recurse.
  json.beginArray();
  for (; root != kNone; root = next[root]) {
    std::vector<uint32_t> children{first[root]};
    enter(root);
    while (!children.empty()) {
      const uint32_t child = children.back();
      if (child != kNone) {
        children.back() = next[child];
        enter(child);
        children.push_back(first[child]);
      } else {
        json.endArray().endObject();
        children.pop_back();
      }
    }
  }
  json.endArray();
  sink(out + "\n");
}

namespace {

// A text with commas, quotes or breaks stands in quotes.
std::string csvText(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

// To six places: what sums have beyond is rounding. Small numbers keep theirs.
std::string csvNumber(double v) {
  constexpr double kSmall = 1e-3;
  constexpr int kPlaces = 6;
  if (std::fabs(v) < kSmall) return shortestText(v);
  char text[kNumberRoom];
  return std::string(text, writeFixed(text, v, kPlaces));
}

constexpr const char* kReportColumns = "key,value,count,sum,average,minimum,maximum\n";

void addLines(const std::string& begin, const std::vector<ReportSummary>& reports,
              std::string& out) {
  for (const ReportSummary& r : reports) {
    const std::string key = begin + csvText(r.key);
    for (const auto& [value, count] : r.values) {
      out += key + "," + csvText(value) + "," + std::to_string(count) + ",,,,\n";
    }
    if (!r.numbers) continue;
    const uint64_t count = numberCount(r);
    out += key + ",," + std::to_string(count);
    const double average = r.numbers->sum / static_cast<double>(count);
    for (const double x : {r.numbers->sum, average, r.numbers->min, r.numbers->max}) {
      out += "," + csvNumber(x);
    }
    out += "\n";
  }
}

}  // namespace

std::string reportsCsv(const std::vector<ReportSummary>& reports) {
  std::string out = kReportColumns;
  addLines({}, reports, out);
  return out;
}

std::string reportsCsv(const std::vector<ShapeReports>& shapes) {
  std::string out = std::string("shape,id,") + kReportColumns;
  for (const ShapeReports& s : shapes) {
    addLines(csvText(s.name) + "," + csvText(s.id) + ",", s.reports, out);
  }
  return out;
}

namespace {

// The sum of numbers; of texts all there are.
std::string cellOf(const ReportSummary& r) {
  if (r.numbers) return csvNumber(r.numbers->sum);
  std::string out;
  for (const auto& [value, count] : r.values) out += (out.empty() ? "" : "; ") + value;
  return csvText(out);
}

}  // namespace

std::string reportsTable(const std::vector<ShapeReports>& shapes) {
  std::set<std::string_view> keys;
  for (const ShapeReports& s : shapes) {
    for (const ReportSummary& r : s.reports) keys.insert(r.key);
  }
  std::string out = "shape,id";
  for (const std::string_view key : keys) out += "," + csvText(std::string(key));
  out += "\n";
  for (const ShapeReports& s : shapes) {
    if (s.reports.empty()) continue;
    out += csvText(s.name) + "," + csvText(s.id);
    // Both are sorted by key.
    auto report = s.reports.begin();
    for (const std::string_view key : keys) {
      out += ",";
      if (report != s.reports.end() && report->key == key) out += cellOf(*report++);
    }
    out += "\n";
  }
  return out;
}

}  // namespace gable
