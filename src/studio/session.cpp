// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/session.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/files.h"
#include "base/parallel.h"
#include "json/answers.h"

namespace gable::studio {

struct Session::Work {
  Cancel cancel;
  std::atomic<size_t> done{0}, total{0};
};

namespace {

constexpr size_t kRulesKept = 4, kShapesKept = 4, kModelsKept = 4, kModelsOfAll = 16,
                 kPagesKept = 64;
/// Of all models together, unless one alone has more. A town has one and a half million, and takes
/// half a gigabyte.
constexpr uint64_t kLeavesKept = 4'000'000;
/// Of answers that have been sent: that of a town has 200 MB, and one for a key there 50.
constexpr size_t kMostRoom = 256 << 20;
constexpr double kMostSeconds = 600, kUsualSeconds = 20;
/// Of reading and analysing files, which nobody waits for longer.
const FileLimits kFileLimits{20.0, uint64_t{2} << 30};
constexpr double kMostShapes = 50e6, kUsualShapes = 5e6;
constexpr uint64_t kTreeShapes = 400'000;
/// A person looks at each step, and each has geometry of its own.
constexpr uint64_t kStepShapes = 60'000;

template <class Kept>
void keep(std::deque<Kept>& kept, Kept one, size_t most) {
  kept.push_front(std::move(one));
  if (kept.size() > most) kept.pop_back();
}

std::string headOf(const char* mark, std::string json) {
  json.append((4 - json.size() % 4) % 4, ' ');
  const auto size = static_cast<uint32_t>(json.size());
  std::string head = mark;
  head.append(reinterpret_cast<const char*>(&size), sizeof size);
  return head + json;
}

DeriveSettings settingsOf(const JsonValue& request) {
  DeriveSettings s;
  if (!request["start"].text().empty()) s.startRule = request["start"].text();
  s.seed = request["seed"].number(0);
  for (const auto& [name, value] : request["attributes"].members()) {
    s.attributes.emplace_back(name, value.text());
  }
  for (const auto& [index, seed] : request["seeds"].members()) {
    s.shapeSeeds.emplace_back(std::strtoull(index.c_str(), nullptr, 10), seed.number(0));
  }
  const JsonValue& limits = request["limits"];
  s.limits.seconds = std::clamp(limits["seconds"].number(kUsualSeconds), 0.01, kMostSeconds);
  s.limits.shapes =
      static_cast<uint64_t>(std::clamp(limits["shapes"].number(kUsualShapes), 1.0, kMostShapes));
  s.limits.vertices = 50'000'000;
  return s;
}

const char* endName(End end) {
  switch (end) {
    case End::Done: return "done";
    case End::LimitReached: return "limit";
    case End::Cancelled: break;
  }
  return "cancelled";
}

template <class T>
void put(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Stands for a number that is not there.
constexpr uint32_t kNone = 0xffffffff;

// Column by column, so that a page reads each as one array.
std::string traceBytes(const DerivationTrace& trace) {
  using Node = DerivationTrace::Node;
  using Place = DerivationTrace::Place;
  std::string out;
  const auto column = [&](auto&& valueOf) {
    for (const Node& n : trace.nodes) put(out, valueOf(n));
  };
  column([](const Node& n) { return n.parent.value_or(kNone); });
  column([](const Node& n) { return n.shape; });
  column([](const Node& n) { return n.name; });
  for (auto member :
       {&Place::file, &Place::line, &Place::column, &Place::endLine, &Place::endColumn}) {
    column([&](const Node& n) { return n.place ? (*n.place).*member : 0u; });
  }
  column([](const Node& n) { return n.leaves ? n.leaves->first : kNone; });
  column([](const Node& n) { return n.leaves ? n.leaves->end : kNone; });
  column([](const Node& n) {
    return uint32_t{n.leaf} | uint32_t{n.dropped} << 1 | uint32_t{n.ruleCall} << 2;
  });
  column([](const Node& n) { return n.before.value_or(kNone); });
  column([](const Node& n) { return n.after.value_or(kNone); });
  for (const Node& n : trace.nodes) {
    for (const double v : n.frame) put(out, static_cast<float>(v));
  }
  for (const Node& n : trace.nodes) {
    for (const double v : n.size) put(out, static_cast<float>(v));
  }
  return out;
}

// Each as [node, kind, name, value, file, line], and a choice with [draw, chance, chosen, choices]
// behind.
void writeNotes(JsonWriter& json, const DerivationTrace& trace) {
  json.key("notes").beginArray();
  for (const DerivationTrace::Note& n : trace.notes) {
    const DerivationTrace::Place place = n.place.value_or(DerivationTrace::Place{});
    json.beginArray().value(static_cast<uint64_t>(n.node));
    json.value(static_cast<uint64_t>(n.kind)).value(n.name);
    writeValue(json, n.value);
    json.value(place.file).value(place.line);
    if (n.choice) {
      json.value(n.choice->draw).value(n.choice->chance);
      json.value(n.choice->chosen).value(n.choice->choices);
    }
    json.endArray();
  }
  json.endArray();
}

// What counts as the project of a rule file, as the command line finds it: the nearest folder above
// with a folder `rules` or `assets` in it, else the whole. With a '/' at its end, or empty.
std::string projectOf(const ProjectFiles& files, const std::string& file) {
  for (size_t end = file.rfind('/'); end != std::string::npos && end > 0;
       end = file.rfind('/', end - 1)) {
    const std::string folder = file.substr(0, end + 1);
    for (const char* name : {"rules", "assets"}) {
      const Result<std::string> place = files.place(folder + name);
      std::error_code error;
      if (place.ok() && std::filesystem::is_directory(place.value(), error)) return folder;
    }
  }
  return {};
}

}  // namespace

std::shared_ptr<const Rules> Session::rulesOf(const JsonValue& request) {
  const std::string& file = request["file"].text();
  LoadSettings options;
  const std::string inner = projectOf(files_, file);
  options.project = files_.root() + "/" + inner;
  options.search = search_;
  // A folder of projects is a workspace.
  if (!inner.empty() && !search_.workspace) options.search.workspace = files_.root();
  const std::string& style = request["style"].text();
  if (!style.empty()) options.style = style;
  std::string key = file + '\0' + style + '\0' + request["text"].text();
  for (const auto& [path, text] : request["overlay"].members()) {
    if (path.compare(0, inner.size(), inner) == 0) {
      options.overlay.emplace_back(path.substr(inner.size()), text.text());
    }
    key += '\0' + path + '\0' + text.text();
  }
  std::shared_ptr<const Rules> before;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [known, rules] : rules_) {
      if (known == key) return rules;
    }
    if (!rules_.empty()) before = rules_.front().second;
  }
  options.before = before.get();
  options.limits = kFileLimits;
  auto rules = std::make_shared<const Rules>(
      Rules::parse(request["text"].text(), files_.root() + "/" + file, options));
  const std::lock_guard lock(mutex_);
  keep(rules_, {std::move(key), rules}, kRulesKept);
  return rules;
}

Result<std::shared_ptr<const Shapes>> Session::shapesOf(const JsonValue& request) {
  const JsonValue& spec = request["shapes"];
  const auto shared = [](Shapes s) { return std::make_shared<const Shapes>(std::move(s)); };
  const std::string& file = spec["file"].text();
  if (file.empty()) {
    const JsonValue& ring = spec["polygon"];
    if (ring.size() >= 3) {
      Shapes::Ring points;
      for (const JsonValue& p : ring.items()) {
        points.emplace_back(p.at(0).number(0), p.at(1).number(0));
      }
      return shared(Shapes::polygon(points));
    }
    const auto side = [&](size_t i) { return std::clamp(spec["lot"].at(i).number(20), 0.01, 1e6); };
    return shared(Shapes::lot(side(0), side(1)));
  }
  Result<std::shared_ptr<const Shapes>> all = fileShapes(file);
  if (!all.ok() || spec["only"].size() == 0) return all;
  std::vector<size_t> chosen;
  for (const JsonValue& index : spec["only"].items()) {
    const double i = index.number(-1);
    if (i >= 0 && i < static_cast<double>(all.value()->size())) {
      chosen.push_back(static_cast<size_t>(i));
    }
  }
  return shared(all.value()->only(chosen));
}

Result<std::shared_ptr<const Shapes>> Session::fileShapes(const std::string& file) {
  const Result<std::string> place = files_.place(file);
  if (!place.ok()) return place.error();
  const Result<std::string> content = files_.read(file);
  if (!content.ok()) return content.error();
  const std::string key = file + '\0' + ProjectFiles::versionOf(content.value());
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [known, shapes] : shapes_) {
      if (known == key) return shapes;
    }
  }
  auto shapes =
      std::make_shared<const Shapes>(Shapes::parse(content.value(), place.value(), kFileLimits));
  const std::lock_guard lock(mutex_);
  // What a limit ended may come to its end another time.
  if (!shapes->ok()) return shapes;
  keep(shapes_, {key, shapes}, kShapesKept);
  return shapes;
}

std::shared_ptr<Session::Work> Session::begin(const JsonValue& request, const Cancel& cancel) {
  const std::string& page = request["page"].text();
  auto work = std::make_shared<Work>();
  work->cancel = cancel;
  if (page.empty()) return work;
  const std::lock_guard lock(mutex_);
  // Pages that are long gone do not pile up.
  if (works_.size() >= kPagesKept && !works_.count(page)) works_.erase(works_.begin());
  std::shared_ptr<Work>& before = works_[page];
  if (before && before->cancel == cancel) return before;
  // A later one of the page is here already.
  if (cancel->load()) return work;
  if (before) before->cancel->store(true);
  before = work;
  return work;
}

void Session::announce(const JsonValue& request, const Cancel& cancel) { begin(request, cancel); }

Result<Model> Session::deriveFor(const JsonValue& request, const Rules& rules, Work& work,
                                 Trace trace) {
  const Result<std::shared_ptr<const Shapes>> shapes = shapesOf(request);
  if (!shapes.ok()) return shapes.error();
  if (shapes.value()->size() == 0) {
    const DiagnosticList& why = shapes.value()->diagnostics();
    return Error{"no-shapes", why.empty() ? "there is no shape to derive" : why[0].message, ""};
  }
  DeriveSettings settings = settingsOf(request);
  settings.trace = trace != Trace::None;
  settings.traceShapes = trace == Trace::Steps;
  if (trace == Trace::Tree) settings.limits.shapes = std::min(settings.limits.shapes, kTreeShapes);
  if (trace == Trace::Steps) settings.limits.shapes = std::min(settings.limits.shapes, kStepShapes);
  // A value may outlive its attribute while the rules are being written.
  const std::vector<AttributeInfo> known = rules.attributes();
  std::erase_if(settings.attributes, [&](const auto& value) {
    return std::none_of(known.begin(), known.end(),
                        [&](const AttributeInfo& a) { return a.name == value.first; });
  });
  settings.cancel = work.cancel.get();
  settings.progress = [&work](size_t done, size_t total) {
    work.done = done;
    work.total = total;
  };
  // What is as it was is taken over from what the page saw last.
  const std::optional<Model> before =
      trace == Trace::None ? lastOf(request["page"].text()) : std::nullopt;
  settings.remember = trace == Trace::None;
  settings.before = before ? &*before : nullptr;
  return gable::derive(rules, *shapes.value(), settings);
}

Result<Session::Answer> Session::derive(const JsonValue& request, const Cancel& cancel) {
  const std::shared_ptr<Work> work = begin(request, cancel);
  const std::shared_ptr<const Rules> rules = rulesOf(request);
  std::string text;
  JsonWriter json(text);
  json.beginObject();
  writeRules(json, *rules);
  DiagnosticList diagnostics = rules->diagnostics();
  if (!rules->ok() || request["only"].text() == "check") {
    json.key("end").value(rules->ok() ? "checked" : "wrong");
    json.key("diagnostics").raw(diagnosticsJson(diagnostics)).endObject();
    return Answer{headOf("GBS1", text), {}};
  }
  const std::shared_ptr<const DrawnChunks> held = drawnOf(request["known"]);
  const Result<Model> derived = deriveFor(request, *rules, *work, Trace::None);
  if (!derived.ok()) return derived.error();
  const Model& model = derived.value();
  const DiagnosticList& more = model.diagnostics();
  diagnostics.insert(diagnostics.end(), more.begin(), more.end());
  const bool wrong = hasErrors(more) && model.end() == End::Done;
  const bool drawn = !wrong && model.end() != End::Cancelled;
  uint64_t number = 0;
  if (drawn) {
    const std::lock_guard lock(mutex_);
    number = ++last_;
    keepModel({number, model, request["page"].text(), 0, nullptr});
  }
  json.key("end").value(wrong ? "wrong" : endName(model.end()));
  json.key("derivation").value(number);
  json.key("diagnostics").raw(diagnosticsJson(diagnostics));
  json.key("values").raw(valuesJson(model.attributes(0)));
  RunFigures figures;
  figures.parseSeconds = rules->parseSeconds();
  figures.deriveSeconds = model.deriveSeconds();
  std::string stats;
  std::vector<std::string> list;
  parallelFor(drawn ? 2 : 1, 2, [&](size_t i, unsigned) {
    if (i == 0) {
      stats = statisticsJson(model, figures);
    } else if (request.find("known")) {
      DrawUpdate update = model.drawUpdate(held.get(), {}, takeRoom());
      keepDrawn(number, std::move(update.drawn));
      list = std::move(update.bytes);
    } else {
      list.push_back(model.drawList());
    }
  });
  if (held) json.key("base").value(request["known"].number(0));
  json.key("stats").raw(stats).endObject();
  return Answer{headOf("GBS1", text), std::move(list)};
}

Result<std::string> Session::tree(const JsonValue& request, const Cancel& cancel) {
  const std::shared_ptr<Work> work = begin(request, cancel);
  const std::shared_ptr<const Rules> rules = rulesOf(request);
  // A page that asks while somebody types need not hear of a failure.
  if (!rules->ok()) {
    return headOf("GBT1", R"({"count":0,"end":"wrong","names":[],"files":[]})");
  }
  const bool steps = request["steps"].boolean(false);
  Result<Model> derived = deriveFor(request, *rules, *work, steps ? Trace::Steps : Trace::Tree);
  if (!derived.ok()) return derived.error();
  const DerivationTrace trace = derived->trace();
  std::string text;
  JsonWriter json(text);
  json.beginObject().key("count").value(static_cast<uint64_t>(trace.nodes.size()));
  json.key("end").value(endName(derived->end())).key("names").beginArray();
  for (const std::string& n : trace.names) json.value(n);
  json.endArray().key("files").beginArray();
  for (const std::string& f : trace.files) json.value(f);
  json.endArray();
  if (steps) writeNotes(json, trace);
  json.endObject();
  return headOf("GBT1", text) + traceBytes(trace) + (steps ? derived->drawList() : std::string());
}

void Session::reuse(std::vector<std::string> pieces) {
  size_t bytes = 0;
  for (const std::string& piece : pieces) bytes += piece.size();
  // The head alone: a check, or rules that are wrong.
  if (pieces.size() < 2 || bytes > kMostRoom) return;
  const std::lock_guard lock(mutex_);
  room_ = std::move(pieces);
}

std::vector<std::string> Session::takeRoom() {
  const std::lock_guard lock(mutex_);
  return std::exchange(room_, {});
}

void Session::prepareNext(const std::string& page) const {
  const std::optional<Model> model = lastOf(page);
  // Two models are kept beside what is made ready.
  if (model && model->leafCount() <= kLeavesKept / 2) model->prepareNext();
}

std::optional<Model> Session::made(uint64_t number) const {
  const std::lock_guard lock(mutex_);
  for (const Made& m : made_) {
    if (m.number == number) return m.model;
  }
  return std::nullopt;
}

std::shared_ptr<const DrawnChunks> Session::drawnOf(const JsonValue& known) const {
  const std::lock_guard lock(mutex_);
  for (const Made& m : made_) {
    if (static_cast<double>(m.number) == known.number(0)) return m.drawn;
  }
  return nullptr;
}

void Session::keepDrawn(uint64_t number, std::shared_ptr<const DrawnChunks> drawn) {
  const std::lock_guard lock(mutex_);
  for (Made& m : made_) {
    if (m.number == number) m.drawn = std::move(drawn);
  }
}

std::optional<Model> Session::lastOf(const std::string& page) const {
  const std::lock_guard lock(mutex_);
  for (const Made& m : made_) {
    if (m.page == page) return m.model;
  }
  return std::nullopt;
}

Result<Model> Session::model(uint64_t derivation) const {
  std::optional<Model> model = made(derivation);
  if (!model) return Error{"derivation-gone", "this derivation is no longer kept", "derive again"};
  return std::move(*model);
}

uint64_t Session::adopt(Model model) {
  const std::lock_guard lock(mutex_);
  keepModel({++last_, std::move(model), "workshop", 0, nullptr});
  return last_;
}

void Session::keepModel(Made made) {
  const std::string page = made.page;
  made.leaves = made.model.leafCount();
  made_.push_front(std::move(made));
  size_t own = 0;
  uint64_t leaves = 0;
  for (auto at = made_.begin(); at != made_.end();) {
    leaves += at->leaves;
    const bool large = at != made_.begin() && leaves > kLeavesKept;
    const bool old = at->page == page && ++own > kModelsKept;
    at = old || large ? made_.erase(at) : at + 1;
  }
  if (made_.size() > kModelsOfAll) made_.pop_back();
}

Result<std::string> Session::leaf(uint64_t derivation, uint64_t number) const {
  const std::optional<Model> model = made(derivation);
  if (!model) return Error{"derivation-gone", "this derivation is no longer kept", "derive again"};
  const std::optional<LeafInfo> leaf = model->leaf(number);
  if (!leaf) return Error{"leaf-missing", "there is no leaf " + std::to_string(number), ""};
  return leafJson(*leaf);
}

Result<std::string> Session::parts(uint64_t derivation, uint64_t leaf, uint64_t level) const {
  const Result<Model> kept = model(derivation);
  if (!kept.ok()) return kept.error();
  return partsJson(kept.value().parts(leaf, level));
}

Result<std::string> Session::texture(uint64_t derivation, const std::string& path) const {
  const std::optional<Model> model = made(derivation);
  std::optional<std::string> bytes = model ? model->texture(path) : std::nullopt;
  if (!bytes) return Error{"texture-not-found", "there is no picture '" + path + "'", ""};
  return std::move(*bytes);
}

std::pair<size_t, size_t> Session::progress(const std::string& page) const {
  const std::lock_guard lock(mutex_);
  const auto at = works_.find(page);
  if (at == works_.end()) return {0, 0};
  return {at->second->done.load(), at->second->total.load()};
}

void Session::forget() {
  const std::lock_guard lock(mutex_);
  rules_.clear();
  shapes_.clear();
}

}  // namespace gable::studio
